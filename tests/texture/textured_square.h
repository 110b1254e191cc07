#pragma once

#include <cmath>

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

}  // namespace parity::texture_test
