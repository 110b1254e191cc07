#include "cpu_reference/raster/renderer.h"

#include <glm/gtc/matrix_transform.hpp>

#include "geometry/random.h"
#include "gpu/raster/renderer.h"
#include "tests/raster/agreement.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct RenderProblem {
  std::uint32_t seed = 1;
  int side = 0;
  int samples = 1;
  int objects = 0;
  DepthMode depth = DepthMode::reverse_z;
};
auto fields_of(const RenderProblem*) {
  return std::tuple{&RenderProblem::seed, &RenderProblem::side, &RenderProblem::samples,
                    &RenderProblem::objects, &RenderProblem::depth};
}

Grid<u8vec4> random_texels(Random& random, int width, int height) {
  Grid<u8vec4> image{width, height};
  for (u8vec4& t : image)
    t = u8vec4(random.below(256), random.below(256), random.below(256), 128 + random.below(128));
  return image;
}

/// A curved sheet of `cells` x `cells` quads around the origin.
Primitive sheet(Random& random, int cells) {
  Primitive p;
  const vec3 bend = random.in_box(0.5f);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const vec2 s = vec2(i, j) / float(cells) * 2.0f - 1.0f;
      p.positions.push_back(
          {s.x, s.y, bend.x * s.x * s.x + bend.y * s.y * s.y + bend.z * s.x * s.y});
      p.normals.push_back(glm::normalize(
          vec3(-2 * bend.x * s.x - bend.z * s.y, -2 * bend.y * s.y - bend.z * s.x, 1)));
      p.tangents.push_back(vec4(glm::normalize(vec3(1, 0, 2 * bend.x * s.x + bend.z * s.y)), 1));
      p.colors.push_back({random.uniform(), random.uniform(), random.uniform(), 1});
    }
  p.uvs.resize(1);
  for (const vec3& v : p.positions) p.uvs[0].push_back(1.5f * vec2(v.x, -v.y));
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const auto a = std::uint32_t(j * (cells + 1) + i);
      const auto above = a + std::uint32_t(cells) + 1;
      for (const std::uint32_t v : {a, a + 1, above + 1, a, above + 1, above})
        p.indices.push_back(v);
    }
  return p;
}

/// Sheets of random materials in random places under the three kinds of light: textures with all
/// filters, normal maps, masks, blending, mirrored and double-sided ones.
Scene random_scene(const RenderProblem& problem) {
  Random random{problem.seed};
  Scene scene;
  scene.images = {random_texels(random, 16, 16), random_texels(random, 13, 7)};
  for (int i = 0; i < 6; ++i) {
    Sampler sampler{Wrap(i % 3),
                    Wrap((i + 1) % 3),
                    i % 2 ? Filter::linear : Filter::nearest,
                    Filter::linear,
                    {}};
    if (i != 3) sampler.mip = i % 2 ? Filter::linear : Filter::nearest;
    if (i == 1) sampler.max_anisotropy = 8;
    scene.textures.push_back({i % 2, sampler});
  }
  for (int i = 0; i < problem.objects; ++i) {
    Material m;
    m.base_color = vec4(random.in_box(0.5f) + 0.5f, random.uniform(0.3f, 1.0f));
    m.metallic = random.uniform();
    m.roughness = random.uniform(0.2f, 1.0f);
    m.emission = i % 4 ? vec3(0) : vec3(0.1f);
    m.alpha_mode = i % 5 == 3 ? AlphaMode::mask : i % 5 == 4 ? AlphaMode::blend : AlphaMode::opaque;
    m.double_sided = i % 2;
    m.unlit = i % 7 == 6;
    if (i % 3) m.base_color_texture.texture = i % 6;
    if (i % 4 == 1) m.normal_texture.texture = 5;
    if (i % 4 == 2) m.metallic_roughness_texture.texture = 1;
    scene.materials.push_back(m);
    Primitive p = sheet(random, 6);
    p.material = i;
    scene.meshes.push_back({"sheet", {p}});
    Node node;
    node.mesh = i;
    const dmat4 turn{glm::mat4_cast(dquat(random.rotation()))};
    node.parent_from_node = turn;
    node.parent_from_node[3] = dvec4(1.5 * dvec3(random.in_box(1.0f)), 1);
    if (i % 6 == 5) node.parent_from_node[0] *= -1.0;
    scene.nodes.push_back(node);
  }
  const auto add_light = [&](LightKind kind, float intensity, float range) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    light.range = range;
    scene.lights.push_back(light);
    Node node;
    node.light = int(scene.lights.size()) - 1;
    node.parent_from_node = glm::translate(dmat4(1.0), dvec3(random.in_box(1.0f)) + dvec3(0, 0, 5));
    scene.nodes.push_back(node);
  };
  add_light(LightKind::directional, 2, std::numeric_limits<float>::infinity());
  add_light(LightKind::point, 20, 12);
  add_light(LightKind::spot, 40, std::numeric_limits<float>::infinity());
  return scene;
}

Frame frame_of(const Scene& scene, const RenderProblem& p) {
  return make_frame(scene,
                    {.width = p.side, .height = p.side, .samples = p.samples, .depth = p.depth});
}

/// Pixels by cause, and how far the worst colour is: all that a picture says against the reference.
using Verdict = std::vector<double>;

const Registration registration = register_stage<RenderProblem, Verdict>({
    .name = "raster/renderer",
    .title = "A whole picture: transform, clip, rasterise, depth, textures, metallic-roughness "
             "shading, blend, resolve",
    .source = "notes 1, 2, 6.1-6.3; glTF 2.0, 3.9 and appendix B; Vulkan 1.3",
    .rows = {1, 12, 13, 19, 30},
    .axes = {{.name = "side",
              .unit = "px",
              .low = 1,
              .high = 131,
              .standard = 96,
              .logarithmic = true,
              .whole = true},
             {.name = "samples",
              .low = 1,
              .high = 8,
              .standard = 4,
              .logarithmic = true,
              .whole = true,
              .each = true},
             {.name = "objects", .low = 0, .high = 24, .standard = 12, .whole = true},
             {.name = "depth_mode", .low = 0, .high = 2, .standard = 1, .whole = true}},
    .problem =
        [](const Setting& s) {
          return RenderProblem{std::uint32_t(s.seed), s.count("side"),
                               1 << int(std::lround(std::log2(s.at("samples")))),
                               s.count("objects"), DepthMode(s.count("depth_mode"))};
        },
    .cpu = {{.solve =
                 [](const RenderProblem&) {
                   return Verdict{0, 0, 0};
                 }}},
    .gpu = {{.name = "reference",
             .solve = [](gpu::Context& context, const RenderProblem& p) -> Measured<Verdict> {
               if (!gpu::can_render(context.info())) throw Unsupported("the device cannot render");
               const Scene scene = random_scene(p);
               const raster_test::Agreement a =
                   raster_test::draw_and_compare(context, scene, frame_of(scene, p));
               return Verdict{double(a.coverage), double(a.depth), double(a.color)};
             }}},
    .distance = [](const Verdict& got, const Verdict&) { return got[0] + got[1] + got[2]; },
    .tolerance = 0.0,
    .why = "pixels whose coverage, depth or colour is outside of what the reference derives for "
           "each: varyings moved "
           "by snapping and by float planes, pushed through the shading; pixels where a decision "
           "(depth order, alpha "
           "test, nearest texel) is within its own error are not judged",
});

}  // namespace
}  // namespace parity
