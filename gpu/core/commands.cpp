#include "gpu/core/commands.h"

#include <algorithm>
#include <cstring>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

static_assert(sizeof(IndexedDraw) == sizeof(VkDrawIndexedIndirectCommand));

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}

/// Every command starts here.
void begin_command(const Commands::State& state) {
  require(!state.rendering, "Commands: a command inside Commands::render");
  full_barrier(state.commands);
}

int level_size(int size, int level) { return std::max(size >> level, 1); }

VkExtent3D level_extent(const ImageOptions& options, int level) {
  return {static_cast<std::uint32_t>(level_size(options.width, level)),
          static_cast<std::uint32_t>(level_size(options.height, level)), 1};
}

VkImageAspectFlags aspect_of(const ImageOptions& options) {
  return is_depth(options.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkImageSubresourceLayers layers(const ImageOptions& options, int level) {
  return {aspect_of(options), static_cast<std::uint32_t>(level), 0, 1};
}

void check_level(const Image& image, int level, const char* call) {
  require(level >= 0 && level < image.options().levels, std::string(call) + ": level " +
                                                            std::to_string(level) + " of " +
                                                            std::to_string(image.options().levels));
}

VkBufferImageCopy whole_level(const Image& image, const RawBuffer& buffer, int level,
                              const char* call) {
  const ImageOptions& options = image.options();
  check_level(image, level, call);
  require(options.samples == 1,
          std::string(call) + ": the image has several samples; resolve it first");
  const VkExtent3D extent = level_extent(options, level);
  const std::size_t needed =
      std::size_t{extent.width} * extent.height * texel_bytes(options.format);
  require(buffer.bytes() >= needed, std::string(call) + ": " + std::to_string(buffer.bytes()) +
                                        " bytes of buffer, " + std::to_string(needed) +
                                        " of texels");
  VkBufferImageCopy region{};
  region.bufferOffset = buffer.state()->start;
  region.imageSubresource = layers(options, level);
  region.imageExtent = extent;
  return region;
}

VkDescriptorImageInfo image_info(const std::string& shader, const ContextState& context,
                                 const ShaderReflection::Descriptor& descriptor,
                                 std::span<const ImageBinding> images) {
  const auto index = static_cast<std::size_t>(descriptor.binding);
  require(index < images.size() && images[index].image != nullptr,
          shader + ": no image for binding " + std::to_string(descriptor.binding));
  const ImageBinding& bound = images[index];
  const Image::State& image = *bound.image->state();
  const bool sampled = descriptor.kind == ShaderReflection::Descriptor::Kind::sampled_image;
  const VkImageUsageFlags use = sampled ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_STORAGE_BIT;
  require((image.usage & use) != 0, shader + ": the image at binding " +
                                        std::to_string(descriptor.binding) + " cannot be " +
                                        (sampled ? "sampled" : "stored to"));
  VkDescriptorImageInfo info{};
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  if (sampled) {
    info.sampler =
        bound.sampler != nullptr ? bound.sampler->state()->sampler.get() : context.nearest->get();
    info.imageView = image.view.get();
  } else {
    check_level(*bound.image, bound.level, shader.c_str());
    info.imageView = image.levels[static_cast<std::size_t>(bound.level)].get();
  }
  return info;
}

/// A pipeline's images and where it takes them from.
struct ImageSlots {
  ShaderImages images;
  VkDescriptorSetLayout set_layout;
  VkPipelineLayout layout;
  VkPipelineBindPoint point;
};

void bind_images(ContextState& context, VkCommandBuffer commands, const ImageSlots& slots,
                 std::span<const ImageBinding> images) {
  const std::vector<ShaderReflection::Descriptor>& descriptors = slots.images.descriptors;
  if (descriptors.empty()) return;
  std::vector<VkDescriptorImageInfo> infos;
  for (const ShaderReflection::Descriptor& each : descriptors)
    infos.push_back(image_info(slots.images.name, context, each, images));
  const VkDescriptorSet set = context.submission->allocate_set(slots.set_layout);
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = static_cast<std::uint32_t>(descriptors[i].binding);
    write.descriptorCount = 1;
    write.descriptorType = descriptors[i].kind == ShaderReflection::Descriptor::Kind::sampled_image
                               ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                               : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    write.pImageInfo = &infos[i];
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(context.link().device, static_cast<std::uint32_t>(writes.size()),
                         writes.data(), 0, nullptr);
  vkCmdBindDescriptorSets(commands, slots.point, slots.layout, 0, 1, &set, 0, nullptr);
}

void bind_kernel(const Commands::State& state, const RawKernel::State& kernel, const void* args) {
  vkCmdBindPipeline(state.commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline.get());
  if (kernel.args_bytes > 0)
    vkCmdPushConstants(state.commands, kernel.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       kernel.args_bytes, args);
}

void check_target(const Image* image, const ImageOptions*& first) {
  require(image != nullptr, "Commands::render: a target has no image");
  const ImageOptions& options = image->options();
  if (first == nullptr) first = &options;
  require(options.width == first->width && options.height == first->height &&
              options.samples == first->samples,
          "Commands::render: the targets differ in size or samples");
}

VkRenderingAttachmentInfo attachment(const Image& image, bool clear) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = image.state()->levels[0].get();
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

void set_resolve(VkRenderingAttachmentInfo& info, const Image& image, const Image& resolve) {
  const ImageOptions& from = image.options();
  const ImageOptions& to = resolve.options();
  require(from.samples > 1 && to.samples == 1 && from.format == to.format &&
              from.width == to.width && from.height == to.height,
          "Commands::render: the resolve target must have the size and format, and one sample");
  const bool averages = from.format != Format::r32_uint && !is_depth(from.format);
  info.resolveMode = averages ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
  info.resolveImageView = resolve.state()->levels[0].get();
  info.resolveImageLayout = VK_IMAGE_LAYOUT_GENERAL;
}

VkRenderingAttachmentInfo color_attachment(const ColorTarget& target) {
  require((target.image->state()->usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) != 0,
          "Commands::render: a colour target's format cannot be drawn to");
  VkRenderingAttachmentInfo info = attachment(*target.image, target.clear.has_value());
  if (target.clear)
    std::memcpy(&info.clearValue.color, target.clear->data(), sizeof(*target.clear));
  if (target.resolve == nullptr) return info;
  set_resolve(info, *target.image, *target.resolve);
  return info;
}

void set_viewport(VkCommandBuffer commands, const ImageOptions& size) {
  const VkViewport viewport{0, 0, static_cast<float>(size.width), static_cast<float>(size.height),
                            0, 1};
  const VkRect2D scissor{{0, 0}, level_extent(size, 0).width, level_extent(size, 0).height};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

void bind_raster(RenderPass::State& pass, const RawRasterPipeline::State& pipeline,
                 const void* args) {
  require(pipeline.options.colors == pass.colors && pipeline.options.depth == pass.depth &&
              pipeline.options.samples == pass.samples,
          pipeline.name + ": formats or samples are not those of the render targets");
  const auto [culling, mirrored] =
      pass.culling.value_or(std::pair(pipeline.options.culling, false));
  vkCmdBindPipeline(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline.get());
  vkCmdSetCullMode(pass.commands, culling == Culling::none   ? VK_CULL_MODE_NONE
                                  : culling == Culling::back ? VK_CULL_MODE_BACK_BIT
                                                             : VK_CULL_MODE_FRONT_BIT);
  // Vulkan's sign of the area already takes y as pointing down: counter-clockwise is as one sees
  // it.
  vkCmdSetFrontFace(pass.commands,
                    mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  bind_images(pass.context, pass.commands,
              {{pipeline.name, pipeline.descriptors},
               pipeline.set_layout.get(),
               pipeline.layout.get(),
               VK_PIPELINE_BIND_POINT_GRAPHICS},
              pass.images);
  if (pipeline.args_bytes > 0)
    vkCmdPushConstants(pass.commands, pipeline.layout.get(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       pipeline.args_bytes, args);
}

}  // namespace

void full_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void Commands::pass(const std::string& name) {
  require(!state_.rendering, "Commands::pass: inside Commands::render");
  if (!state_.context.info.timestamps) return;
  state_.context.submission->record_timestamp(state_.commands);
  state_.passes.push_back(name);
}

void Commands::dispatch_raw(const RawKernel& kernel, Threads threads, const void* args, std::size_t,
                            std::span<const ImageBinding> images) {
  const RawKernel::State& state = *kernel.state();
  const std::uint32_t wanted[3] = {threads.x, threads.y, threads.z};
  const VkPhysicalDeviceLimits& limits = state_.context.properties.limits;
  std::uint32_t groups[3] = {};
  for (int axis = 0; axis < 3; ++axis) {
    groups[axis] = wanted[axis] / state.local_size[axis] +
                   (wanted[axis] % state.local_size[axis] != 0 ? 1 : 0);
    require(groups[axis] <= limits.maxComputeWorkGroupCount[axis],
            state.name + ": " + std::to_string(groups[axis]) + " workgroups on axis " +
                std::to_string(axis) + ", the device takes " +
                std::to_string(limits.maxComputeWorkGroupCount[axis]));
  }
  begin_command(state_);
  bind_images(state_.context, state_.commands,
              {{state.name, state.reflection.descriptors},
               state.set_layout.get(),
               state.layout.get(),
               VK_PIPELINE_BIND_POINT_COMPUTE},
              images);
  bind_kernel(state_, state, args);
  vkCmdDispatch(state_.commands, groups[0], groups[1], groups[2]);
}

void Commands::dispatch_indirect_raw(const RawKernel& kernel, const RawBuffer& groups,
                                     std::size_t offset, const void* args, std::size_t) {
  const RawKernel::State& state = *kernel.state();
  require(!state.set_layout, state.name + ": an indirect dispatch binds no images");
  require(offset + 3 * sizeof(std::uint32_t) <= groups.bytes(),
          state.name + ": three group counts do not fit the buffer");
  begin_command(state_);
  bind_kernel(state_, state, args);
  vkCmdDispatchIndirect(state_.commands, groups.state()->buffer, groups.state()->start + offset);
}

void Commands::render(const RenderTargets& targets,
                      const std::function<void(RenderPass&)>& record) {
  const ImageOptions* size = nullptr;
  std::vector<VkRenderingAttachmentInfo> colors;
  RenderPass::State pass{.context = state_.context, .commands = state_.commands};
  for (const ColorTarget& target : targets.colors) {
    check_target(target.image, size);
    colors.push_back(color_attachment(target));
    pass.colors.push_back(target.image->options().format);
  }
  VkRenderingAttachmentInfo depth{};
  if (targets.depth) {
    check_target(targets.depth->image, size);
    require(is_depth(targets.depth->image->options().format),
            "Commands::render: the depth target is no depth image");
    depth = attachment(*targets.depth->image, targets.depth->clear.has_value());
    depth.clearValue.depthStencil = {targets.depth->clear.value_or(0), 0};
    if (targets.depth->resolve != nullptr)
      set_resolve(depth, *targets.depth->image, *targets.depth->resolve);
    pass.depth = targets.depth->image->options().format;
  }
  require(size != nullptr, "Commands::render: no target");
  pass.samples = size->samples;

  begin_command(state_);
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = {{0, 0}, {level_extent(*size, 0).width, level_extent(*size, 0).height}};
  info.layerCount = 1;
  info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
  info.pColorAttachments = colors.data();
  info.pDepthAttachment = targets.depth ? &depth : nullptr;
  vkCmdBeginRendering(state_.commands, &info);
  set_viewport(state_.commands, *size);
  state_.rendering = true;
  RenderPass render_pass(pass);
  record(render_pass);
  state_.rendering = false;
  vkCmdEndRendering(state_.commands);
}

void RenderPass::bind(std::span<const ImageBinding> images) {
  state_.images.assign(images.begin(), images.end());
}

void RenderPass::set_culling(Culling culling, bool mirrored) {
  state_.culling = std::pair(culling, mirrored);
}

void RenderPass::draw_raw(const RawRasterPipeline& pipeline, const void* args, std::size_t,
                          std::uint32_t vertex_count, std::uint32_t instance_count,
                          std::uint32_t first_vertex, std::uint32_t first_instance) {
  bind_raster(state_, *pipeline.state(), args);
  vkCmdDraw(state_.commands, vertex_count, instance_count, first_vertex, first_instance);
}

void RenderPass::draw_indexed_raw(const RawRasterPipeline& pipeline, const void* args, std::size_t,
                                  const RawBuffer& indices, std::span<const IndexedDraw> draws) {
  const std::size_t index_count = indices.bytes() / sizeof(std::uint32_t);
  for (const IndexedDraw& draw : draws)
    require(draw.first_index <= index_count && draw.index_count <= index_count - draw.first_index,
            pipeline.state()->name + ": a draw reads past the indices");
  bind_raster(state_, *pipeline.state(), args);
  vkCmdBindIndexBuffer(state_.commands, indices.state()->buffer, indices.state()->start,
                       VK_INDEX_TYPE_UINT32);
  for (const IndexedDraw& draw : draws)
    vkCmdDrawIndexed(state_.commands, draw.index_count, draw.instance_count, draw.first_index,
                     draw.vertex_offset, draw.first_instance);
}

void Commands::copy_raw(const RawBuffer& from, const RawBuffer& to, std::size_t from_offset,
                        std::size_t to_offset, std::size_t bytes) {
  require(from_offset <= from.bytes() && bytes <= from.bytes() - from_offset,
          "Commands::copy: reads past the end of the source");
  require(to_offset <= to.bytes() && bytes <= to.bytes() - to_offset,
          "Commands::copy: writes past the end of the target");
  if (bytes == 0) return;
  begin_command(state_);
  const VkBufferCopy region{from.state()->start + from_offset, to.state()->start + to_offset,
                            bytes};
  vkCmdCopyBuffer(state_.commands, from.state()->buffer, to.state()->buffer, 1, &region);
}

void Commands::copy_image_raw(const Image& from, const RawBuffer& to, int level) {
  const VkBufferImageCopy region = whole_level(from, to, level, "Commands::copy(image, buffer)");
  begin_command(state_);
  vkCmdCopyImageToBuffer(state_.commands, from.state()->image.get(), VK_IMAGE_LAYOUT_GENERAL,
                         to.state()->buffer, 1, &region);
}

void Commands::copy_to_image_raw(const RawBuffer& from, const Image& to, int level) {
  const VkBufferImageCopy region = whole_level(to, from, level, "Commands::copy(buffer, image)");
  begin_command(state_);
  vkCmdCopyBufferToImage(state_.commands, from.state()->buffer, to.state()->image.get(),
                         VK_IMAGE_LAYOUT_GENERAL, 1, &region);
}

void Commands::fill_raw(const RawBuffer& buffer, std::uint32_t value) {
  require(buffer.bytes() % 4 == 0,
          "Commands::fill: " + std::to_string(buffer.bytes()) + " bytes, must be a multiple of 4");
  if (buffer.bytes() == 0) return;
  begin_command(state_);
  vkCmdFillBuffer(state_.commands, buffer.state()->buffer, buffer.state()->start, buffer.bytes(),
                  value);
}

void Commands::blit_level(const Image& image, int from_level, int to_level) {
  check_level(image, from_level, "Commands::blit_level");
  check_level(image, to_level, "Commands::blit_level");
  require(from_level != to_level, "Commands::blit_level: from a level to itself");
  const ImageOptions& options = image.options();
  constexpr VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_BLIT_SRC_BIT |
                                          VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                          VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  require((image.state()->features & needed) == needed,
          "Commands::blit_level: the format cannot be filtered");
  VkImageBlit region{};
  const VkExtent3D from = level_extent(options, from_level);
  const VkExtent3D to = level_extent(options, to_level);
  region.srcSubresource = layers(options, from_level);
  region.srcOffsets[1] = {static_cast<std::int32_t>(from.width),
                          static_cast<std::int32_t>(from.height), 1};
  region.dstSubresource = layers(options, to_level);
  region.dstOffsets[1] = {static_cast<std::int32_t>(to.width), static_cast<std::int32_t>(to.height),
                          1};
  begin_command(state_);
  vkCmdBlitImage(state_.commands, image.state()->image.get(), VK_IMAGE_LAYOUT_GENERAL,
                 image.state()->image.get(), VK_IMAGE_LAYOUT_GENERAL, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace parity::gpu
