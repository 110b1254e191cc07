#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/math.h"

/// Fluids of particles: what they are, how they begin, and how they are measured.
namespace parity {

/// Radial kernels W(r, H) that vanish from the support radius H on.
enum class SphKernel : std::uint32_t { cubic_spline, poly6, spiky, wendland };

/// How pressure comes about: from the density by an equation of state; from the demand that no
/// particle is denser than at rest at the end of the step; or from that and the demand that no
/// particle inside the fluid is being compressed when the step begins.
enum class SphMethod : std::uint32_t { weakly_compressible, constant_density, divergence_free };

/// Pressure of a density: c^2 (rho - rho_0) as in the notes, or Tait's
/// c^2 rho_0 / 7 ((rho / rho_0)^7 - 1). Negative pressure counts as 0.
enum class SphEquationOfState : std::uint32_t { linear, tait };

struct SphParameters {
  std::uint32_t dimensions = 3;  ///< 2 or 3; in 2 all z are 0
  double spacing = 0.02;         ///< m between particles at rest; their mass is that of its cube
  double support = 0.04;         ///< m, support radius H of the kernel
  SphKernel kernel = SphKernel::cubic_spline;
  SphMethod method = SphMethod::weakly_compressible;
  SphEquationOfState equation_of_state = SphEquationOfState::tait;
  double rest_density = 1000;         ///< kg/m^3; kg/m^2 in 2 dimensions
  double sound_speed = 20;            ///< m/s; ten times the largest speed gives 1 % compression
  double artificial_viscosity = 0.1;  ///< alpha of Monaghan 1992
  double viscosity = 0;               ///< m^2/s, kinematic
  bool implicit_viscosity = false;    ///< solve for the velocities that viscosity leads to
  double viscosity_error = 1e-5;  ///< RMS error of those velocities over their RMS, where to stop
  double surface_tension = 0;     ///< kappa of Becker & Teschner 2007 per volume, 1/s^2
  dvec3 gravity{0, -9.81, 0};     ///< m/s^2
  double courant = 0.5;    ///< fraction of the stable step that an adaptive step takes, in (0, 1]
  double fixed_step = 0;   ///< s; 0: adaptive
  double max_step = 0.01;  ///< s, of an adaptive step
  double density_error = 5e-4;  ///< average compression at which the incompressible solver stops;
                                ///< the largest may be ten times that
  std::uint32_t max_iterations = 100;  ///< of each solver, per step
};

/// Who, what, which value, what was expected.
///
/// @throws std::invalid_argument  a number is not finite or out of its range; support is not in
///                                (1, 4] spacings.
void check_sph_parameters(const SphParameters& parameters);

/// Particles at least so dense, over the rest density, count as inside the fluid: on the lattice
/// those at its surface have 0.85.
constexpr double sph_inside_density = 0.9;

/// kg; kg per metre of depth in 2 dimensions.
double particle_mass(const SphParameters& parameters);

/// Everything that a run needs to go on from: the same state gives the same bits.
struct SphState {
  double time = 0;               ///< s
  std::vector<vec3> positions;   ///< m
  std::vector<vec3> velocities;  ///< m/s
  std::vector<float> pressures;  ///< Pa, that the incompressible solver begins with; none: 0
};

/// A box of space, m.
struct SphBox {
  dvec3 low{0};
  dvec3 high{1};
};

struct SphProblem {
  SphParameters parameters;
  SphState initial;
  std::vector<vec3> boundary;  ///< particles of the walls, one layer, a spacing apart
  /// Velocity of each wall particle, m/s, which slides along its wall, and the share of the
  /// viscosity that acts on it: 1 does not slip, 0 does. Empty: all rest and do not slip.
  std::vector<vec4> boundary_motions = {};
  SphBox domain;        ///< what the walls enclose; particles may leave it all the same
  double duration = 1;  ///< s
};

/// @throws std::invalid_argument  parameters, as check_sph_parameters; counts of positions and
///                                velocities differ; a number is not finite; a particle lies
///                                outside the domain; z is not 0 in 2 dimensions; the domain is
///                                empty or so large that its cells of one support radius are more
///                                than 2^24.
void check_sph_problem(const SphProblem& problem);

/// Particles on the square or cubic lattice of cells of one spacing that fills a box: as many along
/// each axis as its side holds, to the nearest whole number. In 2 dimensions the box's z is
/// ignored.
std::vector<vec3> fill_box(const SphBox& box, double spacing, std::uint32_t dimensions);

/// A layer of particles half a spacing outside a box of walls (`outside`) or half a spacing inside
/// an obstacle, on its whole surface, corners too; `open_top` leaves out the upper face.
std::vector<vec3> cover_box(const SphBox& box, double spacing, std::uint32_t dimensions,
                            bool outside, bool open_top);

/// A column `width` wide and twice as high collapses in a tank five times as wide: Martin & Moyce
/// 1952. `count` particles along the width.
SphProblem sph_dam_break(std::uint32_t dimensions, double width, int count);

/// Fluid of `height` at rest under its own weight in a tank `width` wide; `count` particles along
/// the height.
SphProblem sph_hydrostatic_column(std::uint32_t dimensions, double width, double height, int count);

/// Two columns at opposite walls collapse onto a block between them; `count` particles along the
/// height of a column.
SphProblem sph_double_dam_break(std::uint32_t dimensions, int count);

/// A drop without gravity or walls, its velocities random up to `speed`; `count` particles across.
SphProblem sph_random_drop(std::uint32_t dimensions, int count, double speed, std::uint64_t seed);

/// A tank in 2 dimensions with up to three blocks of fluid of random size, place, velocity,
/// viscosity, surface tension, sound speed, kernel and equation of state.
SphProblem sph_random_scene(std::uint64_t seed);

/// The neighbours of each particle by number, ascending, without itself: of the fluid, and of the
/// walls.
struct SphNeighbourLists {
  std::vector<std::vector<std::uint32_t>> fluid;
  std::vector<std::vector<std::uint32_t>> walls;
};

struct SphMeasures {
  double mass = 0;              ///< kg
  dvec3 momentum{0};            ///< kg m/s
  double kinetic_energy = 0;    ///< J
  double potential_energy = 0;  ///< J, of gravity, against the origin
  dvec3 center{0};              ///< m, of mass
  dvec3 low{0}, high{0};        ///< m, bounds of the particles
  double max_speed = 0;         ///< m/s
};

/// Of no particles: zeros.
SphMeasures measure(const SphParameters& parameters, const SphState& state);

struct SphDensityError {
  double average = 0;  ///< of max(0, rho / rho_0 - 1)
  double largest = 0;
};

/// How far particles are compressed; rarefaction, as at surfaces, is none.
SphDensityError density_error(const SphParameters& parameters, std::span<const float> densities);

}  // namespace parity
