#include <algorithm>
#include <array>
#include <string_view>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr const char* layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL store(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                     VkDebugUtilsMessageTypeFlagsEXT,
                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const std::string_view id = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
  static_cast<ValidationLog*>(user)->messages.push_back(
      std::string(id) + ": " + (data->pMessage != nullptr ? data->pMessage : ""));
  return VK_FALSE;
}

}  // namespace

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
          .pNext = nullptr,
          .flags = 0,
          .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                             VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
          .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
          .pfnUserCallback = store,
          .pUserData = &log};
}

void require_validation_layer() {
  std::uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()),
        "vkEnumerateInstanceLayerProperties");
  layers.resize(count);
  const bool found = std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& each) {
    return std::string_view(each.layerName) == layer;
  });
  if (!found)
    throw Error(ErrorKind::missing_feature,
                std::string(layer) + " is not installed (Debian: vulkan-validationlayers)");
}

}  // namespace parity::gpu
