#include "cpu_reference/texture/anisotropic.h"

#include <numbers>

#include "cpu_reference/texture/answers.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "gpu/texture/sample.h"
#include "tests/chart.h"
#include "tests/stage.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

constexpr Sampler anisotropic(int most) { return {.max_anisotropy = most}; }

cpu::Footprint widened(const TextureFootprint& f) {
  return {dvec2(f.uv), dvec2(f.uv_dx), dvec2(f.uv_dy)};
}

struct FootprintLookups {
  std::vector<Grid<u8vec4>> levels;
  bool srgb = false;
  Sampler sampler;
  std::vector<TextureFootprint> footprints;
  MippedTexture texture() const { return {levels, srgb, sampler}; }
};
auto fields_of(const FootprintLookups*) {
  return std::tuple{&FootprintLookups::levels, &FootprintLookups::footprints};
}

FootprintLookups make_lookups(const Setting& setting) {
  Random random{setting.seed};
  FootprintLookups p;
  const int side = setting.count("side");
  p.srgb = setting.count("srgb") != 0;
  p.levels = cpu::mip_pyramid(texture_test::random_image(side, (side + 1) / 2, random), p.srgb);
  p.sampler = anisotropic(setting.count("max_anisotropy"));
  p.sampler.wrap_u = Wrap(setting.count("wrap"));
  p.sampler.wrap_v = Wrap((setting.count("wrap") + 1) % 5);
  p.footprints = texture_test::random_footprints(side, (side + 1) / 2, 1500, random);
  return p;
}

/// The largest difference, in units of its bound. Float arithmetic on the ellipse is as good as
/// derivatives that are off by 2^-20 of the longer one: sums of two products, a determinant that is
/// off by 2^-23 of their product where the minor axis is at least a 16th of the major one. Places
/// are off by 2^-22 of their coordinate in texels.
double worst(const FootprintLookups& p, const std::vector<dvec4>& got,
             const std::vector<dvec4>& want) {
  const MippedTexture texture = p.texture();
  const dvec2 size{double(p.levels[0].width()), double(p.levels[0].height())};
  double largest = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const cpu::Footprint f = widened(p.footprints[i]);
    const dvec2 place = 0x1p-22 * (glm::abs(f.uv) + 1.0 / size);
    const dvec4 bound = cpu::moved_by(texture, f, place, 0x1p-19) + 64 * 0x1p-24;
    const dvec4 apart = glm::abs(got[i] - want[i]) / bound;
    largest = std::max({largest, apart.x, apart.y, apart.z, apart.w});
  }
  return largest;
}

const Registration registration = register_stage<FootprintLookups, std::vector<dvec4>>({
    .name = "texture/anisotropic",
    .title = "The mean over the ellipse that a pixel is in the texture",
    .source = "notes 6.3; Heckbert 1989",
    .rows = {115},
    .axes = {{.name = "max_anisotropy", .low = 1, .high = 16, .standard = 8, .whole = true},
             {.name = "srgb", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true},
             {.name = "wrap", .low = 0, .high = 4, .standard = 0, .whole = true, .each = true},
             {.name = "side",
              .unit = "texel",
              .low = 1,
              .high = 257,
              .standard = 131,
              .logarithmic = true,
              .whole = true}},
    .problem = make_lookups,
    .cpu = {{.solve =
                 [](const FootprintLookups& p) {
                   std::vector<dvec4> colors;
                   for (const TextureFootprint& f : p.footprints)
                     colors.push_back(cpu::sample(p.texture(), widened(f)).value);
                   return colors;
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const FootprintLookups& p) {
                   const auto colors = gpu::sample(context, p.texture(), p.footprints, 0.5f);
                   return std::vector<dvec4>(colors.begin(), colors.end());
                 }}},
    .distance = [](const FootprintLookups& p, const std::vector<dvec4>& got,
                   const std::vector<dvec4>& want) { return worst(p, got, want); },
    .tolerance = 1,
    .why = "in units of each lookup's bound: what the answer changes when its place moves by 2^-22 "
           "of its coordinate in texels and its derivatives by 2^-19 of the longer one (float "
           "products, a determinant), and 64 2^-24 for the weighted sums of values up to 1",
    .chart_axes = {"max_anisotropy"},
});

/// A floor that runs to the horizon: footprints from square to more than 30 times as long as wide.
std::vector<TextureFootprint> floor_footprints(int width, int height, double tiles) {
  const auto uv = [&](double x, double y) {
    const dvec3 ray{(x - width / 2.0) / width * 1.2, -0.04 - 0.6 * y / height, -1};
    const dvec2 place = dvec2(ray.x, ray.z) / -ray.y;  // eye at height 1
    const double turn = 0.4;
    return dvec2(std::cos(turn) * place.x - std::sin(turn) * place.y,
                 std::sin(turn) * place.x + std::cos(turn) * place.y) *
           tiles;
  };
  std::vector<TextureFootprint> footprints;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const dvec2 here = uv(x + 0.5, y + 0.5);
      footprints.push_back({vec2(here - glm::floor(here)), vec2(uv(x + 1.5, y + 0.5) - here),
                            vec2(uv(x + 0.5, y + 1.5) - here)});
    }
  return footprints;
}

/// Checks, thin lines and noise: edges in all directions.
Grid<u8vec4> test_pattern(int side) {
  Random random{3};
  Grid<u8vec4> image{side, side};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const bool check = ((x / 32) + (y / 32)) % 2 == 0;
      const bool line = (x + 2 * y) % 61 < 4;
      image(x, y) = u8vec4(check ? 255 : 20, line ? 230 : 40, random.below(256), 255);
    }
  return image;
}

