#include "gpu/raster/clip.h"

#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/raster/triangle_buffers.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

ClippedPolygon polygon_of(const ClippedRecord& record) {
  ClippedPolygon polygon;
  polygon.count = record.count;
  for (std::uint32_t i = 0; i < record.count; ++i) {
    polygon.position[i] = dvec4(record.position[i]);
    polygon.barycentric[i] = dvec3(record.barycentric[i]);
  }
  return polygon;
}

}  // namespace

std::vector<ClippedPolygon> clip(Context& context, const TriangleList& list, float guard_band) {
  if (!(guard_band >= 1))
    throw std::invalid_argument("gpu::clip: guard_band is " + std::to_string(guard_band) +
                                ", must be at least 1");
  const TriangleBuffers triangles(context, list, "gpu::clip");
  const Buffer<ClippedRecord> records(context, list.triangles.size());
  if (records.count() == 0) return {};
  const Kernel<ClipArgs> kernel(context, shaders::raster_clip_comp);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {triangles.triangle_count()},
                      {triangles.source(), records, guard_band, 0});
  });
  std::vector<ClippedPolygon> polygons;
  polygons.reserve(records.count());
  for (const ClippedRecord& record : records.read()) polygons.push_back(polygon_of(record));
  return polygons;
}

}  // namespace parity::gpu
