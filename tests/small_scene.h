#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include "cpu_reference/raster/renderer.h"

/// What the tests of the reference renderer draw.
namespace parity {

constexpr double pi = std::numbers::pi;
/// A double stored as float: half an ulp.
constexpr double stored = 6e-8;

/// A scene seen by an orthographic camera at the origin that looks along -z at [-1, 1]^2.
struct SmallScene {
  Scene scene;

  SmallScene() {
    Camera camera;
    camera.orthographic = true;
    camera.near = 0.5;
    camera.far = 2.5;
    scene.cameras.push_back(camera);
    Node node;
    node.camera = 0;
    scene.nodes.push_back(node);
  }

  int add_material(const Material& material) {
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
  }

  void add(Primitive primitive, const dmat4& place = dmat4(1.0)) {
    scene.meshes.push_back({"", {std::move(primitive)}});
    Node node;
    node.mesh = int(scene.meshes.size()) - 1;
    node.parent_from_node = place;
    scene.nodes.push_back(node);
  }

  void add_light(const Light& light, const dmat4& place = dmat4(1.0)) {
    scene.lights.push_back(light);
    Node node;
    node.light = int(scene.lights.size()) - 1;
    node.parent_from_node = place;
    scene.nodes.push_back(node);
  }

  void add_texture(const Grid<u8vec4>& image, const Sampler& sampler) {
    scene.images.push_back(image);
    scene.textures.push_back({int(scene.images.size()) - 1, sampler});
  }

  Frame frame(int size = 8, int samples = 1, DepthMode depth = DepthMode::reverse_z) const {
    FrameOptions options;
    options.width = size;
    options.height = size;
    options.samples = samples;
    options.depth = depth;
    Frame f = make_frame(scene, options);
    if (scene.lights.empty()) {  // the default light is none of these tests' business
      f.lights.clear();
      f.ambient = vec3(0.0f);
    }
    return f;
  }

  Picture render(int size = 8, int samples = 1) const {
    cpu::RenderOptions options;
    options.elements = true;
    return cpu::render(scene, frame(size, samples), options).picture;
  }
};

//  0---1    counter-clockwise seen from +z; uv (0, 0) top left
//  | / |
//  3---2
inline Primitive quad(int material, float z = -1.0f, float half = 1.0f) {
  Primitive p;
  p.material = material;
  p.positions = {{-half, half, z}, {half, half, z}, {half, -half, z}, {-half, -half, z}};
  p.normals.assign(4, vec3(0, 0, 1));
  p.tangents.assign(4, vec4(1, 0, 0, 1));
  p.uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  p.indices = {0, 3, 1, 1, 3, 2};
  return p;
}

inline Material unlit(vec4 color) {
  Material m;
  m.unlit = true;
  m.base_color = color;
  return m;
}

/// Light that travels along -z, turned by `angle` around y.
inline dmat4 turned(double angle) { return glm::rotate(dmat4(1.0), angle, dvec3(0, 1, 0)); }

inline void expect_color(const vec4& got, const dvec4& want, double tolerance) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << "channel " << i;
}

}  // namespace parity
