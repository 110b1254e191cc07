#pragma once

#include <optional>
#include <vector>

#include "gpu/sph/pressure.h"
#include "gpu/sph/viscosity.h"

namespace parity::gpu {

/// What a run of steps came to.
struct SphReport {
  double time = 0;                          ///< s
  double last_step = 0;                     ///< s
  double max_speed = 0;                     ///< m/s, before the last step
  double max_density = 0;                   ///< kg/m^3
  std::uint32_t steps = 0;                  ///< since the problem began or was written
  std::uint32_t iterations = 0;             ///< of the pressure solver in the last step
  double compression = 0;                   ///< average, that the pressure solver left
  std::uint32_t divergence_iterations = 0;  ///< of the divergence solve
  std::uint32_t viscous_iterations = 0;     ///< of the implicit viscosity's solver in the last step
  std::uint32_t crowded = 0;  ///< times that a particle had more neighbours than its list holds
};

/// A particle fluid on the device: neighbours, densities, forces, step, without a word to the host,
/// weakly compressible or with the pressures of PressureSolver.
/// The step adapts to waves, speed, force and viscosity unless the parameters fix it. The state
/// after any number of steps depends on the state before alone, bit for bit.
///
/// Stable iff (fixed step, at rest) 2 g dt + (w dt)^2 < 4 for the fastest wave w and the strongest
/// friction g of the particles; an adaptive step bounds both from above. Implicit viscosity sets no
/// bound.
/// Accuracy: O(dt), and O(H^2) where neighbours are even.
/// Source: notes 10.1, 10.4; Monaghan 1992, 2005; Akinci et al. 2012.
class SphStep {
 public:
  /// @throws std::invalid_argument  as check_sph_problem.
  SphStep(Context& context, const SphProblem& problem);

  /// Goes on from another state of the same number of particles.
  ///
  /// @throws std::invalid_argument  the counts differ.
  void write(const SphState& state);
  SphState read() const;

  /// One step, shortened where it would pass `until`; none if the time is there already.
  void record(Commands& commands, double until);

  SphReport report() const;

  /// By the order of the particles; w is 0.
  const Buffer<vec4>& positions() const { return positions_; }
  const Buffer<vec4>& velocities() const { return velocities_; }
  /// kg/m^3, as the last step found them.
  const Buffer<float>& densities() const { return densities_of_ids_; }
  /// Pa, of the last step.
  const Buffer<float>& pressures() const { return pressures_; }

 private:
  void record_clock(Commands& commands, double until);
  void record_motion(Commands& commands);

  std::uint32_t count_;
  std::uint32_t blocks_;
  Neighbours neighbours_;
  Densities densities_;
  Forces forces_;
  Kernel<LimitsArgs> limits_;
  Kernel<ClockArgs> clock_;
  Kernel<IntegrateArgs> integrate_;
  Kernel<SolveEndArgs> solve_end_;
  std::optional<PressureSolver> solver_;      ///< of the incompressible method
  std::optional<ViscositySolver> viscosity_;  ///< if implicit
  Buffer<vec4> positions_;
  Buffer<vec4> velocities_;
  Buffer<float> densities_of_ids_;
  Buffer<float> pressures_;
  Buffer<SphLimits> block_limits_;
  Buffer<SphClock> clock_buffer_;
};

/// Steps until that time, in submissions of a few steps.
///
/// @throws Error  particles are so crowded that neighbours were lost: the run is unstable; or the
///                time is not reached in `max_steps`.
SphReport advance(Context& context, SphStep& step, double until, std::uint32_t max_steps);

/// The state of a problem at the time `until`, and the densities of its last step.
///
/// Mathematics: cpu::sph_step.
struct SphResult {
  SphState state;
  std::vector<float> densities;
  SphReport report;
};
SphResult sph_step(Context& context, const SphProblem& problem, double until,
                   std::uint32_t max_steps);

}  // namespace parity::gpu
