#include <algorithm>
#include <array>
#include <string_view>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr const char* layer = "VK_LAYER_KHRONOS_validation";

struct Known {
  const char* id;
  const char* part;  ///< of the message, where the id stands for several
};

constexpr Known harmless[] = {
    // The layer says that it cannot check addresses. The device lacks 64-bit integers; the guards
    // of the
    // buffers check then.
    {"UNASSIGNED-GPU-Assisted Validation Warning", "shaderInt64 feature is not available"},
};

bool is_harmless(std::string_view id, std::string_view message) {
  return std::any_of(std::begin(harmless), std::end(harmless), [&](const Known& known) {
    return id == known.id && message.find(known.part) != std::string_view::npos;
  });
}

VKAPI_ATTR VkBool32 VKAPI_CALL store(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                     VkDebugUtilsMessageTypeFlagsEXT,
                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const std::string_view id = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
  const std::string_view message = data->pMessage != nullptr ? data->pMessage : "";
  if (!is_harmless(id, message))
    static_cast<ValidationLog*>(user)->messages.push_back(std::string(message));
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

// Mesa 22.3 goes wrong in the search that the layer adds before each access through an address: it
// calls good addresses bad. There the guards of the buffers must do.
bool can_assist(const DeviceInfo& device) {
  return !device.is_mesa_software || device.driver.find("Mesa 22.") == std::string::npos;
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
