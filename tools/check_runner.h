#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/conformance.h"

namespace parity::tools {

struct CheckRunOptions {
  std::string device;      ///< see gpu::ContextOptions
  bool host_only = false;  ///< no device: its methods are skipped
  bool validation = true;
  double timeout_seconds = 120;                ///< for one check, and for starting the device
  std::filesystem::path folder;                ///< failures are written here
  std::optional<std::vector<double>> problem;  ///< replaces that of every check
};

/// What came of one check, as people and files are told.
struct CheckReport {
  std::string name;
  std::string outcome;  ///< "passed", "failed", "skipped"
  std::string message;
  std::string reproduce;  ///< the command that runs it again; empty unless it failed
  double seconds = 0;
  nlohmann::json methods = nlohmann::json::array();
};

/// Runs checks one after another in a process of their own, so that one that hangs or crashes costs
/// no more than itself: it is reported as failed, and a new process goes on with the next.
///
/// @param report  called after each check, in order.
/// @return        the device that ran them.
/// @throws gpu::Error  the device could not be started.
std::string run_checks(const std::vector<Check>& checks, const CheckRunOptions& options,
                       const std::function<void(const CheckReport&)>& report);

}  // namespace parity::tools
