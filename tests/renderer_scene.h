#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gpu/raster/renderer.h"
#include "tests/gpu_context.h"

/// What the tests of the device's renderer draw.
namespace parity {
// Some fifty roundings stand between the scene and a pixel; each is at most 2^-24 of the value.
constexpr double shading_tolerance = 50 * 0x1p-24;

/// The square [-size, size]^2 at depth z, facing +z; texture coordinate (0, 0) at its top left.
inline parity::Primitive square(float size, float z, int material = 0) {
  //  3---2
  //  | / |
  //  0---1
  parity::Primitive p;
  p.material = material;
  p.positions = {{-size, -size, z}, {size, -size, z}, {size, size, z}, {-size, size, z}};
  p.normals.assign(4, vec3(0, 0, 1));
  p.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

/// A scene seen from (0, 0, 5) along -z: at z = 0 the picture shows [-1, 1]^2.
struct TestScene {
  Scene scene;
  FrameOptions options;

  TestScene() {
    Camera camera;
    camera.vertical_fov = 2 * std::atan(0.2);
    camera.near = 1;
    camera.far = 100;
    scene.cameras = {camera};
    Node node;
    node.camera = 0;
    node.parent_from_node[3] = dvec4(0, 0, 5, 1);
    scene.nodes = {node};
    options.width = 33;
    options.height = 33;
  }

  Material& add_material() { return scene.materials.emplace_back(); }

  Material& add_unlit(const vec4& color) {
    Material& material = add_material();
    material.unlit = true;
    material.base_color = color;
    return material;
  }

  void add(const parity::Primitive& primitive, const dmat4& world_from_node = dmat4(1.0)) {
    Node node;
    node.mesh = int(scene.meshes.size());
    node.parent_from_node = world_from_node;
    scene.meshes.push_back({"", {primitive}});
    scene.nodes.push_back(node);
  }

  /// A light at `position` that shines along -z.
  void add_light(const Light& light, const dvec3& position = dvec3(0, 0, 5)) {
    Node node;
    node.light = int(scene.lights.size());
    node.parent_from_node[3] = dvec4(position, 1);
    scene.lights.push_back(light);
    scene.nodes.push_back(node);
  }

  int add_texture(const Grid<u8vec4>& image, const Sampler& sampler) {
    scene.images.push_back(image);
    scene.textures.push_back({int(scene.images.size()) - 1, sampler});
    return int(scene.textures.size()) - 1;
  }

  Frame frame() const { return make_frame(scene, options); }

  Picture render(gpu::RenderOptions render_options = {.elements = false,
                                                      .full_float = true}) const {
    return gpu::render(test_context(), scene, frame(), render_options);
  }
};

inline Light directional(float intensity) {
  Light light;
  light.kind = LightKind::directional;
  light.intensity = intensity;
  return light;
}

inline Sampler nearest() {
  return {.wrap_u = Wrap::clamp_to_edge,
          .wrap_v = Wrap::clamp_to_edge,
          .mag = Filter::nearest,
          .min = Filter::nearest,
          .mip = std::nullopt};
}

inline void expect_near(const vec4& got, const vec4& want, double tolerance) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << "component " << i;
}

inline vec4 middle(const Picture& picture) {
  return picture.color(picture.color.width() / 2, picture.color.height() / 2);
}

/// Radiance of a dielectric seen and lit along its normal by irradiance 1. All cosines are 1, so
/// F = 0.04, D = 1 / (pi alpha^2), V = 1/4.
inline double head_on(double base, double roughness) {
  const double alpha = roughness * roughness;
  return 0.96 * base / std::numbers::pi + 0.04 * 0.25 / (std::numbers::pi * alpha * alpha);
}

class GpuRenderer : public testing::Test {
 protected:
  void SetUp() override {
    if (!gpu::can_render(test_context().info()))
      GTEST_SKIP() << "skipped: the device cannot render";
  }
};

/// Everything at once: textures, a normal map, colours, a mask, blending, a turned and a mirrored
/// square, all parallel, so that nothing pierces anything.
inline TestScene everything() {
  TestScene stage;
  Grid<u8vec4> image(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) image(x, y) = u8vec4(100 + 15 * x, 120 + 10 * y, 250, 20 * (x + y));
  const int texture = stage.add_texture(image, Sampler{});
  for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend}) {
    Material& material = stage.add_material();
    material.alpha_mode = mode;
    material.alpha_cutoff = 0.3f;
    material.roughness = 0.6f;
    material.double_sided = true;
    material.base_color_texture.texture = texture;
    material.normal_texture.texture = texture;
    material.metallic_roughness_texture.texture = texture;
    parity::Primitive primitive = square(1.5f, 0, int(mode));
    primitive.tangents.assign(4, vec4(1, 0, 0, 1));
    primitive.colors = {vec4(1), vec4(0.5f, 1, 1, 1), vec4(1, 0.5f, 1, 1), vec4(0.5f)};
    for (int copy = 0; copy < 2; ++copy) {
      dmat4 place = glm::mat4_cast(dquat(std::cos(0.1), 0, std::sin(0.1), 0));
      if (copy == 1) place[0] = -place[0];
      place[3] = dvec4(0, 0, 0.3 * int(mode) - 0.1 * copy, 1);
      stage.add(primitive, place);
    }
  }
  stage.add_light(directional(1));
  Light lamp;
  lamp.intensity = 10;
  stage.add_light(lamp, dvec3(1, 1, 2));
  return stage;
}

}  // namespace parity
