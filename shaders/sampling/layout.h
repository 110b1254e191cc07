// What the kernels of the sampling chapter and their hosts share. Fields only.
#ifndef PARITY_SAMPLING_LAYOUT_H
#define PARITY_SAMPLING_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// One pass of a Fourier transform over lines of `count` complex numbers. Element e of line l is at
/// e element_stride + l line_stride.
struct SpectrumArgs {
  REF(vec2) from;
  REF(vec2) to;
  REF(vec2) roots;  ///< exp(-+2 pi i k / count), k < count
  uint count;
  uint lines;
  uint element_stride;
  uint line_stride;
  uint radix;
  uint done;  ///< product of the radices of the passes before
  float scale;
  uint lines_first;  ///< threads run over lines first, else over elements
};

/// Resamples along one axis. Texel e of line l is at e element_stride + l line_stride.
struct ReconstructArgs {
  REF(vec4) from;
  REF(vec4) to;
  uint in_count;
  uint out_count;
  uint lines;
  uint in_element_stride;
  uint in_line_stride;
  uint out_element_stride;
  uint out_line_stride;
  uint lines_first;
  uint filter_kind;  ///< number of ReconstructionFilter
};

struct PatternArgs {
  REF(vec2) samples;
  uint pattern;  ///< number of SamplePattern; not blue noise
  uint count;
  uint columns;  ///< of the strata; columns rows = count
  uint seed;
};

/// Blue noise, one sample a dispatch, places in 2^-15 px.
struct BlueNoiseArgs {
  REF(uvec2) places;
  uint done;
  uint seed;
};

/// Area of polygons in pixels. Edge: begin, end, px.
struct AreaCoverageArgs {
  REF(vec4) edges;
  REF(float) areas;
  uint width;
  uint height;
  uint first_edge;
  uint last_edge;
};

/// One step of temporal accumulation. Colours hold in w how many frames they stand for.
struct TemporalArgs {
  REF(vec4) current;
  REF(vec4) history;
  REF(vec2) motion;  ///< px: the pixel's middle was at p + motion in the frame before
  REF(vec4) result;
  uint width;
  uint height;
  float longest;  ///< history, frames
  uint clamps;    ///< history is held to the range of the 3x3 neighbours
};

/// Adds a frame to a picture that is the mean of several.
struct FrameSumArgs {
  REF(uint) words;  ///< RGBA16F of the frame
  REF(vec4) colors;
  uint pixel_count;
  uint is_first;
  float weight;
};

/// Which pixels need more samples. Rows of 8 pixels are in the order of tiles of 8x8 pixels; pixels
/// outside of the picture never need any.
struct PixelNeedArgs {
  REF(uint) words;     ///< RGBA16F of the frame
  REF(uint) codes;     ///< one a pixel: what a screen shows, 8 bits a channel, and alpha
  REF(uint) averages;  ///< RGBA16F: means over pixels that need no more
  REF(uint) masks;     ///< one a row: bit x is set where pixel x needs more
  REF(uint) counts;    ///< of a row's pixels that do; scanned: of all rows before
  REF(uint) pixels;    ///< y width + x of those that do
  uint width;
  uint height;
  uint tiles_x;
  uint row_count;    ///< 8 a tile
  float gain;        ///< of the display, linear
  float contrast;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
