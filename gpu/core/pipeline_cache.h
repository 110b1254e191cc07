#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/core/raster_pipeline.h"
#include "gpu/core/shader.h"

namespace parity::gpu {

/// Everything that a pipeline is built from; equal keys, equal pipelines.
struct PipelineKey {
  /// `shaders` with their names; `options` of a compute pipeline hold its specializations only.
  PipelineKey(std::span<const ShaderCode> shaders, std::size_t args_size, RasterOptions all_options)
      : args_bytes(args_size), options(std::move(all_options)) {
    for (const ShaderCode& shader : shaders) {
      names.emplace_back(shader.name);
      words.emplace_back(shader.words.begin(), shader.words.end());
    }
  }
  bool operator==(const PipelineKey&) const = default;

  std::size_t args_bytes;
  RasterOptions options;
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> words;
};

/// Pipelines that were built before, shared by all who ask for the same one.
template <typename State>
class PipelineCache {
 public:
  /// The pipeline of that key; `build` makes it if there is none. Nothing is kept if it throws.
  template <typename Build>
  std::shared_ptr<const State> find(PipelineKey key, const Build& build) {
    for (const auto& [known, state] : entries_)
      if (known == key) return state;
    if (entries_.size() >= most_entries) drop_unused();
    std::shared_ptr<const State> state = build();
    entries_.emplace_back(std::move(key), state);
    return state;
  }

  void drop_unused() {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.use_count() == 1; });
  }

  std::size_t size() const { return entries_.size(); }

 private:
  /// So many that programs that specialise without end do not keep everything.
  static constexpr std::size_t most_entries = 512;
  std::vector<std::pair<PipelineKey, std::shared_ptr<const State>>> entries_;
};

}  // namespace parity::gpu
