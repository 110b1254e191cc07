#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "gpu/core/context.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

nlohmann::json to_json(const gpu::DeviceInfo& device) {
  return {{"index", device.index},
          {"name", device.name},
          {"driver", device.driver},
          {"type", device.type},
          {"api_version", device.api_version},
          {"refused", device.refused},
          {"subpixel_bits", device.subpixel_bits},
          {"subtexel_bits", device.subtexel_bits},
          {"mipmap_bits", device.mipmap_bits},
          {"subgroup_size", device.subgroup_size},
          {"max_workgroup_invocations", device.max_workgroup_invocations},
          {"max_buffer_bytes", device.max_buffer_bytes},
          {"memory_bytes", device.memory_bytes},
          {"sample_counts", device.sample_counts},
          {"timestamps", device.timestamps},
          {"host_memory_import", device.host_memory_import}};
}

void print(const gpu::DeviceInfo& device) {
  std::printf("%d  %s\n", device.index, device.name.c_str());
  std::printf("   %s, %s, Vulkan %s\n", device.driver.c_str(), device.type.c_str(),
              device.api_version.c_str());
  std::string samples;
  for (int count : device.sample_counts)
    samples += (samples.empty() ? "" : ", ") + std::to_string(count);
  std::printf("   samples %s; bits: sub-pixel %d, sub-texel %d, mip %d; subgroup %d\n",
              samples.c_str(), device.subpixel_bits, device.subtexel_bits, device.mipmap_bits,
              device.subgroup_size);
  std::printf("   largest buffer %llu MiB, memory %llu MiB\n",
              static_cast<unsigned long long>(device.max_buffer_bytes >> 20),
              static_cast<unsigned long long>(device.memory_bytes >> 20));
  std::printf("   %s\n",
              device.refused.empty() ? "usable" : ("refused: " + device.refused).c_str());
}

}  // namespace

void add_devices_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("devices", "List Vulkan devices, their limits, and why one is refused");
  auto json = std::make_shared<bool>(false);
  verb->add_flag("--json", *json, "Machine-readable output");
  verb->footer(
      "Examples:\n  parity devices\n  PARITY_DEVICE=llvmpipe parity render scene.glb -o a.png");
  verb->callback([json, &exit_code] {
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
    if (*json) {
      nlohmann::json list = nlohmann::json::array();
      for (const gpu::DeviceInfo& device : devices) list.push_back(to_json(device));
      std::printf("%s\n", list.dump(2).c_str());
    } else {
      for (const gpu::DeviceInfo& device : devices) print(device);
    }
    exit_code = 0;
  });
}

}  // namespace parity::tools
