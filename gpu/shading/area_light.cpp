#include "gpu/shading/area_light.h"

#include "gpu/shading/query_map.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<float> rectangle_light(Context& context, std::span<const RectangleQuery> queries) {
  return query_map<RectangleArgs, float>(context, shaders::shading_rectangle_light_comp, queries);
}

std::vector<float> sphere_light(Context& context, std::span<const SphereQuery> queries) {
  return query_map<SphereArgs, float>(context, shaders::shading_sphere_light_comp, queries);
}

}  // namespace parity::gpu
