#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/image.h"
#include "gpu/core/kernel.h"
#include "gpu/core/raster_pipeline.h"

namespace parity::gpu {

/// Threads of a dispatch; rounded up to whole workgroups. Kernels guard their edges.
struct Threads {
  std::uint32_t x = 1;
  std::uint32_t y = 1;
  std::uint32_t z = 1;
};

/// One colour target: cleared first if `clear` is set (integers bit-cast), else kept.
struct ColorTarget {
  const Image* image = nullptr;
  std::optional<std::array<float, 4>> clear;
  const Image* resolve =
      nullptr;  ///< average of the samples (integers: sample 0) goes here at the end
};

struct DepthTarget {
  const Image* image = nullptr;
  std::optional<float> clear;
  const Image* resolve = nullptr;  ///< sample 0 goes here at the end
};

struct RenderTargets {
  std::vector<ColorTarget> colors;
  std::optional<DepthTarget> depth;
};

/// Layout of VkDrawIndexedIndirectCommand.
struct IndexedDraw {
  std::uint32_t index_count = 0;
  std::uint32_t instance_count = 1;
  std::uint32_t first_index = 0;
  std::int32_t vertex_offset = 0;
  std::uint32_t first_instance = 0;
};

/// Draws between the begin and the end of one render pass.
class RenderPass {
 public:
  /// `count` vertices, not indexed.
  template <typename Args>
  void draw(const RasterPipeline<Args>& pipeline, const Args& args, std::uint32_t vertex_count,
            std::uint32_t instance_count = 1, std::uint32_t first_vertex = 0,
            std::uint32_t first_instance = 0) {
    draw_raw(pipeline.raw(), &args, sizeof(Args), vertex_count, instance_count, first_vertex,
             first_instance);
  }
  /// Images that the fragment shaders of the draws that follow read, by binding.
  void bind(std::span<const ImageBinding> images);
  /// One indexed draw after another. gl_InstanceIndex counts from first_instance.
  template <typename Args>
  void draw_indexed(const RasterPipeline<Args>& pipeline, const Args& args,
                    const Buffer<std::uint32_t>& indices, std::span<const IndexedDraw> draws) {
    draw_indexed_raw(pipeline.raw(), &args, sizeof(Args), indices.raw(), draws);
  }
  /// Winding and culling for the draws that follow, instead of the pipeline's.
  void set_culling(Culling culling, bool mirrored);

  struct State;  // for gpu/core only
  explicit RenderPass(State& state) : state_(state) {}

 private:
  void draw_raw(const RawRasterPipeline& pipeline, const void* args, std::size_t args_bytes,
                std::uint32_t vertex_count, std::uint32_t instance_count,
                std::uint32_t first_vertex, std::uint32_t first_instance);
  void draw_indexed_raw(const RawRasterPipeline& pipeline, const void* args, std::size_t args_bytes,
                        const RawBuffer& indices, std::span<const IndexedDraw> draws);

  State& state_;
};

/// Records work for one submission. A full memory barrier stands before each command: the one place
/// that decides barriers. Images are in the layout that each command needs by themselves.
class Commands {
 public:
  /// Names what follows, up to the next name; its time appears in Timing::passes.
  void pass(const std::string& name);

  /// @throws std::invalid_argument  a bound image is missing for a descriptor of the kernel.
  template <typename Args>
  void dispatch(const Kernel<Args>& kernel, Threads threads, const Args& args,
                std::span<const ImageBinding> images = {}) {
    dispatch_raw(kernel.raw(), threads, &args, sizeof(Args), images);
  }

  /// Workgroup counts (not threads) are read from three uints at `first` of `groups`.
  template <typename Args>
  void dispatch_indirect(const Kernel<Args>& kernel, const Buffer<std::uint32_t>& groups,
                         std::size_t first, const Args& args) {
    dispatch_indirect_raw(kernel.raw(), groups.raw(), first * sizeof(std::uint32_t), &args,
                          sizeof(Args));
  }

  void render(const RenderTargets& targets, const std::function<void(RenderPass&)>& record);

  /// Element-wise; both must have room.
  template <typename T>
  void copy(const Buffer<T>& from, const Buffer<T>& to, std::size_t first_from,
            std::size_t first_to, std::size_t count) {
    copy_raw(from.raw(), to.raw(), first_from * sizeof(T), first_to * sizeof(T), count * sizeof(T));
  }
  /// All texels of one level, rows tightly packed.
  template <typename T>
  void copy(const Image& from, const Buffer<T>& to, int level = 0) {
    copy_image_raw(from, to.raw(), level);
  }
  template <typename T>
  void copy(const Buffer<T>& from, const Image& to, int level = 0) {
    copy_to_image_raw(from.raw(), to, level);
  }
  /// Every 4 bytes become `value`.
  template <typename T>
  void fill(const Buffer<T>& buffer, std::uint32_t value) {
    fill_raw(buffer.raw(), value);
  }
  /// Linear filter, level to level: the driver's own mip generation.
  void blit_level(const Image& image, int from_level, int to_level);

  struct State;  // for gpu/core only
  explicit Commands(State& state) : state_(state) {}

 private:
  void dispatch_raw(const RawKernel& kernel, Threads threads, const void* args,
                    std::size_t args_bytes, std::span<const ImageBinding> images);
  void dispatch_indirect_raw(const RawKernel& kernel, const RawBuffer& groups, std::size_t offset,
                             const void* args, std::size_t args_bytes);
  void copy_raw(const RawBuffer& from, const RawBuffer& to, std::size_t from_offset,
                std::size_t to_offset, std::size_t bytes);
  void copy_image_raw(const Image& from, const RawBuffer& to, int level);
  void copy_to_image_raw(const RawBuffer& from, const Image& to, int level);
  void fill_raw(const RawBuffer& buffer, std::uint32_t value);

  State& state_;
};

}  // namespace parity::gpu
