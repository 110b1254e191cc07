#include "cpu_reference/transform/slerp.h"

#include "cpu_reference/transform/quaternion.h"
#include "geometry/random.h"
#include "geometry/transform.h"
#include "gpu/transform/slerp.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"

namespace parity {
namespace {

using transform_test::u;

/// Pairs `angle` rad apart on the sphere of quaternions; every other one with the second negated,
/// which is the same rotation.
std::vector<SlerpProblem> pairs_apart(const Setting& setting) {
  Random random{setting.seed};
  const double angle = setting.at("angle");
  std::vector<SlerpProblem> problems(std::size_t(setting.count("count")));
  bool negate = false;
  for (SlerpProblem& p : problems) {
    const dquat from = cpu::quaternion_normalize(dquat(random.rotation()));
    const dquat turn =
        cpu::quaternion_from_axis_angle(glm::normalize(dvec3(random.direction())), 2 * angle);
    p.from = quat(from);
    p.to = quat(cpu::quaternion_compose(turn, from)) * (negate ? -1.0f : 1.0f);
    p.t = random.uniform();
    negate = !negate;
  }
  return problems;
}

double distance(const std::vector<dquat>& got, const std::vector<dquat>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int k = 0; k < 4; ++k) worst = std::max(worst, std::abs(got[i][k] - want[i][k]));
  return worst;
}

/// How far off the arc's true point: at angle t of the whole.
double error(const std::vector<SlerpProblem>& problems, const std::vector<dquat>& answers) {
  double worst = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const dquat from{problems[i].from};
    const double sign = glm::dot(from, dquat(problems[i].to)) < 0 ? -1 : 1;
    const dquat to = dquat(problems[i].to) * sign;
    const double whole = 2 * std::atan2(glm::length(to - from), glm::length(to + from));
    const double part =
        2 * std::atan2(glm::length(answers[i] - from), glm::length(answers[i] + from));
    worst = std::max(worst, std::abs(part - problems[i].t * whole));
  }
  return worst;
}

const Registration registration = register_stage<std::vector<SlerpProblem>, std::vector<dquat>>({
    .name = "transform/slerp",
    .title = "Shortest-arc interpolation of rotations at constant speed",
    .source = "notes 2.7; Shoemake 1985",
    .rows = {39},
    .axes = {transform_test::count_axis(),
             {.name = "angle",
              .unit = "rad",
              .low = 1e-6,
              .high = 1.5,
              .standard = 0.7,
              .logarithmic = true}},
    .problem = pairs_apart,
    .cpu = {{.solve = [](const std::vector<SlerpProblem>& p) { return cpu::slerp(p); }},
            {.name = "nlerp",
             .solve = [](const std::vector<SlerpProblem>& p) { return cpu::nlerp(p); }}},
    .gpu = {{.name = "reference",
             .solve =
                 [](gpu::Context& context, const std::vector<SlerpProblem>& p) {
                   const std::vector<quat> answer = gpu::slerp(context, p);
                   return std::vector<dquat>(answer.begin(), answer.end());
                 }}},
    .distance = distance,
    .tolerance = 32 * u,
    .why = "weights sin((1-t)W)/sin W, up to 1 each for W <= pi/2, from an angle that is "
           "found without acos: its "
           "error of 4 u passes into a weight by at most a factor 2, sines by own "
           "polynomials 2 u, the division "
           "2.5 ULP, two products and a sum; input quaternions are unit to 2 u, twice",
    .error = error,
    .error_unit = "rad",
    .chart_axes = {"angle"},
});

}  // namespace
}  // namespace parity
