#include "cpu_reference/shading/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

class Field {
 public:
  explicit Field(const OcclusionProblem& p) : p_(p) {}

  double openness(int x, int y) const {
    if (!is_there(x, y)) return 1;
    const dvec3 here = position(x, y);
    const dvec3 to_eye = p_.orthographic ? dvec3(0, 0, 1) : glm::normalize(-here);
    const dvec3 normal = normal_at(x, y, here, to_eye);
    const float reach = reach_at(x, y);
    double open = 0, all = 0;
    for (const vec4& slice : p_.slices) {
      const ivec2 direction{int(slice.x), int(slice.y)};
      // The slice is spanned by the eye's direction and that of the line on the screen.
      const dvec3 on_screen{direction.x * double(p_.slope.x) / width(),
                            -direction.y * double(p_.slope.y) / height(), 0.0};
      const dvec3 axis = glm::normalize(glm::cross(to_eye, on_screen));
      const dvec3 projected = normal - axis * glm::dot(normal, axis);
      const double size = glm::length(projected);
      if (!(size > 0)) continue;
      const double angle =
          std::atan2(glm::dot(projected, glm::cross(axis, to_eye)), glm::dot(projected, to_eye));
      const Place at{x, y, here, to_eye, reach * slice.w};
      const double quarter = std::numbers::pi / 2;
      open += double(slice.z) * size *
              open_arc(angle, horizon(at, direction, quarter + angle),
                       horizon(at, -direction, quarter - angle));
      all += double(slice.z) * size * open_arc(angle, quarter + angle, quarter - angle);
    }
    return all > 0 ? std::clamp(open / all, 0.0, 1.0) : 1;
  }

 private:
  struct Place {
    int x = 0;
    int y = 0;
    dvec3 position{0.0};
    dvec3 to_eye{0.0};
    float reach = 0;  ///< steps of the slice
  };

  int width() const { return p_.distances.width(); }
  int height() const { return p_.distances.height(); }
  bool is_there(int x, int y) const {
    return x >= 0 && y >= 0 && x < width() && y < height() && std::isfinite(p_.distances(x, y));
  }

  dvec3 position(int x, int y) const {
    const double distance = p_.distances(x, y);
    const double scale = p_.orthographic ? 1 : distance;
    return {((x + 0.5) * 2 / width() - 1) * double(p_.slope.x) * scale,
            (1 - (y + 0.5) * 2 / height()) * double(p_.slope.y) * scale, -distance};
  }

  /// To the radius, in quarters of pixels, so that the device does not choose other texels.
  float reach_at(int x, int y) const {
    const float across = 2.0f * p_.slope.x * (p_.orthographic ? 1.0f : p_.distances(x, y));
    return std::floor(4.0f * p_.radius * float(width()) / across) * 0.25f;
  }

  /// Along one axis of the picture, to the nearer neighbour in depth.
  dvec3 tangent(int x, int y, int step_x, int step_y, const dvec3& here) const {
    const bool ahead = is_there(x + step_x, y + step_y), back = is_there(x - step_x, y - step_y);
    if (!ahead && !back) return dvec3(0.0);
    const float own = p_.distances(x, y);
    if (ahead && (!back || std::abs(p_.distances(x + step_x, y + step_y) - own) <=
                               std::abs(p_.distances(x - step_x, y - step_y) - own)))
      return position(x + step_x, y + step_y) - here;
    return here - position(x - step_x, y - step_y);
  }

  dvec3 normal_at(int x, int y, const dvec3& here, const dvec3& to_eye) const {
    const dvec3 n = glm::cross(tangent(x, y, 1, 0, here), tangent(x, y, 0, 1, here));
    if (!(glm::length(n) > 0)) return to_eye;
    return glm::normalize(glm::dot(n, to_eye) < 0 ? -n : n);
  }

  /// Angle from the eye's direction down to the horizon, at most `flat`, that of the plane.
  double horizon(const Place& at, const ivec2& direction, double flat) const {
    const double level = std::cos(flat);
    double highest = level;
    const double radius = p_.radius, fade = radius * double(occlusion_fade);
    for (std::size_t i = 0; i < p_.parts.size(); ++i) {
      const float steps = std::floor(at.reach * p_.parts[i] + 0.5f);
      const int far = int(std::clamp(steps, float(i + 1), 65536.0f));
      const int x = at.x + direction.x * far, y = at.y + direction.y * far;
      if (x < 0 || y < 0 || x >= width() || y >= height()) break;
      if (!is_there(x, y)) continue;
      const dvec3 d = position(x, y) - at.position;
      const double length = glm::length(d);
      if (!(length > 0)) continue;
      const double weight = std::clamp(
          (radius * radius - length * length) / (radius * radius - fade * fade), 0.0, 1.0);
      const double cosine = glm::mix(level, glm::dot(d, at.to_eye) / length, weight);
      highest = std::max(highest, cosine);
    }
    return highest > level ? std::acos(std::min(highest, 1.0)) : flat;
  }

  const OcclusionProblem& p_;
};

}  // namespace

double open_arc(double normal, double ahead, double back) {
  const auto side = [&](double horizon, double angle) {
    return 0.25 * (std::cos(angle) - std::cos(2 * horizon - angle) + 2 * horizon * std::sin(angle));
  };
  return side(ahead, normal) + side(back, -normal);
}

Grid<double> ambient_occlusion(const OcclusionProblem& p) {
  if (!(p.radius > 0) || !(p.slope.x > 0) || !(p.slope.y > 0))
    throw std::invalid_argument("cpu::ambient_occlusion: radius is " + std::to_string(p.radius) +
                                ", slope " + std::to_string(p.slope.x) + ", " +
                                std::to_string(p.slope.y) + ", must be above 0");
  Grid<double> result(p.distances.width(), p.distances.height());
  const Field field(p);
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) result(x, y) = field.openness(x, y);
  return result;
}

}  // namespace parity::cpu
