#pragma once

#include <stdexcept>
#include <string>

namespace parity::gpu {

enum class ErrorKind {
  no_driver,        ///< no Vulkan loader or no driver
  no_device,        ///< no device that fits, or none of that name
  missing_feature,  ///< the device lacks what a kernel needs
  out_of_memory,
  device_lost,
  timed_out,  ///< no answer within ContextOptions::timeout_seconds
  invalid_shader,
  broken_guard,  ///< something wrote outside its buffer
  other,
};

/// A fault of the device, in one line. The program turns it into exit code 4.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace parity::gpu
