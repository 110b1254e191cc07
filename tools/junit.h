#pragma once

#include <string>
#include <vector>

#include "tools/check_runner.h"

namespace parity::tools {

/// A JUnit report: one test case a check, its stage as the class name.
std::string junit_xml(const std::vector<CheckReport>& reports);

}  // namespace parity::tools
