#pragma once

#include "geometry/sampling.h"

namespace parity::cpu {

/// A jittered frame added to a history of frames. The history is read between the pixels where the
/// surface was; outside of the picture there is none. It may be held to the range of the colours
/// around the pixel now, and what it loses there, relative to that range plus 1/16, it loses of its
/// weight. A history of n frames (at most longest - 1) and the new one are averaged n : 1.
///
/// @return  colours; w the frames that each stands for, 1 to longest.
/// @throws std::invalid_argument  sizes differ or are 0; longest below 1.
///
/// Source: notes 1.8 (jittering); Karis 2014; Yang, Liu & Salvi 2020.
Grid<dvec4> accumulate(const TemporalStep& step);

}  // namespace parity::cpu
