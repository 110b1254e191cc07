// The device's transforms against closed forms in double; no reference on the CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "gpu/transform/compose.h"
#include "gpu/transform/look_at.h"
#include "gpu/transform/orthographic.h"
#include "gpu/transform/perspective.h"
#include "gpu/transform/quaternion.h"
#include "gpu/transform/rotate.h"
#include "gpu/transform/slerp.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

constexpr float ulp = 1.0f / 16777216.0f;

std::vector<quat> random_rotations(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<quat> rotations;
  for (int i = 0; i < count; ++i)
    rotations.emplace_back(
        glm::normalize(dquat(normal(random), normal(random), normal(random), normal(random))));
  return rotations;
}

template <typename Matrix, typename Double>
double farthest(const Matrix& got, const Double& want) {
  double worst = 0;
  for (int c = 0; c < got.length(); ++c)
    for (int r = 0; r < got[c].length(); ++r)
      worst = std::max(worst, std::abs(double(got[c][r]) - want[c][r]));
  return worst;
}

TEST(GpuRotate, IsRodriguesForAnglesOfAllSizes) {
  std::vector<AxisAngle> problems;
  for (const float angle : {0.0f, 1e-6f, 0.5f, 1.5707963f, 3.1415927f, -2.0f, 100.0f, -8000.0f})
    for (const dvec3 axis : {dvec3(1, 0, 0), dvec3(0.6, 0, -0.8), dvec3(2, -3, 6) / 7.0})
      problems.push_back({vec3(axis), angle});
  const std::vector<mat3> matrices = gpu::rotate(test_context(), problems);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const dvec3 k = problems[i].axis;
    const double s = std::sin(double(problems[i].angle)), c = std::cos(double(problems[i].angle));
    const dmat3 want = c * dmat3(1) + s * dmat3(0, k.z, -k.y, -k.z, 0, k.x, k.y, -k.x, 0) +
                       (1 - c) * glm::outerProduct(k, k);
    // 2^-22 of sine and cosine each, and 4 roundings of numbers up to 2.
    EXPECT_LT(farthest(matrices[i], want), 12 * ulp) << problems[i].angle;
  }
}

TEST(GpuQuaternion, TurnsAsItsMatrixDoes) {
  const std::vector<quat> rotations = random_rotations(131);
  const std::vector<vec3> vectors(rotations.size(), vec3(1, -2, 3));
  const auto matrices = gpu::quaternion_matrix(test_context(), rotations);
  const auto turned = gpu::quaternion_rotate(test_context(), rotations, vectors);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const dmat3 want = glm::mat3_cast(glm::normalize(dquat(rotations[i])));
    EXPECT_LT(farthest(matrices[i], want), 8 * ulp);
    EXPECT_LT(glm::length(dvec3(turned[i]) - want * dvec3(vectors[i])), 16 * ulp * 4);
  }
}

TEST(GpuCompose, ScalesThenTurnsThenMoves) {
  // A quarter turn about z takes (2, 0, 0) = scale (2, 3, 4) of (1, 0, 0) to (0, 2, 0).
  const float h = std::sqrt(0.5f);
  const std::vector<Trs> trs{{vec3(5, 6, 7), quat(h, 0, 0, h), vec3(2, 3, 4)}};
  const mat4 m = gpu::compose(test_context(), trs)[0];
  EXPECT_LT(glm::length(m * vec4(1, 0, 0, 1) - vec4(5, 8, 7, 1)), 8 * ulp * 8);
  EXPECT_LT(glm::length(m * vec4(0, 1, 0, 1) - vec4(2, 6, 7, 1)), 8 * ulp * 8);
  EXPECT_LT(glm::length(m * vec4(0, 0, 1, 0) - vec4(0, 0, 4, 0)), 8 * ulp * 4);
}

TEST(GpuLookAt, PutsTheEyeAtTheOriginAndTheCenterAhead) {
  const std::vector<LookAt> cameras{{vec3(1, 2, 3), vec3(-4, 0, 9), vec3(0, 1, 0)}};
  const mat4 view = gpu::look_at(test_context(), cameras)[0];
  const double distance = std::sqrt(25.0 + 4.0 + 36.0);
  EXPECT_LT(glm::length(view * vec4(1, 2, 3, 1) - vec4(0, 0, 0, 1)), 32 * ulp);
  EXPECT_LT(glm::length(view * vec4(-4, 0, 9, 1) - vec4(0, 0, -distance, 1)), 64 * ulp);
  EXPECT_NEAR(glm::determinant(dmat4(view)), 1, 16 * ulp);
  EXPECT_GT((view * vec4(0, 1, 0, 0)).y, 0);
  const std::vector<LookAt> along_up{{vec3(0), vec3(0, 2, 0), vec3(0, 1, 0)}};
  EXPECT_THROW(gpu::look_at(test_context(), along_up), std::invalid_argument);
}

