#include "cpu_reference/texture/environment.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/projection.h"

namespace parity::cpu {
namespace {

/// Mixes the four texels around a place; texel(x, y) takes numbers one outside of the picture too.
template <typename Texel>
dvec4 bilinear(dvec2 place, const Texel& texel) {
  const dvec2 low = glm::floor(place);
  const dvec2 share = place - low;
  const int x = int(low.x), y = int(low.y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), share.x),
                  glm::mix(texel(x, y + 1), texel(x + 1, y + 1), share.x), share.y);
}

/// A texel of a face that may be one beyond an edge: the point of the cube that lies half a texel
/// behind the edge on the neighbour.
dvec4 cube_texel(const Grid<vec4>& faces, int face, int x, int y) {
  const int side = faces.width();
  const bool beside = x < 0 || x >= side, above = y < 0 || y >= side;
  const int inner_x = std::clamp(x, 0, side - 1), inner_y = std::clamp(y, 0, side - 1);
  if (beside && above)
    return (cube_texel(faces, face, x, inner_y) + cube_texel(faces, face, inner_x, y) +
            cube_texel(faces, face, inner_x, inner_y)) /
           3.0;
  if (!beside && !above) return dvec4(faces(x, face * side + y));
  const auto center = [&](double u, double v) {
    return direction_of(Projection::cubic, {{u / side, v / side}, face});
  };
  // The edge's point, and the way out of the face there.
  const dvec2 edge{beside ? (x < 0 ? 0 : side) : x + 0.5, above ? (y < 0 ? 0 : side) : y + 0.5};
  const dvec3 out = center(side / 2.0, side / 2.0);
  dvec3 on_edge = center(edge.x, edge.y);
  on_edge /= glm::dot(on_edge, out);
  const TexturePoint there = project(Projection::cubic, on_edge - out / double(side));
  const dvec2 texel = glm::floor(there.uv * double(side));
  return dvec4(faces(int(texel.x), there.face * side + int(texel.y)));
}

}  // namespace

dvec4 sample_equirectangular(const Grid<vec4>& picture, dvec3 direction) {
  const int width = picture.width(), height = picture.height();
  const dvec2 uv = project(Projection::spherical, direction).uv;
  return bilinear(uv * dvec2(width, height) - 0.5, [&](int x, int y) {
    if (y < 0 || y >= height) x += width / 2;
    return dvec4(picture((x % width + width) % width, std::clamp(y, 0, height - 1)));
  });
}

dvec4 sample_cube_map(const Grid<vec4>& faces, dvec3 direction) {
  const TexturePoint place = project(Projection::cubic, direction);
  return bilinear(place.uv * double(faces.width()) - 0.5,
                  [&](int x, int y) { return cube_texel(faces, place.face, x, y); });
}

}  // namespace parity::cpu
