#pragma once

#include <string>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"
#include "tests/numbers.h"
#include "tests/setting.h"

/// Triangles that rasterisers get wrong, for the records of the raster chapter.
namespace parity::raster_test {

/// A list of triangles, how the device that is to draw it snaps, and whether that is known.
struct RasterProblem {
  TriangleList list;
  Snapping snapping = Snapping::mesa;
  bool snapping_is_known = true;
  int subpixel_bits = 8;
};
inline auto fields_of(const RasterProblem*) {
  return std::tuple{&RasterProblem::list, &RasterProblem::snapping,
                    &RasterProblem::snapping_is_known, &RasterProblem::subpixel_bits};
}

/// What the triangles of a list are like. The first five lie inside the viewport.
enum class Kind {
  random,      ///< any size, perspective w from 0.5 to 4
  slivers,     ///< a pixel or less across, as long as the picture
  ties,        ///< corners on 1/16 pixels: edges through samples, axis-aligned edges
  mesh,        ///< a jittered grid: every edge shared by two
  subpixel,    ///< smaller than a pixel
  off_screen,  ///< beside the viewport
  behind,      ///< behind the eye
  crossing,    ///< up to 40 px out of the viewport: a device may cut them at its border
  through,     ///< through the near plane: everybody must cut them
  huge,        ///< up to 2^16 px out: beyond what fixed point holds
};

/// Axes of most stages here: kind up to a last one, samples, side of the picture.
Axis kind_axis(Kind last);
Axis samples_axis();
Axis side_axis();

/// `count` triangles of one kind on a side x side picture.
///
/// @param cull  0 none, 1 back, 2 front
TriangleList make_triangles(Kind kind, int side, int samples, int count, std::uint64_t seed);

/// From the axes kind, samples and side, as many triangles as make about three layers.
RasterProblem make_raster_problem(const Setting& setting, const gpu::DeviceInfo& device);

/// How a device snaps, and whether we know.
RasterProblem for_device(TriangleList list, const gpu::DeviceInfo& device);

}  // namespace parity::raster_test
