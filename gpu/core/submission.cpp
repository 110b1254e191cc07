#include <algorithm>
#include <cstdio>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t queries_in_pool = 64;
constexpr std::uint32_t sets_in_pool = 64;

std::uint64_t nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::clamp(seconds, 0.0, 1e9) * 1e9);
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", seconds);
  return text;
}

VkCommandBuffer restart(VkCommandBuffer commands) {
  check(vkResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
  return commands;
}

}  // namespace

Submission::Submission(DeviceLink& link, std::uint32_t queue_family, double timeout_seconds)
    : link_(link), timeout_seconds_(timeout_seconds) {
  vkGetDeviceQueue(link.device, queue_family, 0, &queue_);
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = queue_family;
  command_pool_ = create<OwnedCommandPool>(link, vkCreateCommandPool, pool, "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = command_pool_.get();
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(link.device, &allocate, &commands_), "vkAllocateCommandBuffers");
  check(vkAllocateCommandBuffers(link.device, &allocate, &transfer_), "vkAllocateCommandBuffers");
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  fence_ = create<OwnedFence>(link, vkCreateFence, fence, "vkCreateFence");
}

VkCommandBuffer Submission::begin() {
  if (!broken_.empty()) throw Error(ErrorKind::device_lost, "the device is lost since " + broken_);
  timestamps_ = 0;
  for (std::size_t i = 0; i < descriptor_pools_used_; ++i)
    check(vkResetDescriptorPool(link_.device, descriptor_pools_[i].get(), 0),
          "vkResetDescriptorPool");
  descriptor_pools_used_ = 0;
  return restart(commands_);
}

VkCommandBuffer Submission::begin_transfer() {
  if (!broken_.empty()) throw Error(ErrorKind::device_lost, "the device is lost since " + broken_);
  return restart(transfer_);
}

void Submission::submit_and_wait(VkCommandBuffer commands) {
  // What the device wrote is visible to the host once the fence has been waited for.
  VkMemoryBarrier2 to_host{};
  to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  to_host.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  to_host.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &to_host;
  vkCmdPipelineBarrier2(commands, &dependency);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");

  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = commands;
  VkSubmitInfo2 submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  const VkFence fence = fence_.get();
  check(vkResetFences(link_.device, 1, &fence), "vkResetFences");
  const VkResult submitted = vkQueueSubmit2(queue_, 1, &submit, fence);
  if (submitted == VK_ERROR_DEVICE_LOST) broken_ = "vkQueueSubmit2 failed";
  check(submitted, "vkQueueSubmit2");
  wait(fence);
}

void Submission::wait(VkFence fence) {
  const auto wait_once = [&] {
    return vkWaitForFences(link_.device, 1, &fence, VK_TRUE, nanoseconds(timeout_seconds_));
  };
  const VkResult waited = wait_once();
  if (waited == VK_SUCCESS) return;
  // Whatever went wrong with waiting, what is in flight must end before anything is destroyed.
  const bool ended =
      waited != VK_TIMEOUT && waited != VK_ERROR_DEVICE_LOST && wait_once() == VK_SUCCESS;
  if (waited == VK_TIMEOUT) {
    link_.abandoned = true;
    broken_ = "a submission did not end within " + seconds_text(timeout_seconds_) + " s";
    throw Error(ErrorKind::timed_out, broken_);
  }
  if (!ended) broken_ = "vkWaitForFences failed: " + result_name(waited);
  check(waited, "vkWaitForFences");
}

void Submission::make_query_pool(VkCommandBuffer commands) {
  const std::size_t pool = timestamps_ / queries_in_pool;
  if (pool == query_pools_.size()) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = queries_in_pool;
    query_pools_.push_back(
        create<OwnedQueryPool>(link_, vkCreateQueryPool, info, "vkCreateQueryPool"));
  }
  vkCmdResetQueryPool(commands, query_pools_[pool].get(), 0, queries_in_pool);
}

std::size_t Submission::record_timestamp(VkCommandBuffer commands) {
  if (timestamps_ % queries_in_pool == 0) make_query_pool(commands);
  vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                       query_pools_[timestamps_ / queries_in_pool].get(),
                       static_cast<std::uint32_t>(timestamps_ % queries_in_pool));
  return timestamps_++;
}

std::vector<std::uint64_t> Submission::read_timestamps() const {
  std::vector<std::uint64_t> ticks(timestamps_);
  for (std::size_t first = 0; first < timestamps_; first += queries_in_pool) {
    const std::size_t count = std::min<std::size_t>(queries_in_pool, timestamps_ - first);
    check(vkGetQueryPoolResults(link_.device, query_pools_[first / queries_in_pool].get(), 0,
                                static_cast<std::uint32_t>(count), count * sizeof(std::uint64_t),
                                ticks.data() + first, sizeof(std::uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
  }
  return ticks;
}

VkDescriptorSet Submission::allocate_set(VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  if (descriptor_pools_used_ > 0) {
    info.descriptorPool = descriptor_pools_[descriptor_pools_used_ - 1].get();
    const VkResult result = vkAllocateDescriptorSets(link_.device, &info, &set);
    if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL) {
      check(result, "vkAllocateDescriptorSets");
      return set;
    }
  }
  if (descriptor_pools_used_ == descriptor_pools_.size()) {
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8 * sets_in_pool},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 8 * sets_in_pool}};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = sets_in_pool;
    pool.poolSizeCount = std::size(sizes);
    pool.pPoolSizes = sizes;
    descriptor_pools_.push_back(
        create<OwnedDescriptorPool>(link_, vkCreateDescriptorPool, pool, "vkCreateDescriptorPool"));
  }
  info.descriptorPool = descriptor_pools_[descriptor_pools_used_++].get();
  check(vkAllocateDescriptorSets(link_.device, &info, &set), "vkAllocateDescriptorSets");
  return set;
}

}  // namespace parity::gpu
