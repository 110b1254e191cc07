#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/math.h"

/// Fluids on a staggered (MAC) grid: what they are, how they begin, and how they are measured. A
/// fluid in two dimensions is a slab one cell thick between walls that it slips along, so that one
/// code serves both.
namespace parity {

/// Values over a box of points, x fastest, then y.
struct Field {
  Field() = default;
  explicit Field(ivec3 extent, double value = 0)
      : size(extent),
        values(std::size_t(extent.x) * std::size_t(extent.y) * std::size_t(extent.z), value) {}
  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(size.y) + std::size_t(y)) * std::size_t(size.x) +
           std::size_t(x);
  }
  double& operator()(int x, int y, int z) { return values[index(x, y, z)]; }
  double operator()(int x, int y, int z) const { return values[index(x, y, z)]; }
  double& operator()(ivec3 i) { return values[index(i.x, i.y, i.z)]; }
  double operator()(ivec3 i) const { return values[index(i.x, i.y, i.z)]; }

  ivec3 size{0};
  std::vector<double> values;
};

/// One value for each face of a grid of cells: component a lies on the faces across axis a, of
/// which there is one more than cells along that axis. Face i is the lower face of cell i. Of a
/// periodic axis the first and the last face are one and hold the same value.
using FaceFields = std::array<Field, 3>;

/// The unit step along an axis.
constexpr ivec3 axis_step(int axis) { return {axis == 0, axis == 1, axis == 2}; }
FaceFields face_fields(ivec3 cells, double value = 0);

enum class CellType : std::uint32_t { fluid, air, solid };

/// What bounds the domain on one side: a wall that the fluid clings to or slips along, the open air
/// (pressure 0), or the opposite side.
enum class WallKind : std::uint32_t { no_slip, free_slip, open, periodic };

struct Wall {
  WallKind kind = WallKind::no_slip;
  dvec3 velocity{0};  ///< m/s; the part across the wall must be 0
};

/// A box of cubic cells with its lower corner at `origin`.
struct FluidDomain {
  ivec3 cells{0};               ///< z = 1: two dimensions
  double spacing = 0;           ///< m, side of a cell
  dvec3 origin{0};              ///< m
  std::array<Wall, 6> walls{};  ///< -x, +x, -y, +y, -z, +z
  bool is_flat() const { return cells.z == 1; }
  bool is_periodic(int axis) const {
    return walls[std::size_t(2 * axis)].kind == WallKind::periodic;
  }
  std::size_t cell_count() const {
    return std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z);
  }
};

/// How the fluid carries its velocity along. `upwind` and `central` difference the flux of momentum
/// and step with the Runge-Kutta method of order 3, projecting after every stage; `semi_lagrangian`
/// and `maccormack` trace back and split the step; `flip` and `apic` are liquids of particles.
enum class FluidMethod : std::uint32_t { upwind, central, semi_lagrangian, maccormack, flip, apic };
constexpr bool is_liquid(FluidMethod method) { return method >= FluidMethod::flip; }
constexpr bool is_split(FluidMethod method) { return method >= FluidMethod::semi_lagrangian; }
/// Of the error in time: a step's own error is of one order more.
constexpr int order_of(FluidMethod method) { return is_split(method) ? 1 : 3; }

/// Order of the Runge-Kutta method that traces back: 2 or 3.
enum class BackTrace : std::uint32_t { rk2, rk3 };

struct FluidParameters {
  FluidMethod method = FluidMethod::maccormack;
  BackTrace back_trace = BackTrace::rk2;
  double density = 1;                ///< kg/m^3
  double viscosity = 0;              ///< m^2/s, kinematic
  bool implicit_viscosity = false;   ///< split methods only
  dvec3 force{0};                    ///< m/s^2 on all the fluid: gravity of a liquid, a push
  double heat_lift = 0;              ///< m/s^2 upwards (y) for each kelvin above the surroundings
  double smoke_weight = 0;           ///< m/s^2 downwards for smoke of density 1
  double cooling = 0;                ///< 1/s, of the temperature
  double vorticity_confinement = 0;  ///< epsilon of Fedkiw et al. 2001
  double flip_ratio = 0.97;          ///< flip only; 0: PIC
  double courant = 0.9;              ///< cells that the fastest fluid crosses in a step
  double fixed_step = 0;             ///< s; 0: adaptive
  double max_step = 0.05;            ///< s, of an adaptive step
  double step_error = 0;     ///< of the velocity in a step, a part of the largest; 0: CFL alone
  double divergence = 1e-3;  ///< 1/s, largest that the projection may leave
  std::uint32_t max_iterations = 30;  ///< of the pressure solver, a projection
  bool sparse = false;                ///< only active cells are computed: active_cells
  double busy_smoke = 1e-3;           ///< density, what makes a cell busy
  double busy_heat = 0.5;             ///< K
  double busy_speed = 0.1;            ///< m/s along an axis
};

