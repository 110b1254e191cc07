#include "gpu/texture/mip_pyramid.h"

#include <algorithm>
#include <cstring>

#include "cpu_reference/texture/mip_pyramid.h"
#include "geometry/mip_pyramid.h"
#include "tests/chart.h"
#include "tests/stage.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

using Pyramid = std::vector<Grid<u8vec4>>;

struct MipProblem {
  Grid<u8vec4> image;
  bool srgb = false;
};
auto fields_of(const MipProblem*) { return std::tuple{&MipProblem::image}; }

MipProblem make_image(const Setting& setting) {
  Random random{setting.seed};
  const int side = setting.count("side");
  const ivec2 sizes[] = {
      {side, (side + 2) / 3}, {8 * ((side + 3) / 4), 8 * ((side + 7) / 8)}, {1, side}};
  const ivec2 size = sizes[setting.count("shape")];
  return {texture_test::random_image(size.x, size.y, random), setting.count("srgb") != 0};
}

/// Largest distance of a code from the mean before rounding.
double error(const MipProblem& p, const Pyramid& got) {
  const std::vector<Grid<dvec4>> means = cpu::mip_means(p.image, p.srgb);
  double worst = got.size() == means.size() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(got.size(), means.size()); ++k)
    for (std::size_t i = 0; i < means[k].size(); ++i) {
      const dvec4 apart = glm::abs(dvec4(got[k].values()[i]) - means[k].values()[i]);
      worst = std::max({worst, apart.x, apart.y, apart.z, apart.w});
    }
  return worst;
}

const Registration registration = register_stage<MipProblem, Pyramid>({
    .name = "texture/mip_pyramid",
    .title = "An image's smaller versions: means in linear light, boxes of any size",
    .source = "notes 6.3; Williams 1983; Vulkan 1.3, Image Mip Level Sizing",
    .rows = {112},
    .axes = {{.name = "side",
              .unit = "texel",
              .low = 1,
              .high = 257,
              .standard = 131,
              .logarithmic = true,
              .whole = true},
             {.name = "shape", .low = 0, .high = 2, .standard = 0, .whole = true, .each = true},
             {.name = "srgb", .low = 0, .high = 1, .standard = 1, .whole = true, .each = true}},
    .problem = make_image,
    .cpu = {{.solve = [](const MipProblem& p) { return cpu::mip_pyramid(p.image, p.srgb); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const MipProblem& p) {
                   return gpu::mip_pyramid(context, p.image, p.srgb);
                 }}},
    .distance = [](const MipProblem& p, const Pyramid& got,
                   const Pyramid&) { return error(p, got); },
    .tolerance = 0.515,
    .why = "codes from the mean before rounding: half a code; the decoding polynomial is off by at "
           "most 0.0118 codes, of means too, as the curve's slope is concave in linear light, the "
           "encoding one by 0.0017, sums of up to 13 levels by 13 4 2^-24 of the value",
    .error = error,
    .error_unit = "codes",
    .chart_axes = {"side"},
});

/// Both ways to make the pyramid of one image on the device, and what they take.
class Rivals {
 public:
  Rivals(gpu::Context& context, const Grid<u8vec4>& image)
      : context_(context),
        image_(image),
        levels_(mip_levels(image.width(), image.height())),
        pyramid_(context),
        scratch_(context, image.width(), image.height()),
        codes_(context, levels_.back().first + 1),
        texture_(context, {.width = image.width(),
                           .height = image.height(),
                           .levels = int(levels_.size()),
                           .format = gpu::Format::rgba8_srgb}) {
    std::vector<std::uint32_t> words(image.size());
    std::memcpy(words.data(), image.data(), image.size() * sizeof(std::uint32_t));
    codes_.write(words);
    context.run([&](gpu::Commands& commands) { commands.copy(codes_, texture_, 0); });
  }