dvec3 projected(const mat4& m, const dvec3& p) {
  const dvec4 clip = dmat4(m) * dvec4(p, 1);
  return dvec3(clip) / clip.w;
}

TEST(GpuPerspective, TakesTheCornersOfTheFrustumToThoseOfClipSpace) {
  const ViewVolume v{-1, 3, -2, 1, 0.5f, 8};
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z}) {
    const mat4 m = gpu::perspective(test_context(), std::vector{v}, mode)[0];
    const double near = mode == DepthMode::reverse_z ? 1 : 0;
    const double k = v.far / v.near;  // the frustum widens with distance
    EXPECT_LT(glm::length(projected(m, {-1, 1, -0.5}) - dvec3(-1, -1, near)), 16 * ulp);
    EXPECT_LT(glm::length(projected(m, {3 * k, -2 * k, -8}) - dvec3(1, 1, 1 - near)), 16 * ulp);
  }
}

TEST(GpuPerspective, MayHaveNoFarPlane) {
  const ViewVolume v{-1, 1, -1, 1, 0.5f, std::numeric_limits<float>::infinity()};
  const mat4 reverse = gpu::perspective(test_context(), std::vector{v}, DepthMode::reverse_z)[0];
  EXPECT_DOUBLE_EQ(projected(reverse, {0, 0, -5}).z, 0.1);
  const mat4 standard = gpu::perspective(test_context(), std::vector{v}, DepthMode::standard)[0];
  EXPECT_DOUBLE_EQ(projected(standard, {0, 0, -5}).z, 0.9);
  const ViewVolume behind{-1, 1, -1, 1, -1, 5};
  EXPECT_THROW(gpu::perspective(test_context(), std::vector{behind}, DepthMode::standard),
               std::invalid_argument);
}

TEST(GpuOrthographic, TakesTheBoxToClipSpace) {
  const ViewVolume v{-1, 3, -2, 1, 0.5f, 8};
  const mat4 m = gpu::orthographic(test_context(), std::vector{v}, DepthMode::standard)[0];
  EXPECT_LT(glm::length(projected(m, {-1, 1, -0.5}) - dvec3(-1, -1, 0)), 8 * ulp);
  EXPECT_LT(glm::length(projected(m, {3, -2, -8}) - dvec3(1, 1, 1)), 8 * ulp);
}

TEST(GpuSlerp, KeepsItsSpeedOnTheShorterArc) {
  const std::vector<quat> rotations = random_rotations(64);
  std::vector<SlerpProblem> problems;
  for (std::size_t i = 0; i + 1 < rotations.size(); ++i)
    for (const float t : {0.0f, 0.25f, 0.5f, 0.9f, 1.0f})
      problems.push_back({rotations[i], rotations[i + 1], t});
  const std::vector<quat> between = gpu::slerp(test_context(), problems);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto& [from, to, t] = problems[i];
    const dquat start = glm::normalize(dquat(from));
    const double side = glm::dot(start, glm::normalize(dquat(to))) < 0 ? -1 : 1;
    const dquat end = side * glm::normalize(dquat(to));
    const double angle = std::acos(std::min(1.0, glm::dot(start, end)));
    const double a = std::sin((1 - double(t)) * angle) / std::sin(angle);
    const double b = std::sin(double(t) * angle) / std::sin(angle);
    const dquat want = a * start + b * end;
    // Inputs are unit to 2^-24; 24 terms of decreasing size round twice each.
    EXPECT_LT(glm::length(dquat(between[i]) - want), 8 * ulp) << i;
  }
}

TEST(GpuSlerp, StandsStillBetweenEqualOrientations) {
  const quat q = random_rotations(1)[0];
  const std::vector<SlerpProblem> problems{{q, q, 0.3f}, {q, -q, 0.7f}};
  for (const quat& between : gpu::slerp(test_context(), problems))
    EXPECT_LT(glm::length(between - q), 4 * ulp);
}

}  // namespace
}  // namespace parity
