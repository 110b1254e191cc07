#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "cpu_reference/transform/compose.h"
#include "cpu_reference/transform/look_at.h"
#include "cpu_reference/transform/orthographic.h"
#include "cpu_reference/transform/perspective.h"
#include "cpu_reference/transform/quaternion.h"
#include "cpu_reference/transform/rotate.h"
#include "cpu_reference/transform/slerp.h"
#include "tests/transform/errata_slerp.h"
#include "tests/transform/errata_squeeze.h"

namespace parity {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Twenty roundings of doubles of order 1.
constexpr double rounding = 20.0 * 0x1p-53;

template <class Matrix>
double largest_difference(const Matrix& a, const Matrix& b) {
  double largest = 0.0;
  for (int c = 0; c < Matrix::length(); ++c)
    for (int r = 0; r < Matrix::col_type::length(); ++r)
      largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
  return largest;
}

dvec3 project(const dmat4& matrix, dvec3 point) {
  const dvec4 q = matrix * dvec4(point, 1.0);
  return dvec3(q) / q.w;
}

void expect_near(dvec3 a, dvec3 b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

quat random_unit_quaternion(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(quat(normal(random), normal(random), normal(random), normal(random)));
}

dmat4 perspective(const ViewVolume& volume, DepthMode depth) {
  return cpu::perspective(std::vector{volume}, depth)[0];
}

dmat4 orthographic(const ViewVolume& volume, DepthMode depth) {
  return cpu::orthographic(std::vector{volume}, depth)[0];
}

dmat4 look_at(const LookAt& camera) { return cpu::look_at(std::vector{camera})[0]; }

dquat slerp(const SlerpProblem& problem) { return cpu::slerp(std::vector{problem})[0]; }

// 2.1 to 2.4: homogeneous coordinates, composition, rotations

TEST(TransformReference, TranslationMovesPointsAndNotVectors) {
  const dmat4 t = cpu::translation({1.0, 2.0, 3.0});
  EXPECT_EQ(t * dvec4(4.0, 5.0, 6.0, 1.0), dvec4(5.0, 7.0, 9.0, 1.0));
  EXPECT_EQ(t * dvec4(4.0, 5.0, 6.0, 0.0), dvec4(4.0, 5.0, 6.0, 0.0));
}

TEST(TransformReference, ComposesTranslationAfterRotationAfterScale) {
  const float half = std::numbers::sqrt2_v<float> / 2.0f;
  const Trs trs{{10.0f, 0.0f, 0.0f}, quat(half, 0.0f, 0.0f, half), {2.0f, 3.0f, 4.0f}};
  const dmat4 m = cpu::compose(std::vector{trs})[0];
  // x doubles, turns by 90 degrees about z onto y, moves: the other orders give other points.
  expect_near(dvec3(m * dvec4(1.0, 0.0, 0.0, 1.0)), {10.0, 2.0, 0.0}, rounding * 10.0);
  const dmat4 other =
      cpu::scaling({2, 3, 4}) * cpu::rotation(dquat(trs.rotation)) * cpu::translation({10, 0, 0});
  EXPECT_GT(largest_difference(m, other), 1.0);
}

TEST(TransformReference, ComposeRefusesTheZeroQuaternion) {
  const Trs trs{.rotation = quat(0.0f, 0.0f, 0.0f, 0.0f)};
  EXPECT_THROW(cpu::compose(std::vector{trs}), std::invalid_argument);
  EXPECT_TRUE(cpu::compose({}).empty());
}

TEST(TransformReference, DeterminantsOf2DTransforms) {
  EXPECT_NEAR(glm::determinant(cpu::rotation_2d(0.7)), 1.0, rounding);
  EXPECT_EQ(glm::determinant(cpu::scaling_2d({3.0, -2.0})), -6.0);
  EXPECT_EQ(glm::determinant(cpu::shear_2d({0.5, 0.0})), 1.0);
  EXPECT_EQ(cpu::shear_2d({0.5, 0.0}) * dvec3(1.0, 2.0, 1.0), dvec3(2.0, 2.0, 1.0));
}

TEST(TransformReference, TransformAboutAPointKeepsThePoint) {
  const dvec3 p = cpu::about_point(cpu::rotation_2d(1.1), {3.0, -7.0}) * dvec3(3.0, -7.0, 1.0);
  expect_near(p, {3.0, -7.0, 1.0}, rounding * 10.0);
}

TEST(TransformReference, AxisRotationsAreRotationsAndTurnTheRightWay) {
  for (const double angle : {-2.0, 0.0, 0.3, pi / 2.0, pi}) {
    for (const dmat3& r :
         {cpu::rotation_x(angle), cpu::rotation_y(angle), cpu::rotation_z(angle)}) {
      EXPECT_LE(largest_difference(glm::transpose(r) * r, dmat3(1.0)), rounding);
      EXPECT_NEAR(glm::determinant(r), 1.0, rounding);
    }
  }
  expect_near(cpu::rotation_x(pi / 2.0) * dvec3(0, 1, 0), {0, 0, 1}, rounding);
  expect_near(cpu::rotation_y(pi / 2.0) * dvec3(0, 0, 1), {1, 0, 0}, rounding);
  expect_near(cpu::rotation_z(pi / 2.0) * dvec3(1, 0, 0), {0, 1, 0}, rounding);
}

TEST(TransformReference, RodriguesEqualsQuaternionAxisMatricesAndGlm) {
  std::mt19937 random{1};
  std::normal_distribution<float> normal;
  for (int i = 0; i < 200; ++i) {
    const AxisAngle r{vec3(normal(random), normal(random), normal(random)), 3.0f * normal(random)};
    const dmat3 m = cpu::rotate(std::vector{r})[0];
    const dvec3 axis = glm::normalize(dvec3(r.axis));
    const dquat q = cpu::quaternion_from_axis_angle(axis, r.angle);
    EXPECT_LE(largest_difference(m, cpu::quaternion_matrix(q)), rounding);
    EXPECT_LE(largest_difference(m, dmat3(glm::rotate(dmat4(1.0), double(r.angle), axis))),
              rounding);
    const dvec3 v{normal(random), normal(random), normal(random)};
    expect_near(m * v, cpu::rodrigues(v, axis, r.angle), rounding * glm::length(v));
  }
  EXPECT_LE(largest_difference(cpu::rotate(std::vector{AxisAngle{{0, 1, 0}, 0.4f}})[0],
                               cpu::rotation_y(double(0.4f))),
            rounding);
}

TEST(TransformReference, RotationByZeroAndByPi) {
  EXPECT_EQ(cpu::rotate(std::vector{AxisAngle{{1, 2, 3}, 0.0f}})[0], dmat3(1.0));
  const dvec3 axis = glm::normalize(dvec3(1, 2, 3));
  const dmat3 half_turn = 2.0 * glm::outerProduct(axis, axis) - dmat3(1.0);
  // The angle is pi rounded to float: off by 8.8e-8.
  EXPECT_LE(
      largest_difference(
          cpu::rotate(std::vector{AxisAngle{{1, 2, 3}, std::numbers::pi_v<float>}})[0], half_turn),
      1e-7);
  EXPECT_THROW(cpu::rotate(std::vector{AxisAngle{vec3(0.0f), 1.0f}}), std::invalid_argument);
}

// Each class of 2.4 keeps its invariant, and loses that of the class before.
TEST(TransformReference, ClassesKeepTheirInvariants) {
  const dmat4 rigid = cpu::translation({1, -2, 3}) * dmat4(cpu::rotation_x(0.8));
  const dmat4 similarity = rigid * cpu::scaling(dvec3(2.5));
  const dmat4 affine = rigid * cpu::scaling({1, 2, 3});
  const dmat4 projective =
      perspective({-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 20.0f}, DepthMode::standard);
  const dvec3 a{0.3, 0.1, -2.0}, b{1.2, -0.4, -3.0}, c{-0.7, 0.9, -5.0};
  const auto length = [&](const dmat4& m) { return glm::length(project(m, b) - project(m, a)); };
  const auto cosine = [&](const dmat4& m) {
    return glm::dot(glm::normalize(project(m, b) - project(m, a)),
                    glm::normalize(project(m, c) - project(m, a)));
  };
  const auto parallel = [&](const dmat4& m) {  // of a -> b and the same arrow at c
    return glm::length(glm::cross(glm::normalize(project(m, b) - project(m, a)),
                                  glm::normalize(project(m, c + b - a) - project(m, c))));
  };
  const dmat4 identity{1.0};
  EXPECT_NEAR(length(rigid), length(identity), rounding * 4.0);
  EXPECT_GT(std::abs(length(similarity) - length(identity)), 1.0);
  EXPECT_NEAR(cosine(similarity), cosine(identity), rounding * 4.0);
  EXPECT_GT(std::abs(cosine(affine) - cosine(identity)), 0.01);
  EXPECT_NEAR(parallel(affine), 0.0, rounding * 4.0);
  EXPECT_GT(parallel(projective), 0.01);
}

TEST(TransformReference, ProjectionKeepsTheCrossRatio) {
  const dmat4 m = perspective({-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 20.0f}, DepthMode::standard);
  const dvec3 origin{0.3, 0.1, -2.0}, direction{1.2, -0.4, -3.0};
  const auto cross_ratio = [&](const dmat4& t) {
    dvec3 p[4];
    for (int i = 0; i < 4; ++i) p[i] = project(t, origin + direction * (0.4 * i * i));
    return glm::length(p[2] - p[0]) * glm::length(p[3] - p[1]) /
           (glm::length(p[2] - p[1]) * glm::length(p[3] - p[0]));
  };
  EXPECT_NEAR(cross_ratio(m), cross_ratio(dmat4(1.0)), 1e-13);  // differences lose three digits
}

// 2.5: the view

TEST(TransformReference, LookAtPutsTheEyeAtTheOriginAndTheCenterAhead) {
  std::mt19937 random{2};
  std::normal_distribution<float> normal{0.0f, 5.0f};
  for (int i = 0; i < 100; ++i) {
    const LookAt camera{vec3(normal(random), normal(random), normal(random)),
                        vec3(normal(random), normal(random), normal(random)), vec3(0, 1, 0)};
    const dmat4 v = look_at(camera);
    const dvec3 eye{camera.eye}, center{camera.center};
    const double size = glm::length(eye) + glm::length(center);
    expect_near(project(v, eye), dvec3(0.0), rounding * size);
    expect_near(project(v, center), {0.0, 0.0, -glm::length(center - eye)}, rounding * size);
    EXPECT_NEAR(glm::determinant(v), 1.0, rounding);
    EXPECT_LE(largest_difference(v, glm::lookAt(eye, center, dvec3(camera.up))),
              2.0 * rounding * size);
    EXPECT_GT((v * dvec4(0.0, 1.0, 0.0, 0.0)).y, 0.0);
  }
}

TEST(TransformReference, LookAtRefusesWhatHasNoDirection) {
  EXPECT_THROW(look_at({vec3(1, 2, 3), vec3(1, 2, 3), vec3(0, 1, 0)}), std::invalid_argument);
  EXPECT_THROW(look_at({vec3(0), vec3(0, 5, 0), vec3(0, 1, 0)}), std::invalid_argument);
  EXPECT_THROW(look_at({vec3(0), vec3(0, 0, -1), vec3(0)}), std::invalid_argument);
  EXPECT_THROW(look_at({vec3(0), vec3(0, 0, -infinity), vec3(0, 1, 0)}), std::invalid_argument);
}

// 2.6: projections

TEST(TransformReference, PerspectiveMapsTheFrustumOntoVulkansClipVolume) {
  const ViewVolume v{-2.0f, 3.0f, -1.0f, 4.0f, 1.5f, 80.0f};
  const dmat4 m = perspective(v, DepthMode::standard);
  const double growth = double(v.far) / double(v.near);
  // y turns over: the top of the frustum is NDC -1.
  expect_near(project(m, {v.left, v.top, -v.near}), {-1, -1, 0}, rounding);
  expect_near(project(m, {v.right, v.bottom, -v.near}), {1, 1, 0}, rounding);
  expect_near(project(m, {v.left * growth, v.top * growth, -v.far}), {-1, -1, 1}, rounding);
  expect_near(project(m, {v.right * growth, v.bottom * growth, -v.far}), {1, 1, 1}, rounding);
}

TEST(TransformReference, ReverseZAndInfiniteFar) {
  const ViewVolume finite{-1.0f, 1.0f, -1.0f, 1.0f, 0.5f, 100.0f};
  ViewVolume endless = finite;
  endless.far = infinity;
  const auto depth = [](const dmat4& m, double z) { return project(m, {0.0, 0.0, z}).z; };
  const dmat4 reverse = perspective(finite, DepthMode::reverse_z);
  EXPECT_NEAR(depth(reverse, -0.5), 1.0, rounding);
  EXPECT_NEAR(depth(reverse, -100.0), 0.0, rounding);
  EXPECT_EQ(depth(perspective(endless, DepthMode::reverse_z), -0.5), 1.0);
  EXPECT_EQ(depth(perspective(endless, DepthMode::reverse_z), -5e5), 1e-6);
  EXPECT_EQ(depth(perspective(endless, DepthMode::standard), -0.5), 0.0);
  EXPECT_EQ(depth(perspective(endless, DepthMode::standard), -5.0), 0.9);
  EXPECT_EQ(perspective(finite, DepthMode::logarithmic), perspective(finite, DepthMode::standard));
}

TEST(TransformReference, PerspectiveEqualsGlmUpToTheTurnOfY) {
  const ViewVolume v{-2.0f, 3.0f, -1.0f, 4.0f, 1.5f, 80.0f};
  const dmat4 y_down = cpu::scaling({1.0, -1.0, 1.0});
  EXPECT_LE(largest_difference(y_down * perspective(v, DepthMode::standard),
                               glm::frustumRH_ZO(-2.0, 3.0, -1.0, 4.0, 1.5, 80.0)),
            4.0 * rounding);
  EXPECT_LE(largest_difference(cpu::perspective_gl(v),
                               glm::frustumRH_NO(-2.0, 3.0, -1.0, 4.0, 1.5, 80.0)),
            4.0 * rounding);
  EXPECT_LE(largest_difference(y_down * orthographic(v, DepthMode::standard),
                               glm::orthoRH_ZO(-2.0, 3.0, -1.0, 4.0, 1.5, 80.0)),
            rounding);
}

TEST(TransformReference, GlFrustumHasDepthFromMinusOneToOne) {
  const dmat4 m = cpu::perspective_gl({-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 10.0f});
  expect_near(project(m, {1, 1, -1}), {1, 1, -1}, rounding);
  expect_near(project(m, {-10, 10, -10}), {-1, 1, 1}, rounding);
}

TEST(TransformReference, PerspectiveIsSqueezeThenOrthographic) {
  const ViewVolume v{-2.0f, 3.0f, -1.0f, 4.0f, 1.5f, 80.0f};
  const dmat4 composed = orthographic(v, DepthMode::standard) * cpu::squeeze(v.near, v.far);
  EXPECT_LE(largest_difference(composed, perspective(v, DepthMode::standard)), 4.0 * rounding);
}

TEST(TransformReference, OrthographicMapsTheBoxCorners) {
  const ViewVolume v{-2.0f, 3.0f, -1.0f, 4.0f, -1.5f, 80.0f};
  const dmat4 m = orthographic(v, DepthMode::standard);
  expect_near(project(m, {v.left, v.top, -v.near}), {-1, -1, 0}, rounding);
  expect_near(project(m, {v.right, v.bottom, -v.far}), {1, 1, 1}, rounding);
  const dmat4 reverse = orthographic(v, DepthMode::reverse_z);
  expect_near(project(reverse, {v.left, v.top, -v.near}), {-1, -1, 1}, rounding);
  expect_near(project(reverse, {v.right, v.bottom, -v.far}), {1, 1, 0}, rounding);
}

TEST(TransformReference, ProjectionsRefuseEmptyVolumes) {
  EXPECT_THROW(perspective({1, 1, -1, 1, 1, 10}, DepthMode::standard), std::invalid_argument);
  EXPECT_THROW(perspective({-1, 1, -1, 1, 0, 10}, DepthMode::standard), std::invalid_argument);
  EXPECT_THROW(perspective({-1, 1, -1, 1, 10, 1}, DepthMode::standard), std::invalid_argument);
  EXPECT_THROW(perspective({-1, 1, -1, 1, NAN, 1}, DepthMode::standard), std::invalid_argument);
  EXPECT_THROW(orthographic({-1, 1, -1, 1, 2, 2}, DepthMode::standard), std::invalid_argument);
  EXPECT_THROW(orthographic({-1, 1, -1, 1, 2, infinity}, DepthMode::standard),
               std::invalid_argument);
  EXPECT_THROW(cpu::squeeze(1.0, double(infinity)), std::invalid_argument);
}

TEST(TransformReference, FocalLengthSeesTheEdgeOfTheImageUnderHalfTheFieldOfView) {
  EXPECT_NEAR(cpu::focal_length(2.0, pi / 2.0), 1.0, rounding);
  EXPECT_NEAR(std::atan(12.0 / cpu::focal_length(24.0, 0.6)), 0.3, rounding);
}

TEST(TransformReference, ErratumSqueezeMatrix) {
  EXPECT_TRUE(squeezes_the_frustum(cpu::squeeze));
  const auto notes = [](double n, double f) {
    return glm::transpose(dmat4(n, 0, 0, 0, 0, n, 0, 0, 0, 0, n + f, -f * n, 0, 0, 1, 0));
  };
  EXPECT_FALSE(squeezes_the_frustum(notes));
  EXPECT_EQ(project(notes(1.0, 10.0), {0.0, 0.0, -1.0}).z, 21.0);  // the published wrong value
}

// 2.7: quaternions

TEST(TransformReference, QuaternionsComposeInvertAndKeepNorms) {
  std::mt19937 random{3};
  for (int i = 0; i < 100; ++i) {
    const dquat p{random_unit_quaternion(random)}, q = 3.0 * dquat(random_unit_quaternion(random));
    const dvec3 v{1.0, -2.0, 0.5};
    expect_near(cpu::quaternion_rotate(cpu::quaternion_compose(p, q), v),
                cpu::quaternion_rotate(p, cpu::quaternion_rotate(q, v)), 4.0 * rounding);
    expect_near(cpu::quaternion_rotate(cpu::quaternion_inverse(q), cpu::quaternion_rotate(q, v)), v,
                4.0 * rounding);
    EXPECT_NEAR(glm::length(cpu::quaternion_rotate(q, v)), glm::length(v), 4.0 * rounding);
    const dquat one = cpu::quaternion_compose(q, cpu::quaternion_inverse(q));
    EXPECT_NEAR(one.w, 1.0, rounding);
    EXPECT_NEAR(glm::length(dvec3(one.x, one.y, one.z)), 0.0, rounding);
    const dquat u = cpu::quaternion_normalize(q);
    EXPECT_LE(largest_difference(cpu::quaternion_matrix(u), glm::mat3_cast(u)), rounding);
    expect_near(cpu::quaternion_matrix(u) * v, cpu::quaternion_rotate(u, v), 4.0 * rounding);
  }
}

TEST(TransformReference, QuaternionBatchesRefuseWhatDoesNotFit) {
  const std::vector<quat> one{quat(1, 0, 0, 0)};
  const std::vector<vec3> two(2);
  EXPECT_THROW(cpu::quaternion_rotate(one, two), std::invalid_argument);
  EXPECT_THROW(cpu::quaternion_inverse(dquat(0, 0, 0, 0)), std::invalid_argument);
  EXPECT_THROW(cpu::quaternion_from_axis_angle(dvec3(0.0), 1.0), std::invalid_argument);
  EXPECT_TRUE(cpu::quaternion_matrix(std::span<const quat>{}).empty());
}

TEST(TransformReference, SlerpTurnsAtConstantSpeedBetweenItsEnds) {
  std::mt19937 random{4};
  for (int i = 0; i < 50; ++i) {
    const quat from = random_unit_quaternion(random), to = random_unit_quaternion(random);
    const dquat a = slerp({from, to, 0.0f}), b = slerp({from, to, 1.0f});
    const double whole = rotation_angle(b * glm::conjugate(a));
    // atan2 of doubles; the angle is twice that of the quaternion.
    EXPECT_LT(rotation_angle(a * glm::conjugate(glm::normalize(dquat(from)))), 2.0 * rounding);
    EXPECT_LT(rotation_angle(b * glm::conjugate(glm::normalize(dquat(to)))), 2.0 * rounding);
    EXPECT_LE(whole, pi + rounding);
    for (const float t : {0.125f, 0.5f, 0.875f}) {
      const dquat pose = slerp({from, to, t});
      EXPECT_NEAR(glm::length(pose), 1.0, rounding);
      EXPECT_NEAR(rotation_angle(pose * glm::conjugate(a)), whole * t, 1e-12);
      const dquat opinion =
          glm::slerp(glm::normalize(dquat(from)), glm::normalize(dquat(to)), double(t));
      EXPECT_LT(rotation_angle(pose * glm::conjugate(opinion)), 1e-12);
    }
  }
}

TEST(TransformReference, SlerpOfNearlyEqualPosesIsTheLinearLimit) {
  const quat from{1, 0, 0, 0};
  for (const float angle : {0.0f, 1e-30f, 1e-7f, 1e-4f}) {
    const quat to{std::cos(angle), std::sin(angle), 0.0f, 0.0f};
    const dquat pose = slerp({from, to, 0.25f});
    EXPECT_NEAR(pose.x, 0.25 * std::sin(double(angle)), 1e-8 * angle + 1e-38);
    EXPECT_NEAR(glm::length(pose), 1.0, rounding);
  }
}

TEST(TransformReference, NlerpMeetsSlerpInTheMiddleOnly) {
  const SlerpProblem problem{quat(1, 0, 0, 0), quat(0.6f, 0.8f, 0.0f, 0.0f), 0.5f};
  const auto nlerp = [](SlerpProblem p) { return cpu::nlerp(std::vector{p})[0]; };
  EXPECT_LT(rotation_angle(nlerp(problem) * glm::conjugate(slerp(problem))), 2.0 * rounding);
  SlerpProblem early = problem;
  early.t = 0.25f;
  EXPECT_GT(rotation_angle(nlerp(early) * glm::conjugate(slerp(early))), 1e-3);
}

TEST(TransformReference, ErratumSlerpTakesTheShortestArc) {
  EXPECT_TRUE(takes_the_shortest_arc(slerp));
  const auto notes = [](const SlerpProblem& p) {
    const dquat a{p.from}, b{p.to};
    const double omega = std::acos(glm::dot(a, b));
    return (std::sin((1.0 - p.t) * omega) * a + std::sin(p.t * omega) * b) / std::sin(omega);
  };
  EXPECT_FALSE(takes_the_shortest_arc(notes));
}

}  // namespace
}  // namespace parity