double psnr(const std::vector<dvec4>& truth, const std::vector<dvec4>& got) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const dvec3 apart = dvec3(got[i]) - dvec3(truth[i]);
    sum += glm::dot(apart, apart);
  }
  return -10 * std::log10(sum / (3 * double(truth.size())));
}

/// Texels that our filter reads, on average.
double fetches(const MippedTexture& texture, const std::vector<TextureFootprint>& footprints,
               double bias) {
  double count = 0;
  for (const TextureFootprint& f : footprints) count += cpu::texels_read(texture, widened(f), bias);
  return count / double(footprints.size());
}

/// Texels that the device's sampler gives a weight to, on average: the answer to a texture of one
/// lit texel, which is moved through the footprint by moving the footprint. Footprints are scaled
/// by a power of two so that only the first two levels are read.
double hardware_fetches(gpu::Context& context, int most,
                        const std::vector<TextureFootprint>& footprints, int image_side) {
  constexpr int side = 128;
  double count = 0, measured = 0;
  for (std::size_t i = 0; i < footprints.size(); i += footprints.size() / 24) {
    TextureFootprint f = footprints[i];
    const cpu::FootprintAxes axes =
        cpu::footprint_axes(dvec2(f.uv_dx), dvec2(f.uv_dy), image_side, image_side);
    const double width = std::max(axes.minor, axes.major / most);
    const double scale =
        double(image_side) / side * std::exp2(-std::max(0.0, std::floor(std::log2(width))));
    f.uv_dx *= float(scale);
    f.uv_dy *= float(scale);
    for (std::size_t lit = 0; lit < 2; ++lit) {
      std::vector<Grid<u8vec4>> levels = texture_test::level_steps(side, 0);
      levels[lit](0, 0) = u8vec4(255);
      const int steps = side >> lit;
      std::vector<TextureFootprint> moved;
      for (int y = 0; y < steps; ++y)
        for (int x = 0; x < steps; ++x) {
          moved.push_back(f);
          moved.back().uv += vec2(x, y) / float(steps);
        }
      for (const vec4& color : gpu::hardware_sample(context, {levels, false, anisotropic(most)},
                                                    moved, gpu::Format::rgba32_float))
        count += color.x != 0 ? 1 : 0;
    }
    ++measured;
  }
  return count / measured;
}

/// The best of the points that cost no more.
double best_within(const std::vector<Point>& points, double cost) {
  double best = 0;
  for (const Point& point : points)
    if (point.x <= cost) best = std::max(best, point.y);
  return best;
}

/// Filters that do not follow the footprint, and what each reads.
struct PlainFilter {
  const char* name;
  Sampler sampler;
  double texels;
};
constexpr PlainFilter plain_filters[] = {
    {"nearest", {.mag = Filter::nearest, .min = Filter::nearest, .mip = {}}, 1},
    {"nearest, nearest level",
     {.mag = Filter::nearest, .min = Filter::nearest, .mip = Filter::nearest},
     1},
    {"bilinear", {.mip = {}}, 4},
    {"bilinear, nearest level", {.mip = Filter::nearest}, 4},
};

ChartData quality_per_cost(gpu::Context& context) {
  constexpr int side = 256;
  const std::vector<Grid<u8vec4>> levels = cpu::mip_pyramid(test_pattern(side), false);
  const std::vector<TextureFootprint> footprints = floor_footprints(96, 64, 1.0);
  std::vector<dvec4> truth;
  for (const TextureFootprint& f : footprints)
    truth.push_back(cpu::elliptical_weighted_average({levels, false, {}}, widened(f)));
  ChartData data;
  Series ours[] = {{"ours, a level coarser", {}}, {"ours", {}}, {"ours, a level finer", {}}};
  Series hardware{"the device's sampler", {}};
  std::vector<Point> all;
  for (const int most : {1, 2, 4, 8, 16}) {
    const MippedTexture texture{levels, false, anisotropic(most)};
    const auto point = [&](double cost, const std::vector<vec4>& colors) {
      return Point{cost, psnr(truth, {colors.begin(), colors.end()}), std::to_string(most)};
    };
    for (const int i : {0, 1, 2}) {
      const float bias = 1.0f - 0.5f * float(i);
      ours[i].points.push_back(point(fetches(texture, footprints, bias),
                                     gpu::sample(context, texture, footprints, bias)));
      all.push_back(ours[i].points.back());
    }
    hardware.points.push_back(
        point(hardware_fetches(context, most, footprints, side),
              gpu::hardware_sample(context, texture, footprints, gpu::Format::rgba32_float)));
  }
  Series plain{"no footprint followed", {}};
  for (const PlainFilter& filter : plain_filters) {
    const auto colors = gpu::sample(context, {levels, false, filter.sampler}, footprints, 0.5f);
    plain.points.push_back(
        {filter.texels, psnr(truth, {colors.begin(), colors.end()}), filter.name});
  }
  for (const Point& point : hardware.points)
    data.assertions.push_back(
        {"our PSNR at the device's texels a lookup over the device's, max. "
         "anisotropy " +
             point.label,
         best_within(all, point.x) / point.y, 1.0, Assertion::Relation::at_least});
  data.series = {ours[0], ours[1], ours[2], hardware, plain};
  data.settings = {{"picture", "96x64, a floor up to the horizon"},
                   {"texture", "256x256: checks, lines, noise"},
                   {"labels", "max. anisotropy; 1 is trilinear"},
                   {"texels of the device", "those with a weight, of 24 lookups"}};
  return data;
}

const Registration chart = register_chart({
    .name = "texture/anisotropic_quality",
    .title = "Filters over long footprints, against the elliptical weighted average",
    .x = {.label = "texels read a lookup", .unit = "1"},
    .y = {.label = "PSNR", .unit = "dB", .logarithmic = false},
    .produce = quality_per_cost,
});

}  // namespace
}  // namespace parity
