#include "geometry/camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

void require(bool holds, const char* what, double value, const char* expected) {
  if (!holds)
    throw std::invalid_argument(std::string("clip_from_view: ") + what + " is " +
                                std::to_string(value) + ", must be " + expected);
}

void check(const Camera& camera, double aspect) {
  require(std::isfinite(aspect) && aspect > 0, "aspect", aspect, "positive");
  if (camera.orthographic) {
    require(std::isfinite(camera.x_magnification) && camera.x_magnification != 0, "x_magnification",
            camera.x_magnification, "finite and not 0");
    require(std::isfinite(camera.y_magnification) && camera.y_magnification != 0, "y_magnification",
            camera.y_magnification, "finite and not 0");
    require(camera.far.has_value(), "far", 0, "given for an orthographic camera");
    require(camera.near >= 0, "near", camera.near, "at least 0");
  } else {
    require(camera.vertical_fov > 0 && camera.vertical_fov < std::numbers::pi, "vertical_fov",
            camera.vertical_fov, "between 0 and pi");
    require(std::isfinite(camera.near) && camera.near > 0, "near", camera.near, "positive");
  }
  if (camera.far)
    require(std::isfinite(*camera.far) && *camera.far > camera.near, "far", *camera.far,
            "greater than near");
}

/// Depth row (A, B) such that clip z = A z_view + B, for clip w = -z_view or 1.
dvec2 depth_row(const Camera& camera, bool reverse) {
  const double n = camera.near;
  if (camera.orthographic) {
    const double span = *camera.far - n;
    return reverse ? dvec2(1 / span, *camera.far / span) : dvec2(-1 / span, -n / span);
  }
  if (!camera.far) return reverse ? dvec2(0, n) : dvec2(-1, -n);
  const double f = *camera.far;
  return reverse ? dvec2(n / (f - n), f * n / (f - n)) : dvec2(-f / (f - n), -f * n / (f - n));
}

/// Half sides of the view at distance 1 (perspective) or anywhere (orthographic): at least what the
/// camera names, more on one axis where the picture has another shape, so that nothing is
/// stretched.
dvec2 half_view(const Camera& camera, double aspect) {
  dvec2 half;
  if (camera.orthographic) {
    half = {camera.x_magnification, camera.y_magnification};
  } else {
    half.y = std::tan(camera.vertical_fov / 2);
    half.x = half.y * camera.aspect.value_or(aspect);
  }
  const double own = std::abs(half.x / half.y);
  if (aspect > own) half.x *= aspect / own;
  if (aspect < own) half.y *= own / aspect;
  return half;
}

}  // namespace

dmat4 clip_from_view(const Camera& camera, double aspect, DepthMode depth) {
  check(camera, aspect);
  const dvec2 row = depth_row(camera, depth == DepthMode::reverse_z);
  dmat4 clip{0.0};
  const dvec2 half = half_view(camera, aspect);
  clip[0][0] = 1 / half.x;
  clip[1][1] = -1 / half.y;
  clip[2][3] = camera.orthographic ? 0 : -1;
  clip[3][3] = camera.orthographic ? 1 : 0;
  clip[2][2] = row.x;
  clip[3][2] = row.y;
  return clip;
}

}  // namespace parity
