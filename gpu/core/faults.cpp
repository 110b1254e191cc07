#include "gpu/core/faults.h"

#include "gpu/core/vulkan_state.h"

namespace parity::gpu::faults {
namespace {

Plan active_plan;
Report counts;

VkResult result_of(Fault fault) {
  switch (fault) {
    case Fault::out_of_host_memory:
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    case Fault::out_of_device_memory:
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    case Fault::device_lost:
      return VK_ERROR_DEVICE_LOST;
  }
  return VK_ERROR_UNKNOWN;
}

enum class Effect {
  none,
  creates,
  waits,  ///< fails after it was done: what is in flight must end before things are destroyed
};

/// Stands in for the entry point that `entry` points to.
template <auto* entry>
struct Fallible;

template <typename... Arguments, VkResult(VKAPI_PTR** entry)(Arguments...)>
struct Fallible<entry> {
  static inline VkResult(VKAPI_PTR* original)(Arguments...) = nullptr;
  static inline const char* name = "";
  static inline Effect effect = Effect::none;

  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    const bool fails = ++counts.calls == active_plan.at_call;
    if (fails) counts.failed = name;
    if (fails && effect != Effect::waits) return result_of(active_plan.fault);
    const VkResult result = original(arguments...);
    if (fails) return result_of(active_plan.fault);
    if (effect == Effect::creates && result == VK_SUCCESS) ++counts.live_objects;
    return result;
  }
};

template <auto* entry>
struct Destroying;

template <typename... Arguments, void(VKAPI_PTR** entry)(Arguments...)>
struct Destroying<entry> {
  static inline void(VKAPI_PTR* original)(Arguments...) = nullptr;

  static VKAPI_ATTR void VKAPI_CALL call(Arguments... arguments) {
    --counts.live_objects;
    original(arguments...);
  }
};

PFN_vkCmdPipelineBarrier2 original_barrier = nullptr;

VKAPI_ATTR void VKAPI_CALL barrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
  ++counts.barriers;
  if (!active_plan.skip_barriers || info->imageMemoryBarrierCount > 0)
    original_barrier(commands, info);
}

/// Puts a stand-in into the pointer, or takes it out again.
template <auto* entry>
void fallible(bool install, const char* name, Effect effect = Effect::none) {
  using Hook = Fallible<entry>;
  Hook::name = name;
  Hook::effect = effect;
  if (install) Hook::original = *entry;
  *entry = install ? Hook::call : Hook::original;
}

template <auto* entry>
void destroying(bool install) {
  using Hook = Destroying<entry>;
  if (install) Hook::original = *entry;
  *entry = install ? Hook::call : Hook::original;
}

void switch_creation(bool install) {
  fallible<&vkCreateInstance>(install, "vkCreateInstance", Effect::creates);
  fallible<&vkCreateDevice>(install, "vkCreateDevice", Effect::creates);
  fallible<&vkAllocateMemory>(install, "vkAllocateMemory", Effect::creates);
  fallible<&vkCreateBuffer>(install, "vkCreateBuffer", Effect::creates);
  fallible<&vkCreateImage>(install, "vkCreateImage", Effect::creates);
  fallible<&vkCreateImageView>(install, "vkCreateImageView", Effect::creates);
  fallible<&vkCreateSampler>(install, "vkCreateSampler", Effect::creates);
  fallible<&vkCreateShaderModule>(install, "vkCreateShaderModule", Effect::creates);
  fallible<&vkCreateDescriptorSetLayout>(install, "vkCreateDescriptorSetLayout", Effect::creates);
  fallible<&vkCreatePipelineLayout>(install, "vkCreatePipelineLayout", Effect::creates);
  fallible<&vkCreateComputePipelines>(install, "vkCreateComputePipelines", Effect::creates);
  fallible<&vkCreateGraphicsPipelines>(install, "vkCreateGraphicsPipelines", Effect::creates);
  fallible<&vkCreateCommandPool>(install, "vkCreateCommandPool", Effect::creates);
  fallible<&vkCreateFence>(install, "vkCreateFence", Effect::creates);
  fallible<&vkCreateQueryPool>(install, "vkCreateQueryPool", Effect::creates);
  fallible<&vkCreateDescriptorPool>(install, "vkCreateDescriptorPool", Effect::creates);
}

void switch_destruction(bool install) {
  destroying<&vkDestroyInstance>(install);
  destroying<&vkDestroyDevice>(install);
  destroying<&vkFreeMemory>(install);
  destroying<&vkDestroyBuffer>(install);
  destroying<&vkDestroyImage>(install);
  destroying<&vkDestroyImageView>(install);
  destroying<&vkDestroySampler>(install);
  destroying<&vkDestroyShaderModule>(install);
  destroying<&vkDestroyDescriptorSetLayout>(install);
  destroying<&vkDestroyPipelineLayout>(install);
  destroying<&vkDestroyPipeline>(install);
  destroying<&vkDestroyCommandPool>(install);
  destroying<&vkDestroyFence>(install);
  destroying<&vkDestroyQueryPool>(install);
  destroying<&vkDestroyDescriptorPool>(install);
}

void switch_use(bool install) {
  fallible<&vkEnumerateInstanceLayerProperties>(install, "vkEnumerateInstanceLayerProperties");
  fallible<&vkEnumeratePhysicalDevices>(install, "vkEnumeratePhysicalDevices");
  fallible<&vkEnumerateDeviceExtensionProperties>(install, "vkEnumerateDeviceExtensionProperties");
  fallible<&vkGetPhysicalDeviceImageFormatProperties>(install,
                                                      "vkGetPhysicalDeviceImageFormatProperties");
  fallible<&vkAllocateCommandBuffers>(install, "vkAllocateCommandBuffers");
  fallible<&vkAllocateDescriptorSets>(install, "vkAllocateDescriptorSets");
  fallible<&vkBindBufferMemory>(install, "vkBindBufferMemory");
  fallible<&vkBindImageMemory>(install, "vkBindImageMemory");
  fallible<&vkMapMemory>(install, "vkMapMemory");
  fallible<&vkResetCommandBuffer>(install, "vkResetCommandBuffer");
  fallible<&vkBeginCommandBuffer>(install, "vkBeginCommandBuffer");
  fallible<&vkEndCommandBuffer>(install, "vkEndCommandBuffer");
  fallible<&vkResetDescriptorPool>(install, "vkResetDescriptorPool");
  fallible<&vkResetFences>(install, "vkResetFences");
  fallible<&vkQueueSubmit2>(install, "vkQueueSubmit2");
  fallible<&vkWaitForFences>(install, "vkWaitForFences", Effect::waits);
  fallible<&vkGetQueryPoolResults>(install, "vkGetQueryPoolResults");
  if (install) original_barrier = vkCmdPipelineBarrier2;
  vkCmdPipelineBarrier2 = install ? barrier : original_barrier;
}

void switch_all(bool install) {
  switch_creation(install);
  switch_destruction(install);
  switch_use(install);
}

}  // namespace

Injection::Injection(const Plan& plan) {
  list_devices();  // so that the pointers are there
  active_plan = plan;
  counts = {};
  switch_all(true);
}

Injection::~Injection() { switch_all(false); }

Report Injection::report() const { return counts; }

}  // namespace parity::gpu::faults
