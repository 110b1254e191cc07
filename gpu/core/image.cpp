#include "gpu/core/image.h"

#include <algorithm>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

/// What the image may be used for, as far as its format allows.
VkImageUsageFlags usage_of(VkFormatFeatureFlags features, bool multisampled,
                           bool store_multisampled) {
  const std::pair<VkFormatFeatureFlags, VkImageUsageFlags> uses[] = {
      {VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, VK_IMAGE_USAGE_SAMPLED_BIT},
      {VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, VK_IMAGE_USAGE_STORAGE_BIT},
      {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
      {VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
      {VK_FORMAT_FEATURE_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
      {VK_FORMAT_FEATURE_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT}};
  VkImageUsageFlags usage = 0;
  for (const auto& [feature, use] : uses)
    if ((features & feature) != 0) usage |= use;
  if (multisampled && !store_multisampled) usage &= ~VkImageUsageFlags{VK_IMAGE_USAGE_STORAGE_BIT};
  return usage;
}

std::string text(const ImageOptions& options) {
  return std::to_string(options.width) + "x" + std::to_string(options.height) + ", " +
         std::to_string(options.levels) + " levels, " + std::to_string(options.samples) +
         " samples";
}

void check_sizes(const ImageOptions& options) {
  const int longest = std::max(options.width, options.height);
  int most_levels = 1;
  while (longest >> most_levels > 0) ++most_levels;
  const bool power_of_two = options.samples > 0 && (options.samples & (options.samples - 1)) == 0;
  if (options.width < 1 || options.height < 1 || options.levels < 1 ||
      options.levels > most_levels || !power_of_two || (options.samples > 1 && options.levels > 1))
    throw std::invalid_argument("Image: no such image: " + text(options));
}

/// The device's answer to whether it can make the image.
bool device_offers(VkPhysicalDevice physical, const VkImageCreateInfo& info) {
  VkImageFormatProperties limits{};
  const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
      physical, info.format, info.imageType, info.tiling, info.usage, info.flags, &limits);
  if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) return false;
  check(result, "vkGetPhysicalDeviceImageFormatProperties");
  return info.extent.width <= limits.maxExtent.width &&
         info.extent.height <= limits.maxExtent.height && info.mipLevels <= limits.maxMipLevels &&
         (limits.sampleCounts & info.samples) != 0;
}

VkImageAspectFlags aspect_of(Format format) {
  return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

OwnedImageView make_view(const Image::State& state, std::uint32_t level, std::uint32_t levels) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = state.image.get();
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = vulkan_format(state.options.format);
  info.subresourceRange = {aspect_of(state.options.format), level, levels, 0, 1};
  return create<OwnedImageView>(state.context.link(), vkCreateImageView, info, "vkCreateImageView");
}

/// Images stay in the general layout all their life.
void make_general(const Image::State& state) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = state.image.get();
  barrier.subresourceRange = {aspect_of(state.options.format), 0, VK_REMAINING_MIP_LEVELS, 0, 1};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  const VkCommandBuffer commands = state.context.submission->begin_transfer();
  vkCmdPipelineBarrier2(commands, &dependency);
  state.context.submission->submit_and_wait(commands);
}

VkImageCreateInfo image_info(const ContextState& context, const ImageOptions& options,
                             VkFormatFeatureFlags features) {
  VkPhysicalDeviceFeatures device{};
  vkGetPhysicalDeviceFeatures(context.physical, &device);
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = vulkan_format(options.format);
  info.extent = {static_cast<std::uint32_t>(options.width),
                 static_cast<std::uint32_t>(options.height), 1};
  info.mipLevels = static_cast<std::uint32_t>(options.levels);
  info.arrayLayers = 1;
  info.samples = static_cast<VkSampleCountFlagBits>(options.samples);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage =
      usage_of(features, options.samples > 1, device.shaderStorageImageMultisample == VK_TRUE);
  return info;
}

VkSamplerAddressMode address_mode(SamplerOptions::Wrap wrap) {
  switch (wrap) {
    case SamplerOptions::Wrap::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case SamplerOptions::Wrap::mirrored_repeat:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case SamplerOptions::Wrap::clamp_to_edge:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case SamplerOptions::Wrap::clamp_to_border:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    case SamplerOptions::Wrap::mirror_clamp_to_edge:
      return VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE;
  }
  throw std::invalid_argument("ImageSampler: unknown wrap mode");
}

