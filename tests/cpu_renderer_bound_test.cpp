#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cpu_reference/raster/renderer.h"

namespace parity {
namespace {

constexpr int size = 96;

/// Orthographic view of [-1, 1]^2 from z = 0 along -z, one light in the middle of it.
Scene empty_scene() {
  Scene scene;
  Camera camera;
  camera.orthographic = true;
  camera.near = 0.5;
  camera.far = 2.5;
  scene.cameras.push_back(camera);
  scene.lights.push_back(Light{});
  Node node;
  node.camera = 0;
  node.light = 0;
  scene.nodes.push_back(node);
  return scene;
}

void add(Scene& scene, Primitive primitive, const Material& material) {
  primitive.material = int(scene.materials.size());
  scene.materials.push_back(material);
  scene.meshes.push_back({"", {std::move(primitive)}});
  Node node;
  node.mesh = int(scene.meshes.size()) - 1;
  scene.nodes.push_back(node);
}

Primitive quad(float z, float half) {
  Primitive p;
  p.positions = {{-half, half, z}, {half, half, z}, {half, -half, z}, {-half, -half, z}};
  p.normals.assign(4, vec3(0, 0, 1));
  p.uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  p.indices = {0, 3, 1, 1, 3, 2};
  return p;
}

Material unlit(vec4 color) {
  Material m;
  m.unlit = true;
  m.base_color = color;
  return m;
}

cpu::Rendered render(const Scene& scene, bool bounds = true, int samples = 1,
                     bool half_color = true) {
  FrameOptions options;
  options.width = size;
  options.height = size;
  options.samples = samples;
  cpu::RenderOptions render_options;
  render_options.elements = true;
  render_options.bounds = bounds;
  render_options.device.half_color = half_color;
  return cpu::render(scene, make_frame(scene, options), render_options);
}

int ambiguous_count(const cpu::Rendered& r) {
  int count = 0;
  for (const std::uint8_t a : r.ambiguous) count += a != 0;
  return count;
}

/// Shiny, textured triangles inside of the view; `jitter` moves each vertex by up to so many pixels
/// along each axis.
Scene heap(double jitter, bool textured = true) {
  Scene scene = empty_scene();
  std::mt19937 shape(5), noise(9);
  std::uniform_real_distribution<float> anywhere(-0.9f, 0.9f);
  std::uniform_real_distribution<double> wobble(-jitter, jitter);
  std::uniform_int_distribution<int> code(0, 255);
  Grid<u8vec4> image{32, 32};
  for (u8vec4& texel : image) texel = u8vec4(code(shape), code(shape), code(shape), 255);
  scene.images.push_back(image);
  scene.textures.push_back({0, {}});
  Primitive p;
  p.uvs.emplace_back();
  for (std::uint32_t i = 0; i < 90; ++i) {
    const vec3 at{anywhere(shape), anywhere(shape), anywhere(shape) * 0.5f - 1.5f};
    const double pixel = 2.0 / size;
    p.positions.emplace_back(float(at.x + wobble(noise) * pixel),
                             float(at.y + wobble(noise) * pixel), at.z);
    p.normals.push_back(glm::normalize(vec3(anywhere(shape), anywhere(shape), 1.0f)));
    p.colors.emplace_back(vec3(std::abs(anywhere(shape))), 1.0f);
    p.uvs[0].emplace_back(anywhere(shape), anywhere(shape));
    p.indices.push_back(i);
  }
  Material m;
  m.double_sided = true;
  m.roughness = 0.4f;
  m.metallic = 0.5f;
  if (textured) m.base_color_texture.texture = m.metallic_roughness_texture.texture = 0;
  add(scene, p, m);
  return scene;
}

struct Judgement {
  int compared = 0;
  int outside = 0;
};

/// Pixels of the same element whose colour or depth leaves the bound of the first picture.
Judgement judge(const cpu::Rendered& want, const Picture& got) {
  Judgement j;
  for (std::size_t i = 0; i < want.picture.color.size(); ++i) {
    const std::uint32_t element = want.picture.element.values()[i];
    if (element == 0 || got.element.values()[i] != element || want.ambiguous.values()[i] != 0)
      continue;
    ++j.compared;
    const vec4 off = glm::abs(got.color.values()[i] - want.picture.color.values()[i]);
    const vec4 bound = want.color_bound.values()[i];
    const float depth_off = std::abs(got.depth.values()[i] - want.picture.depth.values()[i]);
    j.outside += glm::any(glm::greaterThan(off, bound)) || depth_off > want.depth_bound.values()[i];
  }
  return j;
}

TEST(CpuRendererBound, CoversVerticesThatMoveByHalfAStepOfTheGrid) {
  const Judgement j = judge(render(heap(0)), render(heap(0x1p-9), false).picture);
  EXPECT_GT(j.compared, size * size / 2);
  EXPECT_EQ(j.outside, 0);
}

TEST(CpuRendererBound, CoversMovedVerticesWithoutTheRoomThatTexturesLeave) {
  const Judgement j =
      judge(render(heap(0, false), true, 1, false), render(heap(0x1p-9, false), false).picture);
  EXPECT_GT(j.compared, size * size / 2);
  EXPECT_EQ(j.outside, 0);
}

TEST(CpuRendererBound, RejectsVerticesThatMoveByManySteps) {
  const Judgement j =
      judge(render(heap(0, false), true, 1, false), render(heap(0x1p-6, false), false).picture);
  EXPECT_GT(j.outside, j.compared / 4);
}

TEST(CpuRendererBound, LeavesThePictureAsItIs) {
  for (const int samples : {1, 4}) {
    const cpu::Rendered with = render(heap(0), true, samples);
    const cpu::Rendered without = render(heap(0), false, samples);
    EXPECT_EQ(with.picture.color, without.picture.color);
    EXPECT_EQ(with.picture.depth, without.picture.depth);
    EXPECT_TRUE(without.color_bound.empty());
  }
}

TEST(CpuRendererBound, OfAConstantColourIsTheRoundingOfItsStorage) {
  Scene scene = empty_scene();
  add(scene, quad(-1, 0.9f), unlit({0.75f, 0.5f, 0.25f, 1}));
  const cpu::Rendered r = render(scene);
  const vec4 bound = r.color_bound(size / 2, size / 3);
  // An ulp of half floats (either neighbour is right), and two products of the shading at 2^-24.
  EXPECT_NEAR(bound.x, 0.75 * 0x1p-10, 0.75 * 0x1p-22);
  EXPECT_EQ(ambiguous_count(r), 0);
}

TEST(CpuRendererBound, CallsCoplanarSurfacesAmbiguous) {
  Scene scene = empty_scene();
  add(scene, quad(-1, 0.5f), unlit(vec4(1)));
  EXPECT_EQ(ambiguous_count(render(scene)), 0);
  add(scene, quad(-1, 0.25f), unlit(vec4(1)));
  EXPECT_EQ(ambiguous_count(render(scene)), (size / 4) * (size / 4));
}

TEST(CpuRendererBound, ForgetsAmbiguityBehindANearerSurface) {
  Scene scene = empty_scene();
  add(scene, quad(-1, 0.5f), unlit(vec4(1)));
  add(scene, quad(-1, 0.25f), unlit(vec4(1)));
  add(scene, quad(-0.8f, 0.75f), unlit(vec4(1)));
  EXPECT_EQ(ambiguous_count(render(scene)), 0);
}

TEST(CpuRendererBound, CallsAnAlphaAtTheCutoffAmbiguous) {
  Scene scene = empty_scene();
  Material m = unlit({1, 1, 1, 0.5f});
  m.alpha_mode = AlphaMode::mask;
  m.alpha_cutoff = 0.5f;
  add(scene, quad(-1, 0.5f), m);
  EXPECT_EQ(ambiguous_count(render(scene)), (size / 2) * (size / 2));
  scene.materials[0].alpha_cutoff = 0.5001f;
  EXPECT_EQ(ambiguous_count(render(scene)), 0) << "clearly dropped";
  scene.materials[0].alpha_cutoff = 0.4999f;
  EXPECT_EQ(ambiguous_count(render(scene)), 0) << "clearly kept";
}

TEST(CpuRendererBound, CallsTheEdgeOfANearestTexelAmbiguous) {
  Scene scene = empty_scene();
  Grid<u8vec4> image{2, 1, u8vec4(255)};
  image(0, 0) = u8vec4(0, 0, 0, 255);
  scene.images.push_back(image);
  scene.textures.push_back(
      {0,
       {.wrap_u = Wrap::clamp_to_edge, .mag = Filter::nearest, .min = Filter::nearest, .mip = {}}});
  Material m = unlit(vec4(1));
  m.base_color_texture.texture = 0;
  Primitive p = quad(-1, 0.5f);
  const float half_pixel = 1.0f / size;
  for (vec3& v : p.positions) v.x += half_pixel;  // the middle is the centre of a column
  add(scene, p, m);
  const cpu::Rendered r = render(scene);
  for (int x = 0; x < size; ++x) EXPECT_EQ(r.ambiguous(x, size / 2), x == size / 2) << x;
}

TEST(CpuRendererBound, CallsTheBorderOfAClippedTriangleAmbiguousAndItsInsideNot) {
  Scene scene = empty_scene();
  Primitive p;
  // The long side is the diagonal through pixel centres; two corners lie outside of the view.
  p.positions = {{-3, -3, -1}, {3, 3, -1}, {-3, 3, -1}};
  p.normals.assign(3, vec3(0, 0, 1));
  p.indices = {0, 1, 2};
  add(scene, p, unlit(vec4(1)));
  const cpu::Rendered r = render(scene);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) EXPECT_EQ(r.ambiguous(x, y) != 0, x + y == size - 1);
}

TEST(CpuRendererBound, CallsTheBorderOfALineAmbiguous) {
  Scene scene = empty_scene();
  Primitive p;
  p.topology = Topology::lines;
  // Along the border between two rows: its sides pass through their pixels' centres.
  p.positions = {{-0.5f, 0, -1}, {0.5f, 0, -1}};
  p.indices = {0, 1};
  add(scene, p, unlit(vec4(1)));
  EXPECT_EQ(ambiguous_count(render(scene)), 2 * (size / 2));
  for (vec3& v : scene.meshes[0].primitives[0].positions) v.y = 1.0f / size;
  EXPECT_EQ(ambiguous_count(render(scene)), 0) << "through the centres of a row";
}

TEST(CpuRendererBound, CallsABlendedLayerAtTheDepthOfAnOpaqueOneAmbiguous) {
  Scene scene = empty_scene();
  add(scene, quad(-1, 0.5f), unlit(vec4(1)));
  Material glass = unlit({1, 1, 1, 0.5f});
  glass.alpha_mode = AlphaMode::blend;
  add(scene, quad(-1, 0.25f), glass);
  EXPECT_EQ(ambiguous_count(render(scene)), (size / 4) * (size / 4));
}

}  // namespace
}  // namespace parity
