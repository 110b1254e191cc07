#include "cpu_reference/shading/albedo_table.h"
#include "gpu/shading/brdf.h"
#include "tests/chart.h"
#include "tests/shading/energy.h"

namespace parity {
namespace {

using namespace shading_test;

Brdf on_device(gpu::Context& context) {
  return [&context](const std::vector<BrdfQuery>& q) {
    const std::vector<vec3> values = gpu::brdf(context, q, albedo_table());
    return std::vector<dvec3>(values.begin(), values.end());
  };
}

double returned_at(const Brdf& brdf, std::uint32_t model, double roughness, double cosine) {
  const BrdfQuery q = microfacet_query(model, roughness, toward(1), toward(cosine));
  return returned(brdf, q, double(q.alpha.x), 192);  // 96 are off by 0.005 where alpha = cosine
}

ChartData furnace(gpu::Context& context) {
  const Brdf brdf = on_device(context);
  ChartData data;
  double worst = 0;
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const std::string at = ", n.v " + short_number(cosine);
    Series single{"one bounce" + at, {}}, all{"all bounces" + at, {}};
    for (double roughness = 0.05; roughness < 1.01; roughness += 0.05) {
      single.points.push_back({roughness, returned_at(brdf, brdf_ggx, roughness, cosine)});
      all.points.push_back(
          {roughness, returned_at(brdf, brdf_ggx_multi_scatter, roughness, cosine)});
      worst = std::max(worst, std::abs(all.points.back().y - 1));
    }
    data.series.push_back(single);
    data.series.push_back(all);
  }
  data.series.push_back(
      {"1 - ln 2", {{0.05, 1 - std::log(2.0)}, {1.0, 1 - std::log(2.0)}}, Series::Kind::theory});
  data.assertions = {{"largest |returned - 1| with all bounces", worst, 0.01},
                     {"|one bounce at roughness 1, n.v 1 - (1 - ln 2)|",
                      std::abs(data.series[0].points.back().y - (1 - std::log(2.0))), 1e-3}};
  return data;
}

const Registration chart = register_chart({
    .name = "shading/white_furnace",
    .title = "White GGX in a white furnace: the part of light that comes back",
    .x = {.label = "roughness", .unit = "1", .logarithmic = false},
    .y = {.label = "returned", .unit = "1", .logarithmic = false},
    .produce = furnace,
});

Map loss_map(const char* name, const char* title, std::function<double(double, double)> loss) {
  return {.name = name,
          .title = title,
          .x = {.name = "roughness", .low = 0.05, .high = 1, .standard = 0.5},
          .y = {.name = "n.v", .low = 0.02, .high = 1, .standard = 0.5},
          .value_label = "energy error",
          .border = 0.01,
          .columns = 20,
          .rows = 16,
          .value = [loss](gpu::Context&, double roughness, double cosine) {
            return std::max(1e-5, loss(roughness, cosine));
          }};
}

const Registration single_map = register_map(
    loss_map("shading/energy_loss", "Light that one bounce of GGX loses",
             [](double r, double c) { return 1 - cpu::directional_albedo(r * r, c, 96).total(); }));

const Registration compensated_map = register_map(loss_map(
    "shading/energy_error", "|returned - 1| of GGX with all bounces", [](double r, double c) {
      return std::abs(returned_at(on_cpu(), brdf_ggx_multi_scatter, r, c) - 1);
    }));

}  // namespace
}  // namespace parity
