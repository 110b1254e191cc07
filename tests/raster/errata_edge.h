#pragma once

#include <cstdint>
#include <functional>

#include "geometry/math.h"

namespace parity {

/// E(p + (1, 0)) from E(p), for the edge a -> b.
using StepRight = std::function<std::int64_t(std::int64_t e, ivec2 a, ivec2 b)>;

/// Is the increment that of E(p) = (b_x - a_x)(p_y - a_y) - (b_y - a_y)(p_x - a_x)? Checklist
/// row 9.
inline bool steps_right_as_the_edge_function(const StepRight& step) {
  const auto e = [](ivec2 a, ivec2 b, ivec2 p) {
    return std::int64_t(b.x - a.x) * (p.y - a.y) - std::int64_t(b.y - a.y) * (p.x - a.x);
  };
  const ivec2 a{2, -3}, b{5, 4}, p{-7, 11};  // b_y - a_y = 7: E falls by 7
  return step(e(a, b, p), a, b) == e(a, b, p + ivec2(1, 0));
}

}  // namespace parity
