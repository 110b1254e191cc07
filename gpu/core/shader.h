#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace parity::gpu {

/// A compiled shader, embedded by the build as
/// `parity::gpu::shaders::<chapter>_<stage>_<comp|vert|frag>` in "shaders.h" (generated).
struct ShaderCode {
  const char* name;
  std::span<const std::uint32_t> words;
};

/// What SPIR-V says of itself; read by Kernel and RasterPipeline to check what C++ believes.
struct ShaderReflection {
  struct Descriptor {
    int set = 0;
    int binding = 0;
    enum class Kind { sampled_image, storage_image } kind = Kind::sampled_image;
  };
  std::uint32_t push_constant_bytes = 0;
  std::uint32_t local_size[3] = {1, 1, 1};    ///< defaults, before specialization
  int local_size_constant[3] = {-1, -1, -1};  ///< constant_id of each, -1: fixed
  std::vector<std::uint32_t> specialization_ids;
  std::vector<Descriptor> descriptors;
};

/// @throws Error  (invalid_shader) the words are not a SPIR-V module.
ShaderReflection reflect(const ShaderCode& code);

/// Value of `layout(constant_id = id)`; bool as 0 or 1, float through std::bit_cast.
struct Specialization {
  std::uint32_t id = 0;
  std::uint32_t value = 0;
  bool operator==(const Specialization&) const = default;
};

}  // namespace parity::gpu
