#include "gpu/sampling/reconstruct.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {
namespace {

uvec2 checked(const char* what, ivec2 size, double reach) {
  for (int axis = 0; axis < 2; ++axis)
    if (size[axis] < 1 || size[axis] > 16384)
      throw std::invalid_argument(std::string("gpu::reconstruct: ") + what + " is " +
                                  std::to_string(size.x) + "x" + std::to_string(size.y) +
                                  ", sides must be 1 to 16384");
  if (reach > 50000)
    throw std::invalid_argument("gpu::reconstruct: the filter spans " + std::to_string(int(reach)) +
                                " texels, must be at most 50000");
  return uvec2(size);
}

double reach_of(ivec2 from, ivec2 to, ReconstructionFilter filter) {
  const dvec2 ratio = dvec2(from) / glm::max(dvec2(to), 1.0);
  return 2 * filter_radius(filter) * std::max(ratio.x, ratio.y);
}

}  // namespace

Reconstruction::Reconstruction(Context& context, ivec2 from, ivec2 to, ReconstructionFilter filter)
    : from_(checked("the source", from, reach_of(from, to, filter))),
      to_(checked("the size", to, 0)),
      filter_(filter),
      kernel_(context, shaders::sampling_reconstruct_comp),
      rows_(context, std::size_t(to_.x) * from_.y) {}

void Reconstruction::record(Commands& commands, const Buffer<vec4>& from, const Buffer<vec4>& to) {
  commands.dispatch(kernel_, {to_.x, from_.y},
                    ReconstructArgs{.from = from,
                                    .to = rows_,
                                    .in_count = from_.x,
                                    .out_count = to_.x,
                                    .lines = from_.y,
                                    .in_element_stride = 1,
                                    .in_line_stride = from_.x,
                                    .out_element_stride = 1,
                                    .out_line_stride = to_.x,
                                    .lines_first = 0,
                                    .filter_kind = std::uint32_t(filter_)});
  commands.dispatch(kernel_, {to_.x, to_.y},
                    ReconstructArgs{.from = rows_,
                                    .to = to,
                                    .in_count = from_.y,
                                    .out_count = to_.y,
                                    .lines = to_.x,
                                    .in_element_stride = to_.x,
                                    .in_line_stride = 1,
                                    .out_element_stride = to_.x,
                                    .out_line_stride = 1,
                                    .lines_first = 1,
                                    .filter_kind = std::uint32_t(filter_)});
}

Grid<vec4> reconstruct(Context& context, const Grid<vec4>& picture, ivec2 size,
                       ReconstructionFilter filter) {
  Reconstruction reconstruction(context, {picture.width(), picture.height()}, size, filter);
  const Buffer<vec4> from(context, picture.values());
  Grid<vec4> result(size.x, size.y);
  const Buffer<vec4> to(context, result.size());
  context.run([&](Commands& commands) { reconstruction.record(commands, from, to); });
  result.values() = to.read();
  return result;
}

}  // namespace parity::gpu
