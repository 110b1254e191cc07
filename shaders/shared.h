// The one header that C++ and GLSL share besides the layouts. REF_TYPE(T, A) declares buffers of T,
// aligned to A bytes; REF(T) is the address of one: BufferRef<T> in C++, a scalar-layout buffer
// reference in GLSL, read and written as `ref.at[i]`. Sources: GL_EXT_buffer_reference.
#ifndef PARITY_SHARED_H
#define PARITY_SHARED_H

#ifdef __cplusplus

#include <cstdint>

#include "geometry/math.h"

namespace parity {

using uint = std::uint32_t;

/// Address of elements of type T on the device.
template <typename T>
struct BufferRef {
  std::uint64_t address = 0;
};

}  // namespace parity

#define REF_TYPE(T, A)
#define REF(T) BufferRef<T>

#else

#define REF_TYPE(T, A) \
  layout(buffer_reference, scalar, buffer_reference_align = A) buffer ref_##T { T at[]; };
#define REF(T) ref_##T

REF_TYPE(uint, 4)
REF_TYPE(int, 4)
REF_TYPE(float, 4)
REF_TYPE(uvec2, 4)
REF_TYPE(uvec3, 4)
REF_TYPE(uvec4, 4)
REF_TYPE(ivec2, 4)
REF_TYPE(ivec4, 4)
REF_TYPE(vec2, 4)
REF_TYPE(vec3, 4)
REF_TYPE(vec4, 4)
REF_TYPE(mat3, 4)
REF_TYPE(mat4, 4)

#endif
#endif
