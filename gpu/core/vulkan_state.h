#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/context.h"
#include "gpu/core/image.h"
#include "gpu/core/kernel.h"
#include "gpu/core/pipeline_cache.h"
#include "gpu/core/raster_pipeline.h"
#include "gpu/core/shader.h"
#include "gpu/core/vulkan_handles.h"
#include "gpu/core/vulkan_memory.h"

// What stands behind the classes of gpu/core: Vulkan's handles. Only gpu/core/*.cpp include this.
namespace parity::gpu {

// ---- validation.cpp ----

/// What the validation layer said.
struct ValidationLog {
  std::vector<std::string> messages;
};

/// How the layer reports to `log`.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log);

/// Whether the checks that the layer puts into shaders can be trusted on the device.
bool can_assist(const DeviceInfo& device);

/// @throws Error  the layer is not installed.
void require_validation_layer();

// ---- device.cpp ----

/// A Vulkan instance, with the validation layer if there is a log for it.
class Instance {
 public:
  /// @throws Error  no loader, no driver, no layer.
  Instance(ValidationLog* log, bool gpu_assisted);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  VkInstance get() const { return instance_; }
  std::vector<VkPhysicalDevice> devices() const;

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

DeviceInfo describe(VkPhysicalDevice device, int index);

/// Index of the device that the name (or PARITY_DEVICE, or the fastest type) chooses.
///
/// @throws Error  no such device, or none that fits.
int choose_device(const std::vector<DeviceInfo>& devices, const std::string& name);

/// The first queue family with graphics, compute and copies.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice device);

class Device {
 public:
  Device(VkPhysicalDevice physical, const DeviceInfo& info);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  DeviceLink link;
  bool bresenham_lines = false;  ///< VK_EXT_line_rasterization
  bool mirror_clamp = false;     ///< samplerMirrorClampToEdge
};

// ---- submission.cpp ----

/// A VkBuffer with its memory.
struct MemoryBuffer {
  OwnedAllocation allocation;  // freed after the buffer
  OwnedBuffer buffer;
};

/// What one submission after another uses again: command buffers, fence, queries, descriptor pools.
class Submission {
 public:
  Submission(DeviceLink& link, std::uint32_t queue_family, double timeout_seconds);

  VkCommandBuffer begin();  ///< for Context::run
  VkCommandBuffer
  begin_transfer();  ///< for uploads and downloads, which may happen while recording
  void submit_and_wait(VkCommandBuffer commands);

  /// Records the clock; returns the number of the reading.
  std::size_t record_timestamp(VkCommandBuffer commands);
  std::vector<std::uint64_t> read_timestamps() const;

  /// A set for one dispatch; lives until the next begin().
  VkDescriptorSet allocate_set(VkDescriptorSetLayout layout);

 private:
  void wait(VkFence fence);
  void make_query_pool(VkCommandBuffer commands);

  DeviceLink& link_;
  double timeout_seconds_;
  VkQueue queue_ = VK_NULL_HANDLE;
  OwnedCommandPool command_pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkCommandBuffer transfer_ = VK_NULL_HANDLE;
  OwnedFence fence_;
  std::vector<OwnedQueryPool> query_pools_;
  std::size_t timestamps_ = 0;
  std::vector<OwnedDescriptorPool> descriptor_pools_;
  std::size_t descriptor_pools_used_ = 0;
  std::string broken_;  ///< why nothing can be submitted any more
};

// ---- context.cpp ----

struct ContextState {
  ContextState(const ContextOptions& context_options,
               std::unique_ptr<ValidationLog> validation_log);

  ContextOptions options;
  std::unique_ptr<ValidationLog> log;
  std::optional<Instance> instance;
  DeviceInfo info;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  std::uint32_t queue_family = 0;
  double seconds_per_tick = 0;
  std::uint64_t tick_mask = 0;
  bool staged = false;  ///< the host cannot see the buffers: bytes go through `staging`
  std::optional<Device> device;
  std::optional<MemoryPool> memory;
  std::optional<Submission> submission;
  std::optional<OwnedSampler> nearest;  ///< for sampled images without a sampler
  PipelineCache<RawKernel::State> kernels;
  PipelineCache<RawRasterPipeline::State> raster_pipelines;
  MemoryBuffer staging;
  std::list<RawBuffer::State*> guarded;  ///< buffers whose zones are checked after each run
  std::uint64_t memory_bytes = 0;
  std::uint64_t peak_memory_bytes = 0;
  double device_seconds = 0;
  bool recording = false;

