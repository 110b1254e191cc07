#include "cpu_reference/transform/slerp.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/transform/quaternion.h"

namespace parity::cpu {
namespace {

double dot(dquat p, dquat q) { return p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z; }

dquat combine(double a, dquat p, double b, dquat q) {
  return dquat(a * p.w + b * q.w, a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z);
}

/// Two unit quaternions of the same rotations, at most a right angle apart on the sphere.
struct Arc {
  dquat from;
  dquat to;
  double cosine;
};

Arc shorter_arc(const SlerpProblem& problem) {
  const dquat from = quaternion_normalize(dquat(problem.from));
  const dquat to = quaternion_normalize(dquat(problem.to));
  const double cosine = dot(from, to);
  if (cosine < 0.0) return {from, combine(-1.0, to, 0.0, to), -cosine};
  return {from, to, cosine};
}

dquat nlerp(const Arc& arc, double t) {
  return quaternion_normalize(combine(1.0 - t, arc.from, t, arc.to));
}

dquat slerp(const Arc& arc, double t) {
  // Below this angle slerp and nlerp differ by less than Omega^2 / 8 of it: beneath rounding.
  const double smallest_angle = 1e-7;
  const double omega = std::acos(std::min(arc.cosine, 1.0));
  if (omega < smallest_angle) return nlerp(arc, t);
  const double sine = std::sin(omega);
  return quaternion_normalize(
      combine(std::sin((1.0 - t) * omega) / sine, arc.from, std::sin(t * omega) / sine, arc.to));
}

}  // namespace

std::vector<dquat> slerp(std::span<const SlerpProblem> problems) {
  std::vector<dquat> poses;
  poses.reserve(problems.size());
  for (const SlerpProblem& problem : problems)
    poses.push_back(slerp(shorter_arc(problem), double(problem.t)));
  return poses;
}

std::vector<dquat> nlerp(std::span<const SlerpProblem> problems) {
  std::vector<dquat> poses;
  poses.reserve(problems.size());
  for (const SlerpProblem& problem : problems)
    poses.push_back(nlerp(shorter_arc(problem), double(problem.t)));
  return poses;
}

}  // namespace parity::cpu
