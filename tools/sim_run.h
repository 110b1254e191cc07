#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/math.h"
#include "gpu/core/context.h"
#include "sim/scene.h"

namespace parity::tools {

/// What a run holds at one time, for measures, pictures and files. Particles or cells or both.
struct SimContent {
  double time = 0;               ///< s
  std::vector<vec3> positions;   ///< of particles, m
  std::vector<vec3> velocities;  ///< of particles, m/s
  std::vector<float> pressures;  ///< of particles, Pa; empty: unknown
  ivec3 cells{0};                ///< 0: no grid
  float spacing = 0;             ///< m
  // At cell centres, x fastest, then y.
  std::vector<vec3> flow;          ///< m/s
  std::vector<float> pressure;     ///< Pa
  std::vector<float> smoke;        ///< 0 to 1
  std::vector<float> temperature;  ///< K above the surroundings
  std::vector<float> solid;        ///< 1 inside solids
};

/// What is conserved, and how well. NaN: has no meaning for the method.
struct SimMeasures {
  double time = 0;              ///< s
  double mass = 0;              ///< kg; of smoke: m^3
  dvec3 momentum{0};            ///< kg m/s
  double kinetic_energy = 0;    ///< J
  double potential_energy = 0;  ///< J, of gravity
  double max_speed = 0;         ///< m/s
  double divergence = 0;        ///< 1/s, largest
  double density_error = 0;     ///< average compression
  double max_density_error = 0;
};

/// A running simulation, whatever its method. The state after a step depends on the state before
/// and on `until` alone, bit for bit.
struct Simulation {
  std::string device;
  std::function<double()> time;  ///< s
  /// Whether the time is there, as exactly as the method's clock can say.
  std::function<bool(double until)> has_reached;
  /// One or a few adaptive steps, never beyond `until`; how many.
  std::function<std::uint64_t(double until)> step;
  std::function<std::uint64_t()> refused;  ///< steps taken back for their error; may be null
  std::function<SimMeasures()> measures;
  std::function<SimContent()> content;
  std::function<std::string()> save;
  /// @throws std::runtime_error  a state that does not fit the scene or is not finite.
  std::function<void(std::string_view)> restore;
  std::uint64_t particles = 0;
  std::uint64_t cells = 0;
};

/// @param context  null: the CPU reference.
/// @throws std::invalid_argument  the method cannot do what the scene asks.
Simulation start_simulation(const SimScene& scene, gpu::Context* context);

}  // namespace parity::tools
