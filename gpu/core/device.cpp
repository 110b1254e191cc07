#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string_view>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t api_version = VK_API_VERSION_1_3;

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

void load_loader() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (volkInitialize() != VK_SUCCESS)
      throw Error(ErrorKind::no_driver,
                  "no Vulkan loader (Debian: install libvulkan1 and mesa-vulkan-drivers)");
  });
  if (volkGetInstanceVersion() < api_version)
    throw Error(ErrorKind::no_driver, "the Vulkan loader is version " +
                                          version_text(volkGetInstanceVersion()) +
                                          ", must be 1.3 or later");
}

/// All calls go through the loader, which serves any instance and device, so once is enough.
void load_functions(VkInstance instance) {
  static std::once_flag once;
  std::call_once(once, [instance] { volkLoadInstance(instance); });
}

/// The device's features, all versions chained.
struct Features {
  Features() {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
  VkPhysicalDeviceFeatures2 core{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = nullptr, .features = {}};
  VkPhysicalDeviceVulkan11Features v11{};
  VkPhysicalDeviceVulkan12Features v12{};
  VkPhysicalDeviceVulkan13Features v13{};
};

void query(VkPhysicalDevice device, Features& features) {
  features.v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
  features.v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features.v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  vkGetPhysicalDeviceFeatures2(device, &features.core);
}

std::vector<std::string> extensions_of(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
        "vkEnumerateDeviceExtensionProperties");
  std::vector<VkExtensionProperties> list(count);
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, list.data()),
        "vkEnumerateDeviceExtensionProperties");
  std::vector<std::string> names;
  for (const VkExtensionProperties& each : list) names.emplace_back(each.extensionName);
  return names;
}

bool has_extension(VkPhysicalDevice device, const char* name) {
  const std::vector<std::string> names = extensions_of(device);
  return std::find(names.begin(), names.end(), name) != names.end();
}

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

/// Why the device cannot be used; empty: it can.
std::string refusal(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < api_version)
    return "Vulkan " + version_text(properties.apiVersion) + ", needs 1.3";
  Features features;
  query(device, features);
  const std::pair<const char*, VkBool32> needed[] = {
      {"dynamicRendering", features.v13.dynamicRendering},
      {"synchronization2", features.v13.synchronization2},
      {"maintenance4", features.v13.maintenance4},
      {"bufferDeviceAddress", features.v12.bufferDeviceAddress},
      {"scalarBlockLayout", features.v12.scalarBlockLayout}};
  for (const auto& [name, present] : needed)
    if (present == VK_FALSE) return std::string("lacks the feature ") + name;
  if (!find_queue_family(device)) return "lacks a queue for graphics and compute";
  return "";
}

void describe_versioned(VkPhysicalDevice device, DeviceInfo& info) {
  VkPhysicalDeviceMaintenance4Properties sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES;
  VkPhysicalDeviceMaintenance3Properties allocations{};
  allocations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  allocations.pNext = &sizes;
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  subgroup.pNext = &allocations;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &subgroup;
  VkPhysicalDeviceProperties2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  all.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &all);
  info.driver = driver.driverName;
  if (driver.driverInfo[0] != '\0') info.driver += std::string(" ") + driver.driverInfo;
  info.is_mesa_software = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
  info.is_swiftshader = driver.driverID == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
  info.subgroup_size = static_cast<int>(subgroup.subgroupSize);
  info.max_buffer_bytes = std::min({static_cast<std::uint64_t>(sizes.maxBufferSize),
                                    static_cast<std::uint64_t>(allocations.maxMemoryAllocationSize),
                                    info.memory_bytes});
}

std::uint64_t largest_heap(VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
      largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
  return largest;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool names_device(const DeviceInfo& device, const std::string& name) {
  int index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size()) return index == device.index;
  return lower(device.name + " " + device.driver).find(lower(name)) != std::string::npos;
}

std::string list_text(const std::vector<DeviceInfo>& devices) {
  std::string text;
  for (const DeviceInfo& each : devices)
    text += (text.empty() ? "" : "; ") + std::to_string(each.index) + ": " + each.name +
            (each.refused.empty() ? "" : " (" + each.refused + ")");
  return text;
}

}  // namespace

