#include "cpu_reference/texture/procedural.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace parity::cpu {
namespace {

using Lattice = glm::i64vec3;

std::uint32_t permuted(std::int64_t i) { return perlin_permutation[std::size_t(i & 255)]; }

std::uint32_t hash(const Lattice& p) { return permuted(permuted(permuted(p.x) + p.y) + p.z); }

/// The middles of the twelve edges of a cube; four of them twice, to make 16.
constexpr dvec3 edges[16] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {0, -1, 1}, {-1, 1, 0}, {0, -1, -1}};

/// 1 at 0, 0 at 1, with two derivatives 0 at both.
double fall(double t) {
  t = 1 - std::abs(t);
  return t * t * t * (t * (t * 6 - 15) + 10);
}

/// Sum over the corners of the cell: each one's ramp, faded out towards the others.
double perlin(dvec3 p) {
  const Lattice cell(glm::floor(p));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Lattice at = cell + Lattice(corner & 1, corner >> 1 & 1, corner >> 2);
    const dvec3 d = p - dvec3(at);
    sum += fall(d.x) * fall(d.y) * fall(d.z) * glm::dot(edges[hash(at) & 15], d);
  }
  return sum;
}

template <typename Of>
double octaves(dvec3 p, const Of& of) {
  double sum = 0;
  for (std::uint32_t k = 0; k < procedural_octaves; ++k)
    sum += std::ldexp(of(perlin(p * std::ldexp(1.0, int(k)))), -int(k));
  return sum;
}

double turbulence(dvec3 p) {
  return octaves(p, [](double noise) { return std::abs(noise); });
}

double worley(dvec3 p) {
  const Lattice middle(glm::floor(p));
  double nearest = std::numeric_limits<double>::infinity();
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const Lattice cell = middle + Lattice(x, y, z);
        const std::uint32_t h = hash(cell);
        const dvec3 place = dvec3(permuted(h), permuted(h + 85), permuted(h + 170)) / 255.0;
        nearest = std::min(nearest, glm::distance(p, dvec3(cell) + place));
      }
  return nearest;
}

/// 0 at whole numbers, 1 halfway between.
double triangle_wave(double x) { return 2 * std::abs(x - std::round(x)); }

}  // namespace

double procedural(Procedural kind, dvec3 p) {
  switch (kind) {
    case Procedural::perlin:
      return perlin(p);
    case Procedural::fractal:
      return octaves(p, [](double noise) { return noise; });
    case Procedural::turbulence:
      return turbulence(p);
    case Procedural::worley:
      return worley(p);
    case Procedural::marble:
      return 0.5 + 0.5 * std::sin(2 * std::numbers::pi * (p.x + turbulence(p)));
    case Procedural::wood:
      return triangle_wave(4 * std::hypot(p.x, p.z) + perlin(p));
  }
  throw std::invalid_argument("cpu::procedural: unknown kind");
}

}  // namespace parity::cpu