enum class SolidShape : std::uint32_t { sphere, box };

/// An obstacle that moves at a constant velocity.
struct FluidSolid {
  SolidShape shape = SolidShape::sphere;
  dvec3 center{0};    ///< m, at time 0
  dvec3 half{0};      ///< m, half sides; of a sphere x is the radius
  dvec3 velocity{0};  ///< m/s
};

/// A ball in which smoke and temperature are held at values; velocity too, unless it is 0.
struct FluidSource {
  dvec3 center{0};    ///< m
  double radius = 0;  ///< m
  double smoke = 1;
  double temperature = 0;  ///< K above the surroundings
  dvec3 velocity{0};       ///< m/s
};

/// The liquid of flip and apic.
struct LiquidParticles {
  std::vector<vec3> positions;   ///< m
  std::vector<vec3> velocities;  ///< m/s
  std::vector<mat3> gradients;   ///< 1/s, of the velocity; apic only, else zeros
  std::size_t count() const { return positions.size(); }
};

/// Everything that a run needs to go on from.
struct FluidState {
  double time = 0;  ///< s
  std::uint32_t steps = 0;
  FaceFields velocity;  ///< m/s
  Field pressure;       ///< Pa; where the next solve begins
  Field smoke;          ///< density, 0 to 1 as a rule
  Field temperature;    ///< K above the surroundings
  LiquidParticles particles;
  std::vector<std::uint8_t> active;  ///< of each cell, in the last step; empty: all
};

struct FluidProblem {
  FluidDomain domain;
  FluidParameters parameters;
  std::vector<FluidSolid> solids;
  std::vector<FluidSource> sources;
  FluidState initial;
  double duration = 1;  ///< s
};

/// @throws std::invalid_argument  who, what, which value, what was expected: a number is not finite
///                                or out of its range; sizes do not fit; a wall moves through
///                                itself; one of two opposite walls is periodic and the other not;
///                                a periodic axis has an odd number of cells;
///                                a particle lies outside the domain; solids leave no room.
void check_fluid_problem(const FluidProblem& problem);

/// A state of rest that fits the domain.
FluidState resting_state(const FluidDomain& domain);

/// Metres from the surface of the nearest solid, negative inside; infinite without solids.
double solid_distance(const std::vector<FluidSolid>& solids, double time, dvec3 position);

/// Velocity of the nearest solid; 0 without solids.
dvec3 solid_velocity(const std::vector<FluidSolid>& solids, double time, dvec3 position);

/// The smallest step of an open fraction: solids are resolved to this part of a face.
constexpr int open_steps = 31;

/// The part of each face that solids leave open, a multiple of 1 / open_steps. Walls are closed,
/// open sides open. From the distances d at the corners of the face: the sum of max(d, 0) over that
/// of |d|, which is exact where d is linear along one edge and constant along the other.
///
/// Source: Batty, Bertails & Bridson 2007; Ng, Min & Gibou 2009.
FaceFields open_fractions(const FluidDomain& domain, const std::vector<FluidSolid>& solids,
                          double time);

/// Velocity across each face of what closes it: the wall's or the nearest solid's.
FaceFields boundary_velocity(const FluidDomain& domain, const std::vector<FluidSolid>& solids,
                             double time);

/// Cells without an open face are solid. The others are fluid; of a liquid only those in which a
/// particle is, the rest is air. Cells that are not active are air whatever they hold.
std::vector<CellType> cell_types(const FluidProblem& problem, const FluidState& state);

/// Cells along the sides of the tiles of a sparse fluid, the first of which lies at the origin.
constexpr ivec3 fluid_tile = {8, 4, 4};

