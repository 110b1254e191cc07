#pragma once

#include <cstdint>
#include <string>

// For tests: makes Vulkan calls fail on purpose and counts what lives.
namespace parity::gpu::faults {

enum class Fault { out_of_host_memory, out_of_device_memory, device_lost };

struct Plan {
  Fault fault = Fault::out_of_host_memory;
  std::int64_t at_call = 0;    ///< the call that fails, from 1; 0: none
  bool skip_barriers = false;  ///< memory barriers are left out: a planted hazard
};

struct Report {
  std::int64_t calls = 0;         ///< that could have failed
  std::int64_t barriers = 0;      ///< recorded or skipped
  std::int64_t live_objects = 0;  ///< created less destroyed
  std::string failed;             ///< name of the call that failed; empty: none did
};

/// As long as it lives, every Vulkan call that returns a result goes through it. One at a time, on
/// one thread; contexts that it counts must begin and end while it lives.
class Injection {
 public:
  /// @throws Error  no Vulkan loader or driver.
  explicit Injection(const Plan& plan);
  ~Injection();
  Injection(const Injection&) = delete;
  Injection& operator=(const Injection&) = delete;
  Report report() const;
};

}  // namespace parity::gpu::faults
