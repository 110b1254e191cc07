// What the kernels of the raster chapter and their hosts share. Fields only.
#ifndef PARITY_RASTER_LAYOUT_H
#define PARITY_RASTER_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// Side of a tile of the compute rasteriser, in pixels.
const uint tile_side = 8u;
/// Fixed-point units a pixel, whatever the snapping.
const int subpixel_units = 256;

/// Flags of a triangle.
const uint triangle_cull_back = 1u;
const uint triangle_cull_front = 2u;
const uint triangle_mirrored = 4u;  ///< front faces are clockwise (y up)
const uint triangle_unseen = 8u;    ///< stands in the lists of the tiles, not in elements
/// Bit of TileTriangle::element where the triangle is unseen.
const uint element_unseen = 0x80000000u;

/// Where triangles come from. The element of triangle t is first_element + t; 0 means none.
struct TriangleSource {
  REF(vec4) clip_positions;
  REF(uvec3) triangles;
  REF(uint) flags;  ///< one a triangle
  uint triangle_count;
  uint first_element;
};

/// What they fall on. `snapping` is the number of the enumerator.
struct RasterTarget {
  uint width;
  uint height;
  uint samples;
  uint snapping;
  float guard_band;  ///< |x| and |y| up to guard_band w are not clipped
  uint tiles_x;
};

/// A piece of a triangle as the samples of one tile see it. Sample (i, j), in 1/16 pixel from the
/// middle of the tile, is covered where edge + edge_x i + edge_y j >= 0 in all three components;
/// its depth is depth.x + depth.y i + depth.z j (logarithmic depth: that is 1/w).
struct TileTriangle {
  ivec3 edge;
  ivec3 edge_x;
  ivec3 edge_y;
  vec3 depth;
  uint element;
};
REF_TYPE(TileTriangle, 4)

/// A triangle, or a piece of one that was clipped, in fixed point (raster/edge.glsl): clockwise on
/// the screen. element is 0 where nothing is to be drawn.
struct TrianglePiece {
  ivec2 corner[3];
  vec3 depth;  ///< z/w of the corners; 1/w for logarithmic depth
  uint element;
};
REF_TYPE(TrianglePiece, 4)

struct PieceCountArgs {
  TriangleSource source;
  RasterTarget target;
  REF(uint) counts;  ///< triangle_count + 1
};

struct PieceSetupArgs {
  TriangleSource source;
  RasterTarget target;
  REF(uint) offsets;  ///< triangle_count + 1
  REF(TrianglePiece) pieces;
  uint capacity;
  uint depth_mode;
};

struct TileCountArgs {
  RasterTarget target;
  REF(uint) piece_count;
  REF(TrianglePiece) pieces;
  REF(uint) counts;  ///< capacity + 1
  uint capacity;
  uint padding;
};

struct TileEmitArgs {
  RasterTarget target;
  REF(uint) piece_count;
  REF(TrianglePiece) pieces;
  REF(uint) offsets;
  REF(uint) keys;    ///< tile
  REF(uint) values;  ///< piece
  uint capacity;
  uint pair_capacity;
};

struct TileSetupArgs {
  REF(uint) pair_count;
  REF(uint) keys;
  REF(uint) values;
  REF(TrianglePiece) pieces;
  REF(TileTriangle) triangles;
  uint capacity;
  uint tiles_x;
};

struct TileRangeArgs {
  REF(uint) pair_count;
  REF(uint) keys;
  REF(uint) begins;  ///< tile_count + 1
  uint capacity;
  uint tile_count;
};

struct TileRasterArgs {
  REF(uint) begins;
  REF(TileTriangle) triangles;
  REF(uint) elements;
  REF(float) depths;
  REF(uint) counts;  ///< coverage only
  uint width;
  uint height;
  uint tiles_x;
  uint tile_count;
  float log_scale;  ///< logarithmic: depth = log_scale log2(log_near / w)
  float log_near;
};

struct ScanArgs {
  REF(uint) values;
  REF(uint) sums;
  uint count;
  uint block;
};

struct RadixArgs {
  REF(uint) count;  ///< elements; at most capacity are sorted
  REF(uint) keys;
  REF(uint) values;
  REF(uint) sorted_keys;
  REF(uint) sorted_values;
  REF(uint) counters;  ///< 256 digits x blocks
  uint capacity;
  uint blocks;
  uint block;  ///< elements a block
  uint shift;
};

struct FloatKeyArgs {
  REF(float) depths;
  REF(uint) keys;
  REF(uint) values;
  uint count;
  uint padding;
};

struct GatherTriangleArgs {
  REF(uvec3) triangles;
  REF(uint) order;
  REF(uvec3) sorted;
  uint count;
  uint padding;
};

struct PainterKeyArgs {
  TriangleSource source;
  REF(float) keys;
};

struct ClippedRecord {
  uint count;
  vec4 position[10];
  vec3 barycentric[10];
};
REF_TYPE(ClippedRecord, 4)

struct ClipArgs {
  TriangleSource source;
  REF(ClippedRecord) polygons;
  float guard_band;
  uint padding;
};

struct ViewportArgs {
  REF(vec4) clip_positions;
  REF(vec4) window_positions;
  uint count;
  uint width;
  uint height;
  uint padding;
};

struct ScanlineArgs {
  RasterTarget target;
  REF(TrianglePiece) pieces;
  REF(uint) counts;
  REF(uint) elements;
  uint first_piece;
  uint last_piece;
};

struct InterpolateArgs {
  TriangleSource source;
  REF(vec4) varyings;
  REF(uint) elements;
  REF(vec4) result;
  uint width;
  uint height;
  uint perspective;
  uint padding;
};

/// Of all fixed-function pipelines of the stages.
struct DrawArgs {
  REF(vec4) clip_positions;
  REF(uvec3) triangles;
  REF(vec4) varyings;
  uint perspective;
  uint first_element;
  float log_scale;
  float log_near;
};

struct FetchSamplesArgs {
  REF(float) counts;
  REF(uint) elements;
  uint width;
  uint height;
  uint samples;
  uint padding;
};

struct BlendArgs {
  REF(vec4) layers;  ///< layer after layer
  REF(vec4) result;
  uint pixel_count;
  uint layer_count;
  uint mode;
  uint padding;
};

struct FullScreenArgs {
  REF(vec4) texels;
  uint width;
  uint height;
};

struct LineArgs {
  REF(ivec4) segments;  ///< begin, end
  REF(uint) offsets;
  REF(ivec2) pixels;
  uint segment_count;
  uint padding;
};

struct PolygonArgs {
  REF(vec4) edges;  ///< begin, end
  REF(uint) inside;
  uint edge_count;
  uint width;
  uint height;
  uint rule;
};

struct EncodeArgs {
  REF(vec4) colors;
  REF(uint) codes;        ///< red in the lowest byte
  REF(float) thresholds;  ///< 256: the least linear value of each code; [0] is 0
  uint count;
  float scale;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
