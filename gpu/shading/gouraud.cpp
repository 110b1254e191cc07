#include "gpu/shading/gouraud.h"

#include "gpu/shading/query_map.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<vec2> gouraud(Context& context, std::span<const GouraudQuery> queries) {
  return query_map<GouraudArgs, vec2>(context, shaders::shading_gouraud_comp, queries);
}

}  // namespace parity::gpu
