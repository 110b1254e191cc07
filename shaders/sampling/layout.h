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

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
