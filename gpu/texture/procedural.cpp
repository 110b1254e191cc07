#include "gpu/texture/procedural.h"

#include "gpu/texture/point_map.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<float> procedural(Context& context, Procedural kind, std::span<const vec3> points) {
  static_assert(procedural_octaves == procedural_octave_count);
  std::vector<float> values;
  for (const vec4& value :
       point_map(context, shaders::texture_procedural_comp, points,
                 {std::uint32_t(kind), {perlin_permutation.begin(), perlin_permutation.end()}}))
    values.push_back(value.x);
  return values;
}

}  // namespace parity::gpu
