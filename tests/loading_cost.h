#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace parity {

/// A GLB of a waved square of `side` x `side` quads with normals and texture coordinates: two
/// triangles each, a million at 708.
std::vector<std::byte> waved_square(std::uint32_t side);

struct LoadingCost {
  double seconds = 0;     ///< of the processor
  double wall = 0;        ///< seconds that it took
  std::size_t bytes = 0;  ///< most that the process grew by
  std::size_t triangles = 0;
};

/// What it takes to load a scene, measured in a process of its own; zeros if that failed.
LoadingCost cost_of_loading(const std::filesystem::path& file);

}  // namespace parity
