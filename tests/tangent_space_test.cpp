#include "geometry/tangent_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace parity {
namespace {

/// A square of two triangles in z = 0, seen from +z, and its picture: v runs down.
//  3---2
//  | / |
//  0---1
Primitive square() {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  primitive.normals.assign(4, vec3(0, 0, 1));
  primitive.indices = {0, 1, 2, 0, 2, 3};
  primitive.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  return primitive;
}

TEST(TangentSpace, PointsAlongGrowingUWithTheBitangentUp) {
  Primitive primitive = square();
  make_tangents(primitive, primitive.uvs[0]);
  ASSERT_EQ(primitive.tangents.size(), 4u);
  for (const vec4& tangent : primitive.tangents) EXPECT_EQ(tangent, vec4(1, 0, 0, 1));
}

TEST(TangentSpace, TurnsTheSignWhereThePictureIsMirrored) {
  Primitive primitive = square();
  for (vec2& uv : primitive.uvs[0]) uv.x = 1 - uv.x;
  make_tangents(primitive, primitive.uvs[0]);
  for (const vec4& tangent : primitive.tangents) EXPECT_EQ(tangent, vec4(-1, 0, 0, -1));
}

//  3---2---5
//  | / | / |    the right square shows the left one's picture in a mirror
//  0---1---4
TEST(TangentSpace, SplitsVerticesOnAMirrorSeam) {
  Primitive primitive = square();
  primitive.positions.insert(primitive.positions.end(), {{2, 0, 0}, {2, 1, 0}});
  primitive.normals.assign(6, vec3(0, 0, 1));
  primitive.uvs[0].insert(primitive.uvs[0].end(), {{0, 1}, {0, 0}});
  primitive.indices.insert(primitive.indices.end(), {1, 4, 5, 1, 5, 2});
  make_tangents(primitive, std::vector(primitive.uvs[0]));
  EXPECT_EQ(primitive.positions.size(), 8u);
  for (std::size_t c = 0; c < 12; ++c) {
    const vec4 expected = c < 6 ? vec4(1, 0, 0, 1) : vec4(-1, 0, 0, -1);
    EXPECT_EQ(primitive.tangents[primitive.indices[c]], expected);
  }
}

/// Two squares that meet at a right angle on the y axis, with smooth normals on the fold.
TEST(TangentSpace, AveragesOverAFoldByAngle) {
  Primitive primitive;
  const float d = std::sqrt(0.5f);
  // Left face in x < 0, z = 0; right face in x = 0, z < 0; u runs along both.
  primitive.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {0, 0, -1}, {0, 1, -1}};
  primitive.normals = {{0, 0, 1}, {d, 0, d}, {d, 0, d}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}};
  primitive.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}, {2, 1}, {2, 0}}};
  primitive.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
  make_tangents(primitive, std::vector(primitive.uvs[0]));
  ASSERT_EQ(primitive.positions.size(), 6u);
  // Projected across the fold's normal both faces' tangents are (d, 0, -d), whatever the weights.
  const float rounding = 4 * 0x1p-24f;  // normals of float length, one rounding at the end
  for (const std::size_t v : {1u, 2u})
    EXPECT_NEAR(glm::length(vec3(primitive.tangents[v]) - vec3(d, 0, -d)), 0, rounding);
  EXPECT_EQ(primitive.tangents[0], vec4(1, 0, 0, 1));
  EXPECT_EQ(primitive.tangents[4], vec4(0, 0, -1, 1));
}

/// One corner of 90 degrees with the tangent x, one of 45 with the tangent (1, 1) / sqrt 2.
TEST(TangentSpace, WeighsByTheAngleAtTheCorner) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  primitive.normals.assign(4, vec3(0, 0, 1));
  primitive.indices = {0, 1, 2, 0, 2, 3};
  // u = x in the first triangle; in the second u grows along (1, 1) with v still falling: u = y at
  // the common edge must agree, so u(0) = 0, u(2) = 0, and v(0) = 1, v(2) = 0.
  primitive.uvs = {{{0, 1}, {1, 1}, {0, 0}, {-0.5f, -0.25f}}};
  make_tangents(primitive, std::vector(primitive.uvs[0]));
  // Second triangle: u = a x + b y, v = 1 + c x + e y: (0,1): b = 0, e = -1; (-1,1): a = 0.5, c =
  // 0.25. The tangent dp/du holds v fixed: c dx + e dy = 0, so it runs along (1, 0.25).
  const dvec2 second = glm::normalize(dvec2(1, 0.25));
  const double pi = std::numbers::pi;
  const dvec2 expected = glm::normalize(pi / 2 * dvec2(1, 0) + pi / 4 * second);
  EXPECT_NEAR(glm::length(dvec2(vec2(primitive.tangents[0])) - expected), 0, 2 * 0x1p-24);
}

TEST(TangentSpace, GivesSomeUnitTangentWhereThePictureHasNoArea) {
  Primitive primitive = square();
  make_tangents(primitive, std::vector<vec2>(4, vec2(0.5f)));
  for (const vec4& tangent : primitive.tangents) {
    EXPECT_NEAR(glm::length(vec3(tangent)), 1, 2 * 0x1p-24f);
    EXPECT_EQ(tangent.z, 0);
  }
}

TEST(TangentSpace, TakesTheOrientationOfTheNeighbourWhereThePictureHasNoArea) {
  Primitive primitive = square();
  primitive.uvs[0][3] = {0.5f, 0.5f};  // on the diagonal: the second triangle has no area
  make_tangents(primitive, std::vector(primitive.uvs[0]));
  EXPECT_EQ(primitive.positions.size(), 4u);
  for (const std::size_t v : {0u, 1u, 2u}) EXPECT_EQ(primitive.tangents[v], vec4(1, 0, 0, 1));
}

TEST(FlatNormals, GiveEveryTriangleItsOwnVertices) {
  Primitive primitive = square();
  primitive.normals.clear();
  primitive.positions[3].z = 1;
  make_flat_normals(primitive);
  ASSERT_EQ(primitive.normals.size(), 6u);
  EXPECT_EQ(primitive.uvs[0].size(), 6u);
  EXPECT_EQ(primitive.normals[0], vec3(0, 0, 1));
  // (1,1,0) x (0,1,1) = (1,-1,1)
  EXPECT_NEAR(glm::length(primitive.normals[3] - vec3(1, -1, 1) / std::sqrt(3.0f)), 0, 0x1p-23f);
}

}  // namespace
}  // namespace parity
