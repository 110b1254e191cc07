#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

/// The problems of the raster chapter: what goes in and what comes out, on either side.
namespace parity {

enum class Cull { none, back, front };

/// How a device turns a clip position into fixed point. Measured: see docs/drivers.md.
///   mesa:        r = 1/w; x_f = fma(x r, W/2, W/2); X = rne((x_f - (1x ? .5 : 0)) 256)
///   swiftshader: X = rne(X0 F + (x/w) (W/2) F - F/2), F = 16
enum class Snapping { mesa, swiftshader };

/// Triangles after the vertex stage, before clipping, and the target they fall on.
/// Counter-clockwise triangles (y up) face the viewer.
struct TriangleList {
  int width = 0;
  int height = 0;
  int samples = 1;  ///< 1, 2, 4, 8
  std::vector<vec4> clip_positions;
  std::vector<uvec3> triangles;
  Cull cull = Cull::none;
};

/// Places of the samples in a pixel, in 1/16 pixel from its top left: the standard ones of Vulkan.
///
/// @throws std::invalid_argument  samples is not 1, 2, 4 or 8.
std::vector<ivec2> standard_sample_places(int samples);

/// What clipping leaves of a triangle: a convex polygon, its corners in the order of the triangle's.
/// A triangle cut by seven planes has at most ten. Empty: count is 0.
struct ClippedPolygon {
  std::uint32_t count = 0;
  std::array<dvec4, 10> position{};     ///< clip space
  std::array<dvec3, 10> barycentric{};  ///< of the corner in the triangle, linear in clip space
};

/// What covers each sample: sample s of pixel (x, y) stands at index (y width + x) samples + s.
struct Coverage {
  int width = 0;
  int height = 0;
  int samples = 1;
  std::vector<std::uint32_t> count;  ///< triangles that cover the sample
  std::vector<std::uint32_t> last;   ///< 1 + the last triangle in the list that does; 0: none
};

/// A varying at every vertex of a triangle list, for interpolation. `perspective` false is
/// Vulkan's noperspective: affine in the window.
struct Varyings {
  std::vector<vec4> values;  ///< one a clip position
  bool perspective = true;
};

/// One layer of a triangle list with depth test: what is in front at each pixel centre.
struct DepthImage {
  Grid<float> depth;
  Grid<std::uint32_t> front;  ///< 1 + index of the triangle; 0: none
};

/// How a layer goes on top of what is there; colours are linear. The first layer goes on (0, 0, 0, 0).
enum class BlendMode {
  over,                ///< source-over, colour not multiplied by alpha
  over_premultiplied,  ///< source-over, colour multiplied by alpha
  add,                 ///< sum of colours and alphas
};

/// Segments in window space for line rasterisation, integer end points (Bresenham) or real (DDA).
struct Segment {
  ivec2 begin{0};
  ivec2 end{0};
};

/// A polygon of one or more closed rings in window space, y down, for fills.
enum class FillRule { even_odd, non_zero };
struct Polygon {
  std::vector<std::vector<vec2>> rings;
};

}  // namespace parity