  const DeviceLink& link() const { return device->link; }
  void count_bytes(std::uint64_t bytes);
};

/// Whether loops of 65,536 or 300 x 300 steps end early, as Mesa 22.3's do without a word.
bool cuts_loops_short(Context& context);

/// One full memory barrier; what comes before it, of any kind, is finished and visible after it.
void full_barrier(VkCommandBuffer commands);

// ---- buffer.cpp ----

/// Pages of the host that a buffer lies in, between two that cannot be touched.
class FencedPages {
 public:
  FencedPages() = default;
  explicit FencedPages(std::size_t bytes);
  ~FencedPages();
  FencedPages(FencedPages&& other) noexcept;
  FencedPages& operator=(FencedPages&& other) noexcept;
  std::byte* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }
  void leak() { data_ = nullptr; }  ///< for a device that was given up on

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

struct RawBuffer::State {
  explicit State(ContextState& state) : context(state) {}
  ~State();
  ContextState& context;
  FencedPages pages;
  OwnedMemory imported;
  MemoryBuffer memory;  ///< with the zones
  OwnedBuffer inner;    ///< without: what the validation layer takes the addresses from
  VkBuffer buffer = VK_NULL_HANDLE;  ///< what commands use
  std::size_t start = 0;             ///< of the elements in `buffer`
  std::byte* mapped = nullptr;       ///< of the first byte of `memory`; null: staged
  std::size_t before = 0;            ///< bytes of `memory` before the elements
  std::size_t bytes = 0;             ///< of the elements
  std::size_t total = 0;             ///< of `memory`
  std::uint64_t address = 0;         ///< of the elements
  std::uint64_t counted = 0;         ///< in ContextState::memory_bytes
  std::optional<std::list<RawBuffer::State*>::iterator> guard_entry;
};

/// A VkBuffer of our own use.
MemoryBuffer make_buffer(ContextState& context, std::size_t bytes, MemoryUse use);

/// @throws Error  (broken_guard) naming the first buffer that was written past its end or start.
void check_zones(ContextState& context);

// ---- image.cpp ----

VkFormat vulkan_format(Format format);
bool is_depth(Format format);

struct Image::State {
  explicit State(ContextState& state) : context(state) {}
  ~State();
  ContextState& context;
  ImageOptions options;
  OwnedAllocation memory;
  OwnedImage image;
  OwnedImageView view;                 ///< all levels
  std::vector<OwnedImageView> levels;  ///< one level each
  VkImageUsageFlags usage = 0;
  VkFormatFeatureFlags features = 0;
  std::uint64_t counted = 0;
};

struct ImageSampler::State {
  OwnedSampler sampler;
};

// ---- kernel.cpp ----

OwnedShader make_shader(ContextState& context, const ShaderCode& code);

/// The images that a shader reads or stores to.
struct ShaderImages {
  const std::string& name;  ///< of the shader
  const std::vector<ShaderReflection::Descriptor>& descriptors;
};

/// @throws Error  an image is not in set 0.
OwnedSetLayout make_set_layout(const ContextState& context, const ShaderImages& images,
                               VkShaderStageFlags stage);

/// Specialization constants in Vulkan's form; points into itself.
struct SpecializationData {
  explicit SpecializationData(const std::vector<Specialization>& specializations);
  SpecializationData(const SpecializationData&) = delete;
  SpecializationData& operator=(const SpecializationData&) = delete;
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  VkSpecializationInfo info{};
};

/// @throws Error  the push constants are not as large as Args, or larger than the device's.
void check_args(const ContextState& context, const char* name, std::uint32_t shader_bytes,
                std::size_t args_bytes);

struct RawKernel::State {
  std::string name;
  ShaderReflection reflection;
  std::uint32_t local_size[3] = {1, 1, 1};
  OwnedSetLayout set_layout;  ///< none: no images
  OwnedPipelineLayout layout;
  OwnedPipeline pipeline;
  std::uint32_t args_bytes = 0;
};

// ---- raster_pipeline.cpp ----

struct RawRasterPipeline::State {
  std::string name;
  RasterOptions options;
  std::vector<ShaderReflection::Descriptor> descriptors;  ///< of the fragment shader
  OwnedSetLayout set_layout;                              ///< none: no images
  OwnedPipelineLayout layout;
  OwnedPipeline pipeline;
  std::uint32_t args_bytes = 0;
};

// ---- commands.cpp ----

struct RenderPass::State {
  ContextState& context;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  std::vector<Format> colors;
  std::optional<Format> depth;
  int samples = 1;
  std::optional<std::pair<Culling, bool>> culling;
  std::vector<ImageBinding> images;
};

struct Commands::State {
  ContextState& context;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  std::vector<std::string> passes;
  bool rendering = false;
};

}  // namespace parity::gpu