  double run_ours() {
    return context_
        .run([&](gpu::Commands& commands) {
          pyramid_.record(commands, codes_, image_.width(), image_.height(), true, scratch_);
        })
        .seconds;
  }
  double run_blits() {
    return context_
        .run([&](gpu::Commands& commands) {
          for (int k = 1; k < int(levels_.size()); ++k) commands.blit_level(texture_, k - 1, k);
        })
        .seconds;
  }

  /// Root of the mean square distance of codes from exact means, over levels 1..n of the tile of
  /// `side` texels in the top left corner; a tile's pyramid is a part of the whole one.
  double error(bool ours, int side) const {
    Grid<u8vec4> tile{side, side};
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) tile(x, y) = image_(x, y);
    const std::vector<Grid<dvec4>> means = cpu::mip_means(tile, true);
    double sum = 0, count = 0;
    for (std::size_t k = 1; k < means.size(); ++k) {
      const std::vector<std::uint32_t> words = level(ours, k);
      for (int y = 0; y < means[k].height(); ++y)
        for (int x = 0; x < means[k].width(); ++x) {
          const std::uint32_t word = words[std::size_t(y * levels_[k].width + x)];
          const dvec4 code(word & 255, word >> 8 & 255, word >> 16 & 255, word >> 24);
          const dvec4 apart = code - means[k](x, y);
          sum += glm::dot(apart, apart);
          count += 4;
        }
    }
    return std::sqrt(sum / count);
  }

 private:
  std::vector<std::uint32_t> level(bool ours, std::size_t k) const {
    const std::size_t count = std::size_t(levels_[k].width) * std::size_t(levels_[k].height);
    if (ours) return codes_.read(levels_[k].first, count);
    const gpu::Buffer<std::uint32_t> words(context_, count);
    context_.run([&](gpu::Commands& commands) { commands.copy(texture_, words, int(k)); });
    return words.read();
  }

  gpu::Context& context_;
  const Grid<u8vec4>& image_;
  std::vector<MipLevel> levels_;
  gpu::MipPyramid pyramid_;
  gpu::MipPyramid::Scratch scratch_;
  gpu::Buffer<std::uint32_t> codes_;
  gpu::Image texture_;
};

ChartData against_blits(gpu::Context& context) {
  Series ours{"compute kernel", {}}, blits{"chain of linear blits", {}};
  double time_ratio = 0, error_ratio = 0;
  for (const int side : {512, 1024, 2048, 4096}) {
    Random random{7};
    const Grid<u8vec4> image = texture_test::random_image(side, side, random);
    Rivals rivals(context, image);
    double our_time = 1e9, blit_time = 1e9;
    for (int i = 0; i < 7; ++i) {  // in turn, so that whatever slows one slows the other
      our_time = std::min(our_time, rivals.run_ours());
      blit_time = std::min(blit_time, rivals.run_blits());
    }
    const double our_error = rivals.error(true, std::min(side, 1024));
    const double blit_error = rivals.error(false, std::min(side, 1024));
    const std::string label = std::to_string(side);
    ours.points.push_back({our_time * 1e3, our_error, label});
    blits.points.push_back({blit_time * 1e3, blit_error, label});
    time_ratio = our_time / blit_time;
    error_ratio = our_error / blit_error;
  }
  return {.series = {ours, blits},
          .assertions = {{"time over the blits', 4096x4096", time_ratio, 1.0},
                         {"error over the blits', 4096x4096", error_ratio, 1.0}},
          .settings = {{"image", "RGBA8 sRGB, independent texels"},
                       {"error", "levels 1 to n of the first 1024x1024 texels"},
                       {"time", "least of 7, in turn"}}};
}

const Registration chart = register_chart({
    .name = "texture/mip_pyramid_blits",
    .title = "Mip pyramids: our kernel and the driver's blits",
    .x = {.label = "device time", .unit = "ms"},
    .y = {.label = "root mean square error", .unit = "codes"},
    .produce = against_blits,
    .pareto = true,
});

}  // namespace
}  // namespace parity
