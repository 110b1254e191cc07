#include "gpu/shading/thin_film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "cpu_reference/shading/thin_film.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const FilmQuery*) {
  return std::tuple{&FilmQuery::base, &FilmQuery::index, &FilmQuery::thickness, &FilmQuery::cosine};
}

namespace {

using Queries = std::vector<FilmQuery>;
using cpu::Interval, cpu::Triple;

Queries random_films(const Setting& setting) {
  Random random{setting.seed};
  Queries queries(std::size_t(setting.count("count")));
  for (FilmQuery& q : queries) {
    q.base = vec3(random.uniform(0.01f, 0.99f), random.uniform(0.01f, 0.5f), 0.04f);
    q.index = random.uniform(1.05f, 2.5f);
    q.thickness = float(setting.at("thickness")) * random.uniform(0.5f, 1.0f);
    q.cosine = random.uniform(0.01f, 1.0f);
  }
  return queries;
}

dvec3 reference(const FilmQuery& q) {
  const Triple<double> f =
      cpu::thin_film<double>(q.index, q.thickness, q.cosine, {q.base.x, q.base.y, q.base.z});
  return {f.x, f.y, f.z};
}

double distance(const Queries& queries, const std::vector<dvec3>& got,
                const std::vector<dvec3>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const FilmQuery& q = queries[i];
    const Triple<Interval> f = cpu::thin_film<Interval>(
        q.index, Interval(double(q.thickness)), Interval(double(q.cosine)),
        {Interval(double(q.base.x)), Interval(double(q.base.y)), Interval(double(q.base.z))});
    const std::array<Interval, 3> range{f.x, f.y, f.z};
    for (int c = 0; c < 3; ++c) {
      const double apart = std::abs(got[i][c] - want[i][c]);
      if (apart > 0)
        worst = std::max(worst, apart / cpu::deviation(range[std::size_t(c)], want[i][c]));
    }
  }
  return worst;
}

