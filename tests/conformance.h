#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/stage.h"

namespace parity {

/// One stage at one setting.
struct Check {
  const Stage* stage = nullptr;
  NamedSetting named = {};
  std::string name() const { return stage->name + "/" + named.name; }
};

/// The standard setting and both ends of every axis, of every stage; in the order of their names.
///
/// @param patterns  see name_matches; one that holds a setting ("raster/edge_coverage/width=1")
///                  selects that alone.
std::vector<Check> checks_of(std::span<const Stage> stages, std::span<const std::string> patterns);

/// What came of a check.
struct CheckResult {
  enum class Outcome { passed, failed, skipped } outcome = Outcome::passed;
  std::string message;  ///< why it failed or was skipped
  double seconds = 0;   ///< all of it, by the wall clock
  std::any problem;     ///< empty if it could not be made
  Trial trial;
};

/// Runs a check and judges it: every distance within the tolerance, no exception, no validation
/// message. Skipped if nothing was compared.
///
/// @param context  null: device methods are skipped.
/// @param problem_numbers  put into the problem first, see Stage::set_problem_numbers.
/// @throws std::invalid_argument  problem_numbers do not fit; gpu::Error if the device is lost.
CheckResult run_check(const Check& check, gpu::Context* context,
                      std::optional<std::span<const double>> problem_numbers = std::nullopt);

}  // namespace parity
