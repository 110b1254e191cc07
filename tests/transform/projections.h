#pragma once

#include <tuple>
#include <vector>

#include "geometry/camera.h"
#include "geometry/transform.h"
#include "tests/setting.h"

/// What the records of both projections share.
namespace parity::transform_test {

struct Projections {
  std::vector<ViewVolume> volumes;
  DepthMode depth = DepthMode::standard;
};
inline auto fields_of(const Projections*) {
  return std::tuple{&Projections::volumes, &Projections::depth};
}

/// Axis reverse: depth the other way round.
inline Axis reverse_axis() {
  return {.name = "reverse", .low = 0, .high = 1, .standard = 0, .whole = true};
}
inline Projections no_projections(const Setting& setting) {
  return {{}, setting.count("reverse") ? DepthMode::reverse_z : DepthMode::standard};
}

}  // namespace parity::transform_test
