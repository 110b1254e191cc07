#pragma once

#include <volk.h>

#include <string>
#include <utility>

// Handles that destroy themselves. Only gpu/core/*.cpp and vulkan_*.h include this.
namespace parity::gpu {

/// The name of a result, e.g. "VK_ERROR_DEVICE_LOST".
std::string result_name(VkResult result);

/// @throws Error  of the kind that fits, naming the call and the result, if the result is an error.
void check(VkResult result, const char* call);

/// The device, and whether it was given up on: work that never ends runs on it, so that nothing of
/// it can be destroyed any more.
struct DeviceLink {
  VkDevice device = VK_NULL_HANDLE;
  bool abandoned = false;
};

/// Owns a handle that a device made. `destroy` is the pointer that volk fills.
template <typename T, auto* destroy>
class Owned {
 public:
  Owned() = default;
  Owned(const DeviceLink& link, T handle) : link_(&link), handle_(handle) {}
  ~Owned() { reset(); }
  Owned(Owned&& other) noexcept
      : link_(other.link_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(link_, other.link_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  T get() const { return handle_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  void reset() {
    if (handle_ != VK_NULL_HANDLE && !link_->abandoned) (*destroy)(link_->device, handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
  }

  const DeviceLink* link_ = nullptr;
  T handle_ = VK_NULL_HANDLE;
};

using OwnedMemory = Owned<VkDeviceMemory, &vkFreeMemory>;
using OwnedBuffer = Owned<VkBuffer, &vkDestroyBuffer>;
using OwnedImage = Owned<VkImage, &vkDestroyImage>;
using OwnedImageView = Owned<VkImageView, &vkDestroyImageView>;
using OwnedSampler = Owned<VkSampler, &vkDestroySampler>;
using OwnedShader = Owned<VkShaderModule, &vkDestroyShaderModule>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, &vkDestroyPipelineLayout>;
using OwnedPipeline = Owned<VkPipeline, &vkDestroyPipeline>;
using OwnedCommandPool = Owned<VkCommandPool, &vkDestroyCommandPool>;
using OwnedFence = Owned<VkFence, &vkDestroyFence>;
using OwnedQueryPool = Owned<VkQueryPool, &vkDestroyQueryPool>;
using OwnedDescriptorPool = Owned<VkDescriptorPool, &vkDestroyDescriptorPool>;

/// Calls a vkCreate* of the usual form and owns what it made.
template <typename Handle, typename Create, typename CreateInfo>
Handle create(const DeviceLink& link, Create function, const CreateInfo& info, const char* call) {
  using Raw = decltype(std::declval<Handle>().get());
  Raw raw = VK_NULL_HANDLE;
  check(function(link.device, &info, nullptr, &raw), call);
  return Handle(link, raw);
}

}  // namespace parity::gpu