/// Cells away that what is in a cell may be found after a step of a sparse fluid: what is carried
/// `courant` cells is interpolated from places less than one further. A liquid needs one more, for
/// the faces around its particles.
int active_margin(const FluidParameters& parameters);

/// The cells that the step from a state on computes: those of tiles with a busy cell in them or
/// beside them, at most `active_margin` cells away along each axis. Busy is what holds more smoke,
/// heat or speed than the parameters say, what is in a source, and of a liquid what holds a
/// particle.
///
/// What lies outside is air at rest under pressure 0, without smoke and heat: whatever was there is
/// dropped, which is never more than the parameters allow. Faces move if a cell beside them is
/// active. For a liquid that is no approximation. For smoke it stands for open air around the
/// plume; the walls of a box are felt only where they touch active tiles.
std::vector<std::uint8_t> active_cells(const FluidProblem& problem, const FluidState& state);

/// Four values a tile, x fastest, one for each z in it: bit x + 8 y of those cells that are in a
/// source.
std::vector<std::uint32_t> source_rows(const FluidProblem& problem);

/// Position of the point (x, y, z) of a field; `axis` 0 to 2 for face fields, -1 for cells.
dvec3 point_position(const FluidDomain& domain, int axis, ivec3 point);

/// The cell of a particle, by the same float operations everywhere.
ivec3 particle_cell(const FluidDomain& domain, vec3 position);

// Problems. Sides are cells.

/// Lid-driven cavity, 1 m wide, lid at 1 m/s; `reynolds` = 1 / viscosity. Ghia et al. 1982.
FluidProblem lid_driven_cavity(int cells, double reynolds);

/// Taylor-Green vortex, one cell of the pattern in a box of free-slip walls with sides pi; 2
/// dimensions, or 3 (the same vortex at every height). Decays as exp(-2 viscosity t).
FluidProblem taylor_green(int cells, double viscosity, int dimensions);
FaceFields taylor_green_velocity(const FluidDomain& domain, double viscosity, double time);

/// Between a wall at rest and one that starts at 1 m/s, 1 m apart.
FluidProblem couette_start(int cells, double viscosity);
/// Speed at height y in 0..1 at a time; the Fourier series, to double precision.
double couette_speed(double viscosity, double time, double y);

/// Between two walls 1 m apart, pushed by 8 viscosity so that the speed in the middle tends to 1.
FluidProblem poiseuille(int cells, double viscosity);

/// Liquid at rest, `cells` high and half as wide, with free surface; flip.
FluidProblem hydrostatic_liquid(int cells, int dimensions);
/// The same weight in a closed box, or with a stratified temperature; maccormack.
FluidProblem hydrostatic_box(int cells, int dimensions);

/// Hot smoke rises past a sphere in a closed box, `cells` wide and twice as high.
FluidProblem smoke_plume(int cells, int dimensions);

/// A column of liquid `cells` wide and twice as high in a tank five times as wide. Martin & Moyce
/// 1952. `width` in m.
FluidProblem dam_break(int cells, double width, int dimensions);

/// Two columns at opposite walls collapse onto a block between them, tank 4 `cells` wide.
FluidProblem double_dam_break(int cells, int dimensions);

/// Particles on a lattice of 2 a cell and axis inside a box of space, at rest.
void add_liquid(FluidProblem& problem, dvec3 low, dvec3 high);

/// kg of a particle.
double liquid_particle_mass(const FluidProblem& problem);

/// Scenes of random size, walls, solids, viscosity, force and method; 2 dimensions, small.
FluidProblem random_fluid(std::uint64_t seed);

struct FluidMeasures {
  double divergence = 0;      ///< 1/s, largest in a fluid cell, open and closed parts of faces
  double kinetic_energy = 0;  ///< J
  dvec3 momentum{0};          ///< kg m/s; of the particles for liquids, else of the faces
  double mass = 0;            ///< kg of liquid; else the sum of smoke times volume, m^3
  double heat = 0;            ///< K m^3
  double max_speed = 0;       ///< m/s along an axis
  double front = 0;           ///< m, largest x of a particle
};
FluidMeasures measure(const FluidProblem& problem, const FluidState& state);

/// Divergence of a cell with its closed faces counted: 1/s.
Field divergence(const FluidDomain& domain, const FaceFields& velocity, const FaceFields& open,
                 const FaceFields& boundary);

}  // namespace parity
