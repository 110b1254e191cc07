#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/math.h"

/// Ordinary differential equations in two variables: what they are, their exact solutions, and how
/// they are measured.
namespace parity {

enum class OdeMethod : std::uint32_t {
  explicit_euler,
  implicit_euler,
  symplectic_euler,
  trapezoid,
  midpoint,
  rk4,
  dormand_prince,  ///< 5(4), adaptive
};
inline constexpr std::uint32_t ode_method_count = 7;
const char* name_of(OdeMethod method);

/// x' = f(x, t) of state (x, y) with parameters (a, b).
enum class OdeSystem : std::uint32_t {
  linear,       ///< z' = (a + i b) z with z = x + i y
  oscillator,   ///< x' = y, y' = -a^2 x
  pendulum,     ///< x' = y, y' = -a^2 sin x
  van_der_pol,  ///< x' = y, y' = a (1 - x^2) y - x; stiff for large a
  driven,       ///< x' = a (x - cos t) - sin t, y' = b y: Prothero & Robinson's
};

struct OdeInstance {
  vec2 initial{1, 0};
  vec2 parameters{1, 0};
};

struct OdeProblem {
  OdeMethod method = OdeMethod::rk4;
  OdeSystem system = OdeSystem::oscillator;
  std::vector<OdeInstance> instances;
  double step = 0.1;        ///< s; of the adaptive method: the first
  std::uint32_t steps = 1;  ///< the end is at step * steps, for the adaptive method too
  double tolerance = 1e-5;  ///< of the adaptive method: local error, relative and absolute
};

/// @throws std::invalid_argument  the step is not positive and finite, the tolerance not in
///                                [1e-14, 1], or a state or parameter not finite.
void check_ode_problem(const OdeProblem& problem);

/// Where the systems of a problem ended.
struct OdeResult {
  std::vector<dvec2> states;
  std::vector<std::uint32_t> evaluations;  ///< of f; of the Jacobian not
};

/// None for systems whose solution is no closed form.
std::optional<dvec2> ode_exact(OdeSystem system, const OdeInstance& instance, double t);

/// What the oscillator and the pendulum conserve: y^2 / 2 + a^2 x^2 / 2, or y^2 / 2 + a^2 (1 - cos
/// x).
double ode_energy(OdeSystem system, const OdeInstance& instance, const dvec2& state);

}  // namespace parity
