#include "gpu/raster/encode_srgb.h"

#include <cmath>
#include <vector>

#include "shaders.h"

namespace parity::gpu {
namespace {

double decoded(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// The least float that is nearest to each code: what decodes to half a code below, rounded up.
std::vector<float> code_thresholds() {
  std::vector<float> thresholds{0.0f};
  for (int code = 1; code < 256; ++code) {
    const double exact = decoded((code - 0.5) / 255);
    float threshold = float(exact);
    if (threshold < exact) threshold = std::nextafter(threshold, 2.0f);
    thresholds.push_back(threshold);
  }
  return thresholds;
}

}  // namespace

SrgbEncoder::SrgbEncoder(Context& context)
    : kernel_(context, shaders::raster_encode_srgb_comp), thresholds_(context, code_thresholds()) {}

void SrgbEncoder::record(Commands& commands, BufferRef<vec4> colors, BufferRef<std::uint32_t> codes,
                         std::uint32_t count, float exposure) const {
  commands.dispatch(kernel_, {count},
                    {colors, codes, thresholds_, count, float(std::exp2(double(exposure)))});
}

Grid<u8vec4> encode_srgb(Context& context, const Grid<vec4>& colors, float exposure) {
  const SrgbEncoder encoder(context);
  const Buffer<vec4> linear(context, colors.values());
  const Buffer<std::uint32_t> codes(context, colors.size());
  context.run([&](Commands& commands) {
    encoder.record(commands, linear, codes, std::uint32_t(colors.size()), exposure);
  });
  Grid<u8vec4> encoded{colors.width(), colors.height()};
  const std::vector<std::uint32_t> words = codes.read();
  for (std::size_t i = 0; i < words.size(); ++i)
    encoded.values()[i] = u8vec4(words[i], words[i] >> 8, words[i] >> 16, words[i] >> 24);
  return encoded;
}

}  // namespace parity::gpu
