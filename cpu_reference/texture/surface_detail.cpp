#include "cpu_reference/texture/surface_detail.h"

#include <array>
#include <cmath>

#include "cpu_reference/texture/sample.h"
#include "geometry/texture.h"

namespace parity::cpu {

dvec3 bump(const SurfaceDetail& detail) {
  const dvec3 u{detail.p_u}, v{detail.p_v};
  // Lengths and angle of the derivatives; its inverse turns slopes into components along them.
  const double e = glm::dot(u, u), f = glm::dot(u, v), g = glm::dot(v, v);
  const dvec2 slope{detail.slope};
  const dvec2 parts = dvec2(g * slope.x - f * slope.y, e * slope.y - f * slope.x) / (e * g - f * f);
  const dvec3 normal = glm::normalize(glm::cross(u, v));
  return glm::normalize(normal - (parts.x * u + parts.y * v));
}

dvec3 normal_map(const SurfaceDetail& detail) {
  const dvec3 n = glm::normalize(dvec3(detail.normal));
  const dvec3 t = glm::normalize(dvec3(detail.tangent));
  const dmat3 world_from_tangent{t, glm::cross(n, t) * double(detail.tangent.w), n};
  const dvec3 bent =
      (dvec3(detail.texel) * 2.0 - 1.0) * dvec3(double(detail.scale), double(detail.scale), 1.0);
  return glm::normalize(world_from_tangent * bent);
}

double depth_at(const Grid<u8vec4>& heights, dvec2 uv) {
  const std::array<Grid<u8vec4>, 1> level{heights};
  return 1 - sample({level, false, {}}, uv, 0.0).value.x;
}

ParallaxHit parallax(const Grid<u8vec4>& heights, dvec2 uv, dvec3 to_eye, double scale,
                     int layers) {
  const std::array<Grid<u8vec4>, 1> level{heights};
  const MippedTexture field{level, false, {}};
  const dvec2 way = -dvec2(to_eye) / to_eye.z * scale;  // from the surface to the bottom
  const auto is_below = [&](double depth) {
    return depth >= 1 - sample(field, uv + way * depth, 0.0).value.x;
  };
  int layer = 0;
  while (layer < layers && !is_below(double(layer) / layers)) ++layer;
  double above = std::max(0.0, double(layer - 1) / layers), below = double(layer) / layers;
  for (int i = 0; i < parallax_bisections && above < below; ++i) {
    const double middle = (above + below) / 2;
    (is_below(middle) ? below : above) = middle;
  }
  return {uv + way * below, below};
}

}  // namespace parity::cpu
