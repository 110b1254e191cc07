#include "gpu/raster/triangle_buffers.h"

#include <stdexcept>
#include <string>

namespace parity::gpu {
namespace {

const TriangleList& checked(const TriangleList& list, const char* who) {
  const std::string prefix = std::string(who) + ": ";
  if (list.width < 1 || list.width > 16384 || list.height < 1 || list.height > 16384)
    throw std::invalid_argument(prefix + "size is " + std::to_string(list.width) + "x" +
                                std::to_string(list.height) + ", sides must be 1 to 16384");
  standard_sample_places(list.samples);
  for (std::size_t t = 0; t < list.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (list.triangles[t][corner] >= list.clip_positions.size())
        throw std::invalid_argument(prefix + "triangle " + std::to_string(t) + " has vertex " +
                                    std::to_string(list.triangles[t][corner]) + ", there are " +
                                    std::to_string(list.clip_positions.size()));
  return list;
}

std::vector<std::uint32_t> flags_of(const TriangleList& list) {
  const std::uint32_t flag = list.cull == Cull::back    ? triangle_cull_back
                             : list.cull == Cull::front ? triangle_cull_front
                                                        : 0;
  return std::vector<std::uint32_t>(list.triangles.size(), flag);
}

}  // namespace

TriangleBuffers::TriangleBuffers(Context& context, const TriangleList& list, const char* who)
    : clip_positions_(context, checked(list, who).clip_positions),
      triangles_(context, list.triangles),
      flags_(context, flags_of(list)) {}

TriangleSource TriangleBuffers::source() const {
  return {clip_positions_, triangles_, flags_, triangle_count(), 1};
}

std::uint32_t TriangleBuffers::triangle_count() const { return std::uint32_t(triangles_.count()); }

}  // namespace parity::gpu
