#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/math.h"

/// Scenes of fluids: what `parity sim` runs. Lengths in m, the domain's lower corner at the origin,
/// y up. In 2 dimensions all z are 0.
namespace parity {

/// Largest counts that a scene may ask for; more is refused before anything is held.
constexpr double max_sim_cells = 134217728;    // 2^27
constexpr double max_sim_particles = 8388608;  // 2^23
constexpr int max_sim_frames = 100000;

enum class SimMethod {
  grid,   ///< one fluid fills the domain; smoke and heat ride in it
  flip,   ///< liquid of particles, pressure on a grid
  apic,   ///< the same, particles carry affine velocities
  wcsph,  ///< particles alone, weakly compressible
  dfsph,  ///< particles alone, incompressible
};

/// "grid", "flip", ...
const char* name_of(SimMethod method);
inline bool is_sph(SimMethod m) { return m == SimMethod::wcsph || m == SimMethod::dfsph; }

struct SimShape {
  enum class Kind { box, sphere } kind = Kind::box;
  dvec3 low{0};     ///< box
  dvec3 high{0};    ///< box
  dvec3 center{0};  ///< sphere
  double radius = 0;

  bool operator==(const SimShape&) const = default;
};

/// Is the point inside or on the surface?
bool contains(const SimShape& shape, const dvec3& point);

/// A shape of solid or of liquid, and the velocity that it has (solids: keeps).
struct SimBody {
  SimShape shape;
  dvec3 velocity{0};  ///< m/s

  bool operator==(const SimBody&) const = default;
};

/// A ball in which smoke, temperature and velocity are held.
struct SimSource {
  dvec3 center{0};         ///< m
  double radius = 0;       ///< m
  dvec3 velocity{0};       ///< m/s
  double smoke = 1;        ///< concentration, 0 to 1
  double temperature = 0;  ///< K above the surroundings

  bool operator==(const SimSource&) const = default;
};

enum class SimSideKind { slip, no_slip, open, periodic };

/// One of the sides of the domain.
struct SimSide {
  SimSideKind kind = SimSideKind::slip;
  dvec3 velocity{0};  ///< m/s of a wall that slides along itself

  bool operator==(const SimSide&) const = default;
};

enum class SimAdvection { upwind, central, semi_lagrangian, maccormack };
enum class SimStart { rest, taylor_green };

struct SimFluid {
  double density = 1000;         ///< kg/m^3 (kg/m^2 in 2 dimensions)
  double viscosity = 0;          ///< m^2/s, kinematic
  double surface_tension = 0;    ///< m^2/(kg s^2), particle methods
  double expansion = 1.0 / 293;  ///< 1/K: hot fluid rises with expansion x temperature x gravity
  double smoke_weight = 0;       ///< m/s^2 downwards for smoke of concentration 1
  double cooling = 0;            ///< 1/s
  double vorticity_confinement = 0;

  bool operator==(const SimFluid&) const = default;
};

struct SimSolver {
  SimAdvection advection = SimAdvection::maccormack;
  double divergence = 1e-3;           ///< grids: 1/s, largest that the projection may leave
  double density_error = 1e-3;        ///< dfsph: average compression left
  std::optional<double> courant;      ///< none: the method's own
  std::optional<double> max_step;     ///< s
  std::optional<double> error;        ///< grid: of the velocity in a step, a part of the largest
  std::optional<double> sound_speed;  ///< m/s, wcsph; none: ten times that of the fall
  double artificial_viscosity = 0.1;  ///< wcsph
  bool implicit_viscosity = false;    ///< wcsph, dfsph
  double flip_ratio = 0.97;           ///< flip: 0 is PIC, 1 is FLIP
  bool sparse = false;                ///< grids: only tiles near what moves or is there

  bool operator==(const SimSolver&) const = default;
};

/// What a frame shows.
enum class SimView { automatic, spheres, smoke, field };
enum class SimColor { automatic, speed, vorticity, pressure, smoke, height };

struct SimPicture {
  ivec2 size{1280, 720};
  SimView view = SimView::automatic;
  SimColor color = SimColor::automatic;
  std::optional<dvec2> range;  ///< values of the ends of the colour map; none: the frame's own
  std::optional<dvec3> eye;    ///< m; none: all of the domain is framed
  std::optional<dvec3> target;
  double fov_degrees = 35;    ///< vertical
  dvec3 sun{0.5, 1.0, 0.35};  ///< towards the light
  int samples = 2;            ///< along each side of a pixel

  bool operator==(const SimPicture&) const = default;
};

struct SimOutput {
  bool png = true;
  bool ply = false;  ///< particles
  bool vtk = false;  ///< fields (.vti) or particles (.vtp)

  bool operator==(const SimOutput&) const = default;
};

struct SimScene {
  std::string title;
  SimMethod method = SimMethod::grid;
  int dimensions = 3;
  dvec3 size{1};       ///< m, of the domain
  double spacing = 0;  ///< m, of cells or of particles at rest
  SimSide sides[6];    ///< left (x = 0), right, bottom (y = 0), top, back (z = 0), front
  dvec3 gravity{0, -9.81, 0};
  SimFluid fluid;
  SimSolver solver;
  SimStart start = SimStart::rest;
  std::vector<SimBody> liquid;
  std::vector<SimBody> solids;
  std::vector<SimSource> sources;
  double duration = 1;  ///< s
  double frames_per_second = 30;
  SimPicture picture;
  SimOutput output;

  bool operator==(const SimScene&) const = default;
};

/// Cells along each axis: the size in spacings, rounded, at least 1; 1 in z in 2 dimensions.
ivec3 cells_of(const SimScene& scene);

/// Frames after the first one, at time 0: duration x frames_per_second, rounded to nearest.
int frame_count(const SimScene& scene);

/// Sets the spacing so that `cells` of them fit the longest side.
///
/// @throws std::invalid_argument  not in 2..4096, or more cells or particles than a scene may have.
void set_resolution(SimScene& scene, int cells);

/// What must hold beyond each number's own range, in one line with its place in the file
/// ("liquid[0]: sticks out of the domain"); empty: all is well.
std::string scene_fault(const SimScene& scene);

}  // namespace parity
