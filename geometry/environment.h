#pragma once

#include <array>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// Directions and the unit square: the octahedron |x| + |y| + |z| = 1 with its lower half folded
/// out. u and v go from 0 to 1; (0.5, 0.5) is +z.
///
/// Source: Engelhardt & Dachsbacher 2008, "Octahedron Environment Maps".
dvec2 octahedral_uv(const dvec3& direction);
dvec3 octahedral_direction(const dvec2& uv);

/// Light from all around, W/(m^2 sr), linear RGB.
struct EnvironmentMap {
  /// Octahedral, from the largest to the smallest, each side half of the one before. Texels are
  /// averages over what they cover in the picture.
  std::vector<Grid<vec4>> levels;
};

/// @param picture  equirectangular: the middle of its top is +y, its middle -z; any size.
/// @param side     of the largest level, a power of two, 8 to 1024.
/// @throws std::invalid_argument  an empty picture, a side out of range; light that is negative or
///                                not finite counts as 0.
EnvironmentMap environment_map(const Grid<vec4>& picture, int side);

/// What a renderer needs of an environment: cpu::prefilter and gpu::prefilter make it.
struct EnvironmentLight {
  /// What a mirror of each of mirror_roughness shows where it is looked at straight: octahedral,
  /// with a border of one texel that repeats what is across the edge.
  std::vector<Grid<vec4>> mirrors;
  /// Irradiance over pi of a surface by its normal, likewise. Empty: the harmonics are enough.
  Grid<vec4> irradiance;
  /// The same as coefficients of 1, y, z, x, x y, y z, 3 z^2 - 1, x z, x^2 - y^2 of a unit normal.
  std::array<vec3, 9> harmonics{};
};

/// Of the levels of EnvironmentLight::mirrors; between them lookups mix. The first one stands for
/// the smoothest surfaces, whose lobes are within a texel: roughness r belongs to the level
/// max(min((r - 0.045) / 0.055, 10 r, 1 + 5 r), 0).
constexpr std::array<double, 7> mirror_roughness{0, 0.1, 0.2, 0.4, 0.6, 0.8, 1};
/// Without their borders.
constexpr std::array<int, 7> mirror_sides{256, 128, 128, 64, 32, 32, 32};

/// Side of EnvironmentLight::irradiance without its border, and the most that the level of the map
/// has whose texels it sums.
constexpr int irradiance_side = 64;
constexpr int irradiance_source_side = 128;

/// Are harmonics nowhere further from the irradiance of a map without border than a hundredth of
/// its mean? Then no picture needs the map. Light of which a part comes from lamps needs it.
bool harmonics_suffice(const std::array<vec3, 9>& harmonics, const Grid<vec4>& irradiance);

/// Copies a level into the middle of one with a border. Across an edge of the square lies the texel
/// that mirrors it at the middle of the edge.
Grid<vec4> with_border(const Grid<vec4>& level);

/// Radiance that a direction of the picture shows: the largest level, bilinear.
vec3 radiance_toward(const EnvironmentMap& map, const dvec3& direction);

}  // namespace parity
