#include "gpu/raster/encode_srgb.h"

#include "cpu_reference/raster/srgb.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct Linear {
  Grid<vec4> picture;
  float exposure = 0;
};
auto fields_of(const Linear*) { return std::tuple{&Linear::picture, &Linear::exposure}; }

Linear random_picture(const Setting& setting) {
  Random random{setting.seed};
  Linear p{Grid<vec4>{setting.count("side"), 33}, float(setting.at("exposure"))};
  const float gain = std::exp2(-p.exposure);
  for (vec4& c : p.picture)
    c = vec4(random.uniform(-0.1f, 1.1f), random.uniform(0.0f, 0.01f), random.uniform(), 0) * gain +
        vec4(0, 0, 0, random.uniform());
  return p;
}

/// How far a code is from the value before rounding, in codes.
double error(const Linear& p, const Grid<u8vec4>& answer) {
  double worst = 0;
  for (std::size_t i = 0; i < answer.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      const double v = p.picture.values()[i][k];
      const double exposed = std::clamp(k < 3 ? v * std::exp2(double(p.exposure)) : v, 0.0, 1.0);
      const double exact = 255 * (k < 3 ? cpu::srgb_from_linear(exposed) : exposed);
      worst = std::max(worst, std::abs(double(answer.values()[i][k]) - exact));
    }
  return worst;
}

const Registration registration = register_stage<Linear, Grid<u8vec4>>({
    .name = "raster/encode_srgb",
    .title = "Linear light to 8-bit sRGB",
    .source = "IEC 61966-2-1; Khronos Data Format Specification",
    .rows = {20},
    .axes = {{.name = "side", .unit = "px", .low = 1, .high = 257, .standard = 131, .whole = true},
             {.name = "exposure", .unit = "stops", .low = -8, .high = 8, .standard = 0}},
    .problem = random_picture,
    .cpu = {{.solve = [](const Linear& p) { return cpu::encode_srgb(p.picture, p.exposure); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Linear& p) {
                   return gpu::encode_srgb(context, p.picture, p.exposure);
                 }}},
    .distance = [](const Linear& p, const Grid<u8vec4>& got,
                   const Grid<u8vec4>&) { return error(p, got); },
    .tolerance = 0.5 + 255 * 1.055 * 24 * 0x1p-23,
    .why = "codes from the value before rounding: half a code, and where it is near a tie the "
           "error of the power, "
           "16 ULP measured and bounded by exp2(y log2 x), exp2 of the exposure 3 + 2 |x| ULP",
    .error = error,
    .error_unit = "codes",
});

}  // namespace
}  // namespace parity
