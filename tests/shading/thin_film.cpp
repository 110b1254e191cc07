#include "gpu/shading/thin_film.h"

#include <gtest/gtest.h>

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
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], q.base[c], 0.02);  // two orders of the series
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
