#include "gpu/texture/projection.h"

#include "gpu/texture/point_map.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t triplanar = 4;  // after the projections

std::vector<vec3> run(Context& context, std::span<const vec3> points, std::uint32_t kind) {
  std::vector<vec3> places;
  for (const vec4& place :
       point_map(context, shaders::texture_projection_comp, points, {.kind = kind}))
    places.emplace_back(place);
  return places;
}

}  // namespace

std::vector<vec3> project(Context& context, Projection projection, std::span<const vec3> points) {
  return run(context, points, std::uint32_t(projection));
}

std::vector<vec3> triplanar_weights(Context& context, std::span<const vec3> normals) {
  return run(context, normals, triplanar);
}

}  // namespace parity::gpu