Instance::Instance(ValidationLog* log, bool gpu_assisted) {
  load_loader();
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "parity";
  application.apiVersion = api_version;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;

  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkValidationFeatureEnableEXT checks[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
      VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
      VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  VkValidationFeaturesEXT features{};
  if (log != nullptr) {
    require_validation_layer();
    messenger = messenger_info(*log);
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = gpu_assisted ? std::size(checks) : 1;
    features.pEnabledValidationFeatures = checks;
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw Error(
        ErrorKind::no_driver,
        "no Vulkan driver (Debian: install mesa-vulkan-drivers; VK_DRIVER_FILES names others)");
  check(result, "vkCreateInstance");
  load_functions(instance_);
  if (log == nullptr) return;
  const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  const VkResult made = make(instance_, &messenger, nullptr, &messenger_);
  if (made < 0) vkDestroyInstance(instance_, nullptr);
  check(made, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE)
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
        instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::devices() const {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
        "vkEnumeratePhysicalDevices");
  devices.resize(count);
  if (devices.empty())
    throw Error(ErrorKind::no_driver,
                "no Vulkan driver shows a device (Debian: install mesa-vulkan-drivers)");
  return devices;
}

std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & needed) == needed) return i;
  return std::nullopt;
}

DeviceInfo describe(VkPhysicalDevice device, int index) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device, &properties);
  const VkPhysicalDeviceLimits& limits = properties.limits;
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName;
  info.type = type_name(properties.deviceType);
  info.api_version = version_text(properties.apiVersion);
  info.refused = refusal(device, properties);
  info.subpixel_bits = static_cast<int>(limits.subPixelPrecisionBits);
  info.subtexel_bits = static_cast<int>(limits.subTexelPrecisionBits);
  info.mipmap_bits = static_cast<int>(limits.mipmapPrecisionBits);
  info.max_workgroup_invocations = static_cast<int>(limits.maxComputeWorkGroupInvocations);
  info.memory_bytes = largest_heap(device);
  const VkSampleCountFlags counts =
      limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  for (int count = 1; count <= 64; count *= 2)
    if ((counts & static_cast<VkSampleCountFlags>(count)) != 0) info.sample_counts.push_back(count);
  info.timestamps = limits.timestampComputeAndGraphics == VK_TRUE;
  info.host_memory_import = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU &&
                            has_extension(device, VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  if (properties.apiVersion >= api_version) describe_versioned(device, info);
  return info;
}

int choose_device(const std::vector<DeviceInfo>& devices, const std::string& name) {
  const char* environment = std::getenv("PARITY_DEVICE");
  const std::string wanted = !name.empty() ? name : (environment != nullptr ? environment : "");
  if (!wanted.empty()) {
    for (const DeviceInfo& each : devices) {
      if (!names_device(each, wanted)) continue;
      if (each.refused.empty()) return each.index;
      throw Error(ErrorKind::no_device, "device " + each.name + " cannot be used: " + each.refused);
    }
    throw Error(ErrorKind::no_device, "no device '" + wanted + "'; there is " + list_text(devices));
  }
  for (const char* type : {"discrete", "integrated", "virtual", "cpu", "other"})
    for (const DeviceInfo& each : devices)
      if (each.type == type && each.refused.empty()) return each.index;
  throw Error(ErrorKind::no_device, "no device can be used: " + list_text(devices));
}

std::vector<DeviceInfo> list_devices() {
  const Instance instance(nullptr, false);
  std::vector<DeviceInfo> list;
  for (VkPhysicalDevice device : instance.devices())
    list.push_back(describe(device, static_cast<int>(list.size())));
  return list;
}

Device::Device(VkPhysicalDevice physical, const DeviceInfo& info) {
  // Everything the device has, less what costs speed or memory by being on.
  Features features;
  VkPhysicalDeviceLineRasterizationFeaturesEXT lines{};
  lines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT;
  std::vector<const char*> extensions;
  if (info.host_memory_import) extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  if (has_extension(physical, VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME)) {
    extensions.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    features.v13.pNext = &lines;
  }
  query(physical, features);
  bresenham_lines = lines.bresenhamLines == VK_TRUE;
  mirror_clamp = features.v12.samplerMirrorClampToEdge == VK_TRUE;
  features.core.features.robustBufferAccess = VK_FALSE;
  features.v13.robustImageAccess = VK_FALSE;
  features.v12.bufferDeviceAddressCaptureReplay = VK_FALSE;
  features.v12.bufferDeviceAddressMultiDevice = VK_FALSE;
  features.v11.protectedMemory = VK_FALSE;

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = find_queue_family(physical).value();
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo create_info{};
  create_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  create_info.pNext = &features.core;
  create_info.queueCreateInfoCount = 1;
  create_info.pQueueCreateInfos = &queue;
  create_info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  create_info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateDevice(physical, &create_info, nullptr, &link.device), "vkCreateDevice");
}

Device::~Device() {
  if (!link.abandoned) vkDestroyDevice(link.device, nullptr);
}

}  // namespace parity::gpu
