#pragma once

#include <tuple>

#include "sim/pressure.h"
#include "tests/numbers.h"

namespace parity {

inline auto fields_of(const Field*) { return std::tuple{&Field::values}; }
inline auto fields_of(const PressureProblem*) {
  return std::tuple{&PressureProblem::rhs, &PressureProblem::guess};
}
inline auto fields_of(const PressureAnswer*) { return std::tuple{&PressureAnswer::pressure}; }

}  // namespace parity
