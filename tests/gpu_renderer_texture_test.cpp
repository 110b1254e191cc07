#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/shading/prefilter.h"
#include "tests/renderer_scene.h"

namespace parity {
namespace {

TEST_F(GpuRenderer, NearestTexelsAreDecodedFromSrgbExactly) {
  TestScene stage;
  Grid<u8vec4> image(3, 3, u8vec4(0, 0, 0, 255));
  image(0, 0) = u8vec4(255, 10, 188, 255);  // top left
  image(2, 1) = u8vec4(128, 64, 32, 255);
  const int texture = stage.add_texture(image, nearest());
  stage.add_unlit(vec4(1)).base_color_texture.texture = texture;
  stage.add(square(1, 0));
  const Picture picture = stage.render();
  const auto decode = [](double code) {
    const double c = code / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  expect_near(picture.color(4, 4), vec4(1, decode(10), decode(188), 1), 0x1p-24);
  expect_near(picture.color(28, 16), vec4(decode(128), decode(64), decode(32), 1), 0x1p-24);
  expect_near(picture.color(16, 28), vec4(0, 0, 0, 1), 0);
}

/// Two texels, black and white, over a square that is 33 pixels wide; alpha stays linear.
TestScene ramp(Wrap wrap) {
  TestScene stage;
  Grid<u8vec4> image(2, 1, u8vec4(255, 255, 255, 0));
  image(1, 0).w = 255;
  Sampler sampler = nearest();
  sampler.mag = sampler.min = Filter::linear;
  sampler.wrap_u = wrap;
  const int texture = stage.add_texture(image, sampler);
  Material& material = stage.add_unlit(vec4(1));
  material.base_color_texture.texture = texture;
  material.alpha_mode = AlphaMode::blend;
  stage.add(square(1, 0));
  return stage;
}

TEST_F(GpuRenderer, LinearFilteringIsARampBetweenTexelCentres) {
  const std::array<Wrap, 3> wraps{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
  for (const Wrap wrap : wraps) {
    const Picture picture = ramp(wrap).render();
    for (int x = 0; x < 33; ++x) {
      const double u = (x + 0.5) / 33;
      const double t = 2 * u - 0.5;  // 0 at the centre of the first texel, 1 at that of the second
      const double outside = wrap == Wrap::repeat ? (t < 0 ? -t : 2 - t) : (t < 0 ? 0 : 1);
      const double want = t < 0 || t > 1 ? outside : t;
      EXPECT_NEAR(picture.color(x, 16).w, want, 16 * 0x1p-24) << "x " << x;
    }
  }
}

TEST_F(GpuRenderer, TextureCoordinatesBelowZeroAndAboveOneWrap) {
  for (const Wrap wrap :
       {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge, Wrap::mirror_clamp_to_edge}) {
    TestScene stage;
    Grid<u8vec4> image(2, 1, u8vec4(0, 0, 0, 255));
    image(1, 0) = u8vec4(255);
    Sampler sampler = nearest();
    sampler.wrap_u = wrap;
    const int texture = stage.add_texture(image, sampler);
    stage.add_unlit(vec4(1)).base_color_texture.texture = texture;
    parity::Primitive primitive = square(1, 0);
    for (vec2& uv : primitive.uvs[0]) uv.x = 6 * uv.x - 3;
    stage.add(primitive);
    stage.options.width = stage.options.height = 36;  // six pixels to a period, three to a texel
    const Picture picture = stage.render();
    const std::array<const char*, 5> want{"010101010101", "100110011001", "000000011111", "",
                                          "111110011111"};
    for (int texel = 0; texel < 12; ++texel)
      EXPECT_EQ(picture.color(3 * texel + 1, 16).x, float(want[std::size_t(wrap)][texel] - '0'))
          << "wrap " << int(wrap) << " texel " << texel;
  }
}

TEST_F(GpuRenderer, MipLevelsFollowTheFootprint) {
  // 64 texels over 16 pixels are two levels up exactly. There checks of 4 texels are checks of one
  // pixel, seen at their centres; one level further up all is grey.
  TestScene stage;
  Grid<u8vec4> image(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) image(x, y) = u8vec4(255, 255, 255, (x / 4 + y / 4) % 2 * 255);
  Sampler sampler;
  sampler.mip = Filter::nearest;
  const int texture = stage.add_texture(image, sampler);
  Material& material = stage.add_unlit(vec4(1));
  material.base_color_texture.texture = texture;
  material.alpha_mode = AlphaMode::blend;
  stage.add(square(1, 0));
  stage.options.width = stage.options.height = 16;
  // A texture coordinate is a few roundings off, 16 texels long.
  const double tolerance = 16 * 8 * 0x1p-24;
  Picture picture = stage.render();
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(picture.color(x, y).w, (x + y) % 2, tolerance);
  stage.options.width = stage.options.height = 8;
  picture = stage.render();
  for (const vec4& pixel : picture.color) EXPECT_NEAR(pixel.w, 0.5, 1.0 / 255);
  stage.scene.textures[0].sampler.min = Filter::nearest;
  stage.scene.textures[0].sampler.mip = std::nullopt;
  picture = stage.render();
  for (const vec4& pixel : picture.color) EXPECT_TRUE(pixel.w == 0 || pixel.w == 1);
}

TEST_F(GpuRenderer, ATextureTransformMovesTheTexture) {
  TestScene stage;
  Grid<u8vec4> image(2, 2, u8vec4(0, 0, 0, 255));
  image(1, 0) = u8vec4(255);
  Sampler sampler = nearest();
  sampler.wrap_u = Wrap::repeat;
  const int texture = stage.add_texture(image, sampler);
  TextureUse& use = stage.add_unlit(vec4(1)).base_color_texture;
  use.texture = texture;
  use.texture_from_uv[2] = vec3(0.5f, 0, 1);  // (u + 1/2, v): the white texel moves left
  stage.add(square(1, 0));
  const Picture picture = stage.render();
  EXPECT_EQ(picture.color(8, 8).x, 1.0f);
  EXPECT_EQ(picture.color(24, 8).x, 0.0f);
  EXPECT_EQ(picture.color(8, 24).x, 0.0f);
}

TEST_F(GpuRenderer, ANormalMapActsAsTiltedNormals) {
  // The map's normal, all directions different, against vertices with that normal.
  const u8vec4 texel(190, 180, 220, 255);
  const vec3 n = 2.0f * vec3(texel) / 255.0f - 1.0f;
  for (const double sign : {1.0, -1.0}) {
    TestScene mapped;
    TestScene tilted;
    for (TestScene* stage : {&mapped, &tilted}) {
      Material& material = stage->add_material();
      material.roughness = 0.6f;
      material.base_color = vec4(0.9f, 0.6f, 0.3f, 1);
      Light lamp;
      lamp.intensity = 30;
      stage->add_light(lamp, dvec3(0.5, 1.5, 3));
    }
    const int texture = mapped.add_texture(Grid<u8vec4>(1, 1, texel), nearest());
    mapped.scene.materials[0].normal_texture.texture = texture;
    dmat4 place(1.0);
    place[0][0] = 3 * sign;  // scaled, and mirrored
    place[1][1] = place[2][2] = 3;
    parity::Primitive primitive = square(2, 0);
    primitive.tangents.assign(4, vec4(1, 0, 0, 1));
    mapped.add(primitive, place);
    primitive.tangents.clear();
    primitive.normals.assign(4, glm::normalize(vec3(float(sign) * n.x, n.y, n.z)));
    tilted.add(primitive);
    expect_near(middle(mapped.render()), middle(tilted.render()), 2 * shading_tolerance);
  }
}

/// Clear coat, sheen, brushed metal, a film, tinted dielectric and glass: one to a material.
void add_extensions(Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Material& m = scene.materials[i];
    m.metallic = 0.5f;
    if (i == 0) {
      m.clearcoat.factor = 0.7f;
      m.clearcoat.roughness = 0.2f;
      m.sheen.color = vec3(0.3f, 0.2f, 0.1f);
    }
    if (i == 1) {
      m.anisotropy.strength = 0.6f;
      m.anisotropy.rotation = 0.4f;
      m.iridescence.factor = 1;
    }
    if (i == 2) {
      m.specular.color = vec3(1, 0.5f, 0.2f);
      m.transmission.factor = 0.5f;
    }
  }
}

// Shaders differ in what is left out of them, and round the rest alike.
TEST_F(GpuRenderer, WhatTheSceneLacksChangesNothingWhenItIsLeftOut) {
  for (int lacking = 0; lacking < 7; ++lacking) {
    TestScene stage = everything();
    for (Material& m : stage.scene.materials) {
      if (lacking >= 1) m.normal_texture = {};
      if (lacking >= 2) m.metallic_roughness_texture = {};
      if (lacking >= 3) m.base_color_texture = {};
      if (lacking >= 4) m.alpha_mode = AlphaMode::opaque;
      if (lacking == 6) m.unlit = true;
    }
    if (lacking >= 3)
      for (SceneMesh& mesh : stage.scene.meshes) mesh.primitives[0].colors.clear();
    if (lacking >= 5) {
      stage.scene.nodes.pop_back();  // the lamp
      stage.scene.lights.pop_back();
    }
    stage.options.samples = lacking % 2 == 0 ? 1 : 4;
    SCOPED_TRACE(std::to_string(lacking) + " things less");
    const Picture lean = stage.render();
    const Picture general = stage.render({.general = true, .full_float = true});
    EXPECT_NE(middle(lean), vec4(0));
    EXPECT_EQ(lean.depth.values(), general.depth.values());
    EXPECT_EQ(lean.color.values(), general.color.values());
  }
}

TEST_F(GpuRenderer, MaterialsWithAndWithoutExtensionsAreAsTheGeneralShadersShowThem) {
  Grid<vec4> sky{16, 8};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) sky(x, y) = vec4(0.1f * float(x), 0.2f * float(8 - y), 1, 1);
  TestScene stage = everything();
  add_extensions(stage.scene);
  stage.scene.materials[1] = Material{};
  Frame frame = stage.frame();
  frame.environment = gpu::prefilter(test_context(), environment_map(sky, 32), 16);
  const Picture lean = gpu::render(test_context(), stage.scene, frame, {.full_float = true});
  const Picture general =
      gpu::render(test_context(), stage.scene, frame, {.general = true, .full_float = true});
  EXPECT_NE(middle(lean), vec4(0));
  EXPECT_EQ(lean.color.values(), general.color.values());
}

}  // namespace
}  // namespace parity
