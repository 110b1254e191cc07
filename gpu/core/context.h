#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/core/error.h"

namespace parity::gpu {

class Commands;
struct ContextState;  // Vulkan handles; defined in gpu/core/vulkan_state.h, for gpu/core/*.cpp only

/// What a device is and can do, as it says itself.
struct DeviceInfo {
  int index = 0;
  std::string name;
  std::string driver;       ///< name and version
  std::string type;         ///< "cpu", "integrated", "discrete", "virtual", "other"
  std::string api_version;  ///< "1.4.305"
  std::string refused;      ///< why the device cannot be used; empty: it can
  bool is_mesa_software = false;
  bool is_swiftshader = false;
  bool cuts_loops_short = false;  ///< the canary's answer; set on the device of a Context only
  int subpixel_bits = 0;
  int subtexel_bits = 0;
  int mipmap_bits = 0;
  int subgroup_size = 0;
  int max_workgroup_invocations = 0;
  std::uint64_t max_buffer_bytes = 0;
  std::uint64_t memory_bytes = 0;
  std::vector<int> sample_counts;  ///< for colour and depth together
  bool timestamps = false;
  bool host_memory_import = false;  ///< fenced buffers are possible
};

/// All devices that the driver shows, suitable or not.
///
/// @throws Error  no loader or driver.
std::vector<DeviceInfo> list_devices();

/// How buffers are watched in tests (see Buffer).
enum class Guard { none, zones, fences };

struct ContextOptions {
  std::string device;  ///< index or part of a name; empty: PARITY_DEVICE, else the fastest type
  bool validation = false;  ///< core + synchronization; throws if the layer is missing
  /// With `validation`: the layer also checks each access of the shaders, reads too. They take up
  /// to 40 times as long to compile and 15 times to run. Ignored where the device makes it err
  /// (Mesa 22).
  bool gpu_assisted = false;
  Guard guard = Guard::none;
  double timeout_seconds = 120;  ///< for one submission
  bool force_staging = false;    ///< through a staging buffer, as on discrete GPUs; for tests
};

/// How long the device took.
struct Timing {
  double seconds = 0;                                  ///< whole submission
  std::vector<std::pair<std::string, double>> passes;  ///< what Commands::pass named
};

/// One device with one queue. Made once, passed by reference, outlives all that is made from it.
class Context {
 public:
  /// @throws Error  naming the driver, device or feature that is missing.
  explicit Context(const ContextOptions& options = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const DeviceInfo& info() const;
  const ContextOptions& options() const;

  /// Records, submits, waits.
  ///
  /// @return  seconds by the device's own clock; of the host's if it has none.
  /// @throws Error  device lost, out of memory, timed out, or a guard zone was written to.
  Timing run(const std::function<void(Commands&)>& record);

  /// Seconds of all runs so far, as Timing::seconds counts them.
  double device_seconds() const;

  /// Pipelines stay built for the next Kernel or RasterPipeline of the same kind, as long as the
  /// context lives; how many there are, and the end of those that nothing uses at the moment.
  std::size_t pipeline_count() const;
  void drop_unused_pipelines();

  /// All that the validation layer said since the last call, one message an entry.
  std::vector<std::string> take_validation_messages();

  /// Bytes of live buffers and images, now and at most so far.
  std::uint64_t memory_bytes() const;
  std::uint64_t peak_memory_bytes() const;

  /// For gpu/core only.
  ContextState& state() const { return *state_; }

 private:
  std::unique_ptr<ContextState> state_;
};

}  // namespace parity::gpu