const Registration registration = register_stage<Queries, std::vector<dvec3>>({
    .name = "shading/thin_film",
    .title = "Interference colours of thin films",
    .source = "Belcour & Barla 2017; glTF 2.0, KHR_materials_iridescence",
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 1031,
              .logarithmic = true,
              .whole = true},
             {.name = "thickness",
              .unit = "nm",
              .low = 1,
              .high = 2000,
              .standard = 400,
              .logarithmic = true}},
    .problem = random_films,
    .cpu = {{.solve =
                 [](const Queries& queries) {
                   std::vector<dvec3> values;
                   for (const FilmQuery& q : queries) values.push_back(reference(q));
                   return values;
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Queries& queries) {
                   const std::vector<vec3> values = gpu::thin_film(context, queries);
                   return std::vector<dvec3>(values.begin(), values.end());
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why = "in units of the interval that Vulkan's error bounds leave for each number",
});

TEST(ThinFilm, NoFilmReflectsAsTheBaseAlone) {
  // No thickness: the film's index falls back to 1, and all light passes to the base.
  FilmQuery q{vec3(0.04f, 0.3f, 0.9f), 1.5f, 0.0f, 1.0f};
  const dvec3 f = reference(q);
  // The model keeps R R' above 1e-5: first and second order are 2 (1 - R') of its root and of it,
  // as the eye sees them at phase 0: 1.21 at most, in red.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(f[c], q.base[c], 2 * 1.21 * (1 - q.base[c]) * (std::sqrt(1e-5) + 1e-5) + 1e-6);
}

/// Amplitudes that the film's two borders reflect: waves turn by half a cycle where they meet what
/// is denser. Schlick's reflectances, as in KHR_materials_iridescence.
std::pair<double, double> borders(const FilmQuery& q, double base) {
  const double root = std::sqrt(base), below = (1 + root) / (1 - root);
  const auto amplitude = [](double from, double to, double cosine) {
    const double f0 = std::pow((from - to) / (from + to), 2);
    return std::copysign(std::sqrt(f0 + (1 - f0) * std::pow(1 - cosine, 5)), from - to);
  };
  const double sine = std::sqrt(1 - double(q.cosine) * q.cosine) / q.index;
  return {amplitude(1, q.index, q.cosine), amplitude(q.index, below, std::sqrt(1 - sine * sine))};
}

/// What light travels on the way through the film and back, metres less what it would beside.
double path_of(const FilmQuery& q) {
  return 2e-9 * q.thickness *
         std::sqrt(double(q.index) * q.index - 1 + double(q.cosine) * q.cosine);
}

/// Reflectance at one wave number (1/m): Airy's sum of all paths, as complex amplitudes.
double airy(const FilmQuery& q, double base, double wave_number) {
  const auto [above, below] = borders(q, base);
  const std::complex<double> turn =
      std::polar(1.0, 2 * std::numbers::pi * path_of(q) * wave_number);
  return std::norm((above + below * turn) / (1.0 + above * below * turn));
}

/// The four Gaussians over wave numbers of Belcour & Barla 2017: what each adds to linear Rec. 709.
struct Lobe {
  double value, position, variance;
  dvec3 rgb;
};
const dvec3 rgb_of_x{3.2404542, -0.9692660, 0.0556434}, rgb_of_y{-1.5371385, 1.8760108, -0.2040259},
    rgb_of_z{-0.4985314, 0.0415560, 1.0572252};
const Lobe lobes[] = {{5.4856e-13, 1.6810e+06, 4.3278e+09, rgb_of_x},
                      {9.7470e-14, 2.2399e+06, 4.5282e+09, rgb_of_x},
                      {4.4201e-13, 1.7953e+06, 9.3046e+09, rgb_of_y},
                      {5.2481e-13, 2.2084e+06, 6.6121e+09, rgb_of_z}};

/// What the eye makes of Airy's sum, wave number by wave number; its mean over phases is taken as
/// white. The Gaussians' spectra are exp(-v phase^2): they are of variance 2 v.
dvec3 seen(const FilmQuery& q) {
  constexpr int steps = 400;
  const double base = q.base.x;
  double mean = 0;  // over one turn of the phase
  for (int i = 0; i < steps; ++i) mean += airy(q, base, i / (steps * path_of(q))) / steps;
  dvec3 sum{mean};
  for (const Lobe& lobe : lobes) {
    const double reach = 6 * std::sqrt(2 * lobe.variance), step = 2 * reach / steps;
    for (int i = 0; i < steps; ++i) {
      const double away = (i + 0.5) * step - reach;
      sum += lobe.rgb * (lobe.value / 1.0685e-7 / std::sqrt(2.0) *
                         std::exp(-away * away / (4 * lobe.variance)) * step *
                         (airy(q, base, lobe.position + away) - mean));
    }
  }
  return sum;
}

/// Grey bases: the model turns the waves of X, Y, Z as the bases of R, G, B do.
TEST(ThinFilm, IsAirysSumThroughTheEyesOfItsSpectrum) {
  double change = 0;
  for (const float base : {0.04f, 0.15f, 0.4f})
    for (const float index : {1.1f, 1.33f, 1.8f})
      for (const float thickness : {50.0f, 180.0f, 400.0f, 700.0f})
        for (const float cosine : {0.4f, 0.7f, 1.0f}) {
          const FilmQuery q{vec3(base), index, thickness, cosine};
          const dvec3 want = glm::clamp(seen(q), 0.0, 1.0), got = reference(q);
          // Left out from the third order on: waves of 2 (1 - R) r^m, r = sqrt(R R') of the two
          // borders, each as the eye's sensitivity sees it.
          const auto [above, below] = borders(q, base);
          const double r = std::abs(above * below);
          const double left_out = 2 * (1 - above * above) * r * r * r / (1 - r);
          for (int c = 0; c < 3; ++c) {
            double eye = 0;
            for (const Lobe& lobe : lobes)
              eye += std::abs(lobe.rgb[c]) * lobe.value / 1.0685e-7 *
                     std::sqrt(2 * std::numbers::pi * lobe.variance);
            // 1e-5: sums of 400 points instead of integrals.
            EXPECT_NEAR(got[c], want[c], eye * left_out + 1e-5)
                << base << " " << index << " " << thickness << " " << cosine << " " << c;
            change = std::max(change, std::abs(got[c] - got[0]));
          }
        }
  EXPECT_GT(change, 0.1) << "the test needs films of colour";
}

TEST(ThinFilm, ColoursChangeWithTheThicknessAndStayWithinBounds) {
  dvec3 least{1.0}, most{0.0};
  for (float thickness = 100; thickness < 800; thickness += 10) {
    const dvec3 f = reference({vec3(0.2f), 1.6f, thickness, 0.8f});
    least = glm::min(least, f);
    most = glm::max(most, f);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(least[c], 0);
    EXPECT_LE(most[c], 1);
    EXPECT_GT(most[c] - least[c], 0.1);
  }
}

}  // namespace
}  // namespace parity
