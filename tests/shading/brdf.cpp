#include "gpu/shading/brdf.h"

#include "cpu_reference/shading/brdf.h"
#include "tests/shading/queries.h"
#include "tests/stage.h"

namespace parity {
namespace {

using namespace shading_test;

BrdfQuery random_directions(Random& random, std::uint32_t model) {
  BrdfQuery q{};
  q.to_light = upward(random);
  q.to_eye = upward(random);
  q.color = vec3(random.uniform(), random.uniform(), random.uniform());
  q.alpha = vec2(0.5f);
  q.model = model;
  return q;
}

BrdfProblem random_highlights(const Setting& setting) {
  Random random{setting.seed};
  BrdfProblem p{{}, albedo_table()};
  for (int i = 0; i < setting.count("count"); ++i) {
    BrdfQuery q = random_directions(random, std::uint32_t(setting.count("model")));
    q.exponent = float(setting.at("exponent"));
    p.queries.push_back(q);
  }
  return p;
}

BrdfProblem random_microfacets(const Setting& setting) {
  Random random{setting.seed};
  BrdfProblem p{{}, albedo_table()};
  const double alpha = std::pow(setting.at("roughness"), 2);
  double stretch = setting.at("anisotropy");
  for (int i = 0; i < setting.count("count"); ++i) {
    BrdfQuery q = random_directions(random, brdf_ggx + std::uint32_t(setting.count("model")));
    q.fresnel = std::uint32_t(setting.count("fresnel"));
    if (setting.count("mixed") != 0) {
      q.model = brdf_ggx + random.below(3);
      q.fresnel = random.below(3);
      stretch = random.uniform();
    }
    q.alpha = vec2(dvec2(alpha, alpha));
    if (q.model != brdf_ggx_multi_scatter) q.alpha.x = float(glm::mix(alpha, 1.0, stretch));
    if (q.model == brdf_ggx_multi_scatter) q.fresnel = fresnel_schlick;
    if (q.fresnel != fresnel_schlick) q.color = vec3(1.0f) + 2.0f * q.color;
    if (q.fresnel == fresnel_conductor) {
      q.color = q.color - 0.9f;
      q.absorption = vec3(1.0f) + 4.0f * (vec3(0.5f) + random.in_box(0.5f));
    }
    p.queries.push_back(q);
  }
  return p;
}

BrdfProblem random_sheens(const Setting& setting) {
  Random random{setting.seed};
  BrdfProblem p{{}, albedo_table()};
  for (int i = 0; i < setting.count("count"); ++i) {
    BrdfQuery q = random_directions(random, brdf_sheen);
    q.alpha = vec2(float(std::pow(setting.at("roughness"), 2)));
    p.queries.push_back(q);
  }
  return p;
}

Axis count_axis() {
  return {.name = "count",
          .low = 1,
          .high = 4099,
          .standard = 1031,
          .logarithmic = true,
          .whole = true};
}

std::vector<CpuMethod<BrdfProblem, std::vector<dvec3>>> on_the_host() {
  return {{.solve = [](const BrdfProblem& p) { return cpu::brdf(p.queries, p.albedo); }}};
}

std::vector<GpuMethod<BrdfProblem, std::vector<dvec3>>> on_the_device() {
  return {{.solve = [](gpu::Context& context, const BrdfProblem& p) {
    const std::vector<vec3> values = gpu::brdf(context, p.queries, p.albedo);
    return std::vector<dvec3>(values.begin(), values.end());
  }}};
}

const char* const why =
    "in units of each value's own bound, counted over its operations with the errors that Vulkan "
    "allows them (tests/shading/queries.h)";

const Registration phong = register_stage<BrdfProblem, std::vector<dvec3>>({
    .name = "shading/blinn_phong",
    .title = "Lambert, Phong, Blinn-Phong, and the latter two with energy-preserving factors",
    .source = "notes 6.1; Phong 1975; Blinn 1977; Lewis 1994",
    .rows = {102},
    .axes = {count_axis(),
             {.name = "model",
              .low = brdf_lambert,
              .high = brdf_blinn_phong_normalized,
              .standard = brdf_blinn_phong,
              .whole = true,
              .each = true},
             {.name = "exponent", .low = 1, .high = 1000, .standard = 32, .logarithmic = true}},
    .problem = random_highlights,
    .cpu = on_the_host(),
    .gpu = on_the_device(),
    .distance = brdf_distance,
    .tolerance = 1.0,
    .why = why,
});

const Registration microfacets = register_stage<BrdfProblem, std::vector<dvec3>>({
    .name = "shading/cook_torrance",
    .title =
        "GGX, Beckmann, GGX with multiple scattering; Schlick, dielectric, conductor; stretched",
    .source = "notes 6.2; Cook & Torrance 1982; Walter et al. 2007; Heitz 2014; Kulla & Conty 2017",
    .rows = {105, 106, 107, 109},
    .axes = {count_axis(),
             {.name = "model", .low = 0, .high = 2, .standard = 0, .whole = true, .each = true},
             {.name = "fresnel", .low = 0, .high = 2, .standard = 0, .whole = true, .each = true},
             {.name = "roughness", .low = 0.045, .high = 1, .standard = 0.4},
             {.name = "anisotropy", .low = 0, .high = 1, .standard = 0},
             {.name = "mixed", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true}},
    .problem = random_microfacets,
    .cpu = on_the_host(),
    .gpu = on_the_device(),
    .distance = brdf_distance,
    .tolerance = 1.0,
    .why = why,
});

const Registration cloth = register_stage<BrdfProblem, std::vector<dvec3>>({
    .name = "shading/sheen",
    .title = "Cloth: Charlie's distribution of fibres",
    .source = "Estevez & Kulla 2017; Neubelt & Pettineo 2013; glTF 2.0, KHR_materials_sheen",
    .axes = {count_axis(), {.name = "roughness", .low = 0.2, .high = 1, .standard = 0.5}},
    .problem = random_sheens,
    .cpu = on_the_host(),
    .gpu = on_the_device(),
    .distance = brdf_distance,
    .tolerance = 1.0,
    .why = why,
});

}  // namespace
}  // namespace parity
