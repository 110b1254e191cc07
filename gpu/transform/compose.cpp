#include "gpu/transform/compose.h"

#include "gpu/transform/element_map.h"
#include "gpu/transform/quaternion.h"
#include "shaders.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {

std::vector<mat4> compose(Context& context, std::span<const Trs> transforms) {
  std::vector<TrsRecord> records;
  records.reserve(transforms.size());
  for (const Trs& trs : transforms)
    records.push_back({trs.translation, quaternion_components(trs.rotation), trs.scale});
  return element_map<ComposeArgs, mat4>(context, shaders::transform_compose_comp, records);
}

}  // namespace parity::gpu
