#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/random.h"
#include "geometry/scene.h"

namespace parity::texture_test {

/// A square of 2 m with independent texels, unlit, at a depth; seen from (0, 0, 5) along -z, so
/// that a picture shows 2 m at z = 0. The second node places it.
inline Scene textured_square(int side, double depth, const Sampler& sampler) {
  Scene scene;
  Camera camera;
  camera.vertical_fov = 2 * std::atan(0.2);
  camera.near = 0.01;
  camera.far = 2000;
  scene.cameras = {camera};
  scene.nodes.resize(2);
  scene.nodes[0].camera = 0;
  scene.nodes[0].parent_from_node[3] = dvec4(0, 0, 5, 1);
  scene.nodes[1].mesh = 0;
  Random random{5};
  Grid<u8vec4> image(side, side);
  for (u8vec4& texel : image)
    texel = u8vec4(random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255), 255);
  scene.images = {image};
  scene.textures = {{0, sampler}};
  Material material;
  material.unlit = true;
  material.double_sided = true;
  material.base_color_texture.texture = 0;
  scene.materials = {material};
  Primitive square;
  const float z = float(depth);
  square.material = 0;
  square.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  square.normals.assign(4, vec3(0, 0, 1));
  square.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  square.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {{"", {square}}};
  return scene;
}

/// The same with a ball of 0.9 m, 48 x 96 faces, one texture around it.
inline Scene textured_ball(int side) {
  Scene scene = textured_square(side, 0, {.max_anisotropy = default_max_anisotropy});
  scene.materials[0].double_sided = false;
  Primitive ball;
  ball.material = 0;
  ball.uvs.resize(1);
  constexpr int rows = 48, columns = 96;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double polar = std::numbers::pi * i / rows;
      const double around = 2 * std::numbers::pi * j / columns;
      const vec3 n(std::sin(polar) * std::sin(around), std::cos(polar),
                   std::sin(polar) * std::cos(around));
      ball.positions.push_back(0.9f * n);
      ball.normals.push_back(n);
      ball.uvs[0].emplace_back(float(j) / columns, float(i) / rows);
    }
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = i * (columns + 1) + j, b = a + columns + 1;
      for (const std::uint32_t v : {a, b, b + 1, a, b + 1, a + 1}) ball.indices.push_back(v);
    }
  scene.meshes = {{"", {ball}}};
  return scene;
}

}  // namespace parity::texture_test
