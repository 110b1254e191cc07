#pragma once

#include "tests/chart.h"

namespace parity::tools {

/// The charts that follow from a stage's record: for each of its chart_axes (the first axis if it
/// names none, nothing if it has no axis), error against time by every method; time against the
/// axis where the record knows no exact answer.
///
/// Each time is a median of repetitions, in which the methods take turns, after one that does not
/// count; an axis ends where a step takes longer than a few seconds.
std::vector<Chart> charts_of(const Stage& stage);

}  // namespace parity::tools