VkFilter filter(bool linear) { return linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST; }

}  // namespace

std::size_t texel_bytes(Format format) {
  switch (format) {
    case Format::r32_uint:
    case Format::r32_float:
    case Format::rgba8:
    case Format::rgba8_srgb:
    case Format::d32_float:
      return 4;
    case Format::rgba16_float:
      return 8;
    case Format::rgba32_float:
      return 16;
  }
  throw std::invalid_argument("texel_bytes: unknown format");
}

VkFormat vulkan_format(Format format) {
  switch (format) {
    case Format::r32_uint:
      return VK_FORMAT_R32_UINT;
    case Format::r32_float:
      return VK_FORMAT_R32_SFLOAT;
    case Format::rgba8:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::rgba8_srgb:
      return VK_FORMAT_R8G8B8A8_SRGB;
    case Format::rgba16_float:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::rgba32_float:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::d32_float:
      return VK_FORMAT_D32_SFLOAT;
  }
  throw std::invalid_argument("Image: unknown format");
}

bool is_depth(Format format) { return format == Format::d32_float; }

Image::State::~State() { context.memory_bytes -= counted; }

Image::Image(Context& context, const ImageOptions& options) {
  check_sizes(options);
  ContextState& shared = context.state();
  state_ = std::make_unique<State>(shared);
  State& state = *state_;
  state.options = options;
  VkFormatProperties format{};
  vkGetPhysicalDeviceFormatProperties(shared.physical, vulkan_format(options.format), &format);
  state.features = format.optimalTilingFeatures;
  const VkImageCreateInfo info = image_info(shared, options, state.features);
  state.usage = info.usage;
  if (!device_offers(shared.physical, info))
    throw Error(ErrorKind::missing_feature, "device " + shared.info.name +
                                                " does not offer an image of " + text(options) +
                                                " in that format");
  state.image = create<OwnedImage>(shared.link(), vkCreateImage, info, "vkCreateImage");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(shared.link().device, state.image.get(), &needs);
  state.memory =
      OwnedAllocation(*shared.memory, shared.memory->allocate(needs, MemoryUse::fast, false));
  const Allocation& part = state.memory.get();
  check(vkBindImageMemory(shared.link().device, state.image.get(), part.memory, part.offset),
        "vkBindImageMemory");
  state.view = make_view(state, 0, info.mipLevels);
  for (std::uint32_t level = 0; level < info.mipLevels; ++level)
    state.levels.push_back(make_view(state, level, 1));
  make_general(state);
  shared.count_bytes(needs.size);
  state.counted = needs.size;
}

Image::~Image() = default;
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;

const ImageOptions& Image::options() const { return state_->options; }

ImageSampler::ImageSampler(Context& context, const SamplerOptions& options)
    : state_(std::make_unique<State>()) {
  const ContextState& shared = context.state();
  constexpr auto once = SamplerOptions::Wrap::mirror_clamp_to_edge;
  if ((options.wrap_u == once || options.wrap_v == once) && !shared.device->mirror_clamp)
    throw Error(ErrorKind::missing_feature,
                "device " + shared.info.name + " lacks samplerMirrorClampToEdge");
  const float most = shared.properties.limits.maxSamplerAnisotropy;
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = filter(options.linear_mag);
  info.minFilter = filter(options.linear_min);
  info.mipmapMode =
      options.linear_mip ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = address_mode(options.wrap_u);
  info.addressModeV = address_mode(options.wrap_v);
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.mipLodBias = options.lod_bias;
  info.minLod = options.min_lod;
  info.maxLod = options.max_lod;
  info.anisotropyEnable = options.max_anisotropy > 1 && most > 1 ? VK_TRUE : VK_FALSE;
  info.maxAnisotropy = std::clamp(options.max_anisotropy, 1.0f, std::max(most, 1.0f));
  info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  state_->sampler = create<OwnedSampler>(shared.link(), vkCreateSampler, info, "vkCreateSampler");
}

ImageSampler::~ImageSampler() = default;
ImageSampler::ImageSampler(ImageSampler&&) noexcept = default;
ImageSampler& ImageSampler::operator=(ImageSampler&&) noexcept = default;

}  // namespace parity::gpu
