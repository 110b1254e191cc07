#include "gpu/transform/slerp.h"

#include "gpu/transform/element_map.h"
#include "gpu/transform/quaternion.h"
#include "shaders.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {

std::vector<quat> slerp(Context& context, std::span<const SlerpProblem> problems) {
  std::vector<SlerpRecord> records;
  records.reserve(problems.size());
  for (const SlerpProblem& problem : problems)
    records.push_back(
        {quaternion_components(problem.from), quaternion_components(problem.to), problem.t});
  std::vector<quat> results;
  results.reserve(problems.size());
  for (const vec4& q :
       element_map<SlerpArgs, vec4>(context, shaders::transform_slerp_comp, records))
    results.emplace_back(q.w, q.x, q.y, q.z);
  return results;
}

}  // namespace parity::gpu
