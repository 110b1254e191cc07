#include "cpu_reference/raster/painter.h"

#include "geometry/random.h"
#include "gpu/raster/painter.h"
#include "tests/stage.h"

namespace parity {
namespace {

std::vector<float> random_keys(const Setting& setting) {
  Random random{setting.seed};
  const auto distinct = std::uint32_t(setting.count("distinct"));
  std::vector<float> keys(std::size_t(setting.count("count")));
  for (float& key : keys) key = (float(random.below(distinct)) - float(distinct / 2)) * 0.37f;
  return keys;
}

const Registration registration = register_stage<std::vector<float>, std::vector<std::uint32_t>>({
    .name = "raster/painter",
    .title = "The order from far to near, equal keys in the order given",
    .source = "notes 1.7",
    .rows = {15},
    .axes = {{.name = "count", .low = 0, .high = 70001, .standard = 4099, .whole = true},
             {.name = "distinct",
              .low = 1,
              .high = 1e6,
              .standard = 1000,
              .logarithmic = true,
              .whole = true}},
    .problem = random_keys,
    .cpu = {{.solve = [](const std::vector<float>& keys) { return cpu::painter_order(keys); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<float>& keys) {
                   return gpu::painter_order(context, keys);
                 }}},
    .distance =
        [](const std::vector<std::uint32_t>& got, const std::vector<std::uint32_t>& want) {
          double wrong = 0;
          for (std::size_t i = 0; i < want.size(); ++i) wrong += got[i] != want[i];
          return wrong;
        },
    .tolerance = 0.0,
    .why = "places that differ: a stable sort has one answer",
    .chart_axes = {"count"},
});

}  // namespace
}  // namespace parity
