#pragma once

#include <cstdint>
#include <vector>

#include "geometry/math.h"
#include "geometry/sampling.h"

namespace parity::cpu {

/// Samples of a pixel, in [0, 1)^2, as SamplePattern says.
///
/// Random numbers are hash(i + hash(dimension + hash(seed))), hash PCG of 32 bits with output
/// RXS-M-XS; the upper 24 bits count. Dimensions 0 and 1 place sample i in its cell (blue noise:
/// candidate c of sample i is number 32 i + c, of 15 bits), 2 and 3 with i = 0 are what the seed
/// does to halton, r2 (a shift) and sobol (exclusive or).
///
/// @throws std::invalid_argument  count is 0.
///
/// Source: notes 1.8; Jarzynski & Olano 2020; Chiu, Shirley & Wang 1994, Kensler 2013
/// (multi-jittered); Halton 1964; Sobol 1967; Roberts 2018 (R2); Mitchell 1991 (best candidate).
std::vector<dvec2> pattern(SamplePattern pattern, std::uint32_t count, std::uint32_t seed);

}  // namespace parity::cpu
