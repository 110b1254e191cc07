#include "gpu/shading/albedo_table.h"

#include "cpu_reference/shading/albedo_table.h"
#include "shaders/shading/layout.h"
#include "tests/shading/queries.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct TableProblem {
  int samples = 32;
};
auto fields_of(const TableProblem*) { return std::tuple{&TableProblem::samples}; }

double alpha_of_row(int row) { return std::pow(std::max(row / 15.0, 1.0 / 64), 2); }

double cosine_of_column(int column, double alpha) {
  const double x2 = column * column / 225.0;
  return std::clamp(alpha * x2 / (1 + alpha - x2), 0.001 * alpha, 1.0);
}

/// What comes back of light as F0 and Schlick's weight let it.
cpu::DirectionalAlbedo albedo_of(const dvec4& entry, double cosine) {
  const double offset = entry.x * std::pow(1 - std::min(cosine + entry.y, 1.0), 5);
  return {entry.x - offset, offset};
}

/// Largest difference in units of each entry's bound: light's cosine is a difference, off by 8 u; a
/// share changes by at most 1 / (4 cosine) of that, and cosines below c are the part c / alpha of
/// all samples, which makes 2 u / alpha (1 + log(1 / u)), 40 u / alpha; the rest is 64 u, of which
/// Schlick's mean has 8 u for the root of its fifth power. Sheen: a power (0.5 / 0.04 by 2^-21) of
/// values that add up to 2.
double distance(const Grid<dvec4>& got, const Grid<dvec4>& want) {
  double worst = 0;
  for (int row = 0; row < want.height(); ++row)
    for (int column = 0; column < want.width(); ++column) {
      const dvec4 apart = glm::abs(got(column, row) - want(column, row));
      const double cosine = cosine_of_column(column, alpha_of_row(row));
      const double rising = std::abs(albedo_of(got(column, row), cosine).offset -
                                     albedo_of(want(column, row), cosine).offset);
      const double bound = shading_test::u * (64 + 40 / alpha_of_row(row));
      const double mean =
          std::abs(std::pow(got(column, row).z, 2) - std::pow(want(column, row).z, 2));
      worst = std::max({worst, apart.x / bound, rising / bound, mean / bound, apart.w / 4e-5});
    }
  return worst;
}

/// The largest error of the table's entries on every third node, against quadrature over another
/// variable, four times as fine as it needs to be to be right to 1e-4.
double error(const TableProblem&, const Grid<dvec4>& table) {
  double worst = 0;
  for (int row = 3; row < 16; row += 3)
    for (int column = 3; column < 16; column += 3) {
      const double alpha = alpha_of_row(row), cosine = cosine_of_column(column, alpha);
      const cpu::DirectionalAlbedo exact = cpu::directional_albedo(alpha, cosine, 128);
      const cpu::DirectionalAlbedo got = albedo_of(table(column, row), cosine);
      worst = std::max(worst, std::abs(got.slope - exact.slope));
      worst = std::max(worst, std::abs(got.offset - exact.offset));
    }
  return worst;
}

const Registration registration = register_stage<TableProblem, Grid<dvec4>>({
    .name = "shading/albedo_table",
    .title = "Part of white light from everywhere that a rough surface sends to the eye",
    .source = "notes 6.2; Karis 2013; Heitz 2018; Kulla & Conty 2017",
    .rows = {108},
    .axes = {{.name = "samples",
              .low = 4,
              .high = 64,
              .standard = 32,
              .logarithmic = true,
              .whole = true}},
    .problem = [](const Setting& setting) { return TableProblem{setting.count("samples")}; },
    .cpu = {{.solve =
                 [](const TableProblem& p) {
                   return cpu::albedo_table(int(albedo_side), p.samples);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const TableProblem& p) {
                   const Grid<vec4> table = gpu::albedo_table(context, p.samples);
                   Grid<dvec4> wide{table.width(), table.height()};
                   std::copy(table.begin(), table.end(), wide.begin());
                   return wide;
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why =
        "in units of each entry's bound: the cosine of the light is a difference, off by 8 u, and "
        "weighs 1 / 4 of its reciprocal on a part 1 / alpha of the samples: (64 + 40 / alpha) u; "
        "sheen: x^12.5 with Vulkan's log2, 4e-5",
    .error = error,
    .error_unit = "albedo",
    .chart_axes = {"samples"},
});

}  // namespace
}  // namespace parity
