// Both sides on millions of pixels, and where clipping lets a device differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cpu_reference/raster/rasterize.h"
#include "gpu/raster/edge_coverage.h"
#include "tests/gpu_context.h"
#include "tests/raster/coverage_rule.h"
#include "tests/raster/mesa_clip.h"
#include "tests/raster/triangles.h"

namespace parity {
namespace {

using raster_test::Kind;
using raster_test::RasterProblem;

bool has_samples(int samples) {
  const std::vector<int>& counts = test_context().info().sample_counts;
  return std::find(counts.begin(), counts.end(), samples) != counts.end();
}

void append(TriangleList& to, const TriangleList& from) {
  const auto first = std::uint32_t(to.clip_positions.size());
  to.clip_positions.insert(to.clip_positions.end(), from.clip_positions.begin(),
                           from.clip_positions.end());
  for (const uvec3& triangle : from.triangles) to.triangles.push_back(triangle + first);
}

/// Every kind that needs no clipping in one picture, two and a half layers deep.
TriangleList triangles_of_all_kinds(int side, int samples) {
  TriangleList all{.width = side, .height = side, .samples = samples};
  constexpr std::pair<Kind, int> kinds[] = {
      {Kind::random, 16},     {Kind::slivers, 1500},   {Kind::ties, 12},   {Kind::mesh, 800},
      {Kind::subpixel, 4000}, {Kind::off_screen, 100}, {Kind::behind, 100}};
  for (const auto& [kind, count] : kinds)
    append(all, raster_test::make_triangles(kind, side, samples, count, 7 + std::uint64_t(kind)));
  return all;
}

std::size_t differences(const Coverage& a, const Coverage& b) {
  std::size_t wrong = a.count.size() == b.count.size() ? 0 : 1;
  for (std::size_t i = 0; wrong == 0 && i < a.count.size(); ++i)
    wrong += a.count[i] != b.count[i] || a.last[i] != b.last[i];
  return wrong;
}

class CoverageOf : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Samples, CoverageOf, testing::Values(1, 2, 4, 8),
                         testing::PrintToStringParamName());

// 1449^2 = 2.1 million pixels. The largest picture that the tests draw: more workgroups a pass than
// an axis takes show here, too.
TEST_P(CoverageOf, TwoMillionPixelsIsThatOfTheReferenceBitForBit) {
  constexpr int side = 1449;
  const RasterProblem problem =
      raster_test::for_device(triangles_of_all_kinds(side, GetParam()), test_context().info());
  const Coverage want = cpu::span_coverage(problem.list, problem.snapping);
  const auto layers = double(std::accumulate(want.count.begin(), want.count.end(), std::size_t{0}));
  EXPECT_GT(layers / double(want.count.size()), 2.0);
  EXPECT_EQ(differences(gpu::edge_coverage(test_context(), problem.list, problem.snapping), want),
            0u);
  if (!has_samples(GetParam())) return;
  const Coverage hardware = gpu::hardware_coverage(test_context(), problem.list);
  if (problem.snapping_is_known)
    EXPECT_EQ(differences(hardware, want), 0u);
  else
    EXPECT_EQ(raster_test::wrong_samples(problem, hardware, want), 0u);
}

RasterProblem clipped_problem(Kind kind, int samples, int side = 512) {
  return raster_test::for_device(raster_test::make_triangles(kind, side, samples, 60, 3),
                                 test_context().info());
}

// Ours are cut at the near plane and 2^15 px out only.
TEST_P(CoverageOf, TrianglesAcrossTheBorderIsExactInOurRasterisers) {
  const RasterProblem problem = clipped_problem(Kind::crossing, GetParam());
  EXPECT_EQ(differences(gpu::edge_coverage(test_context(), problem.list, problem.snapping),
                        cpu::span_coverage(problem.list, problem.snapping)),
            0u);
}

TEST_P(CoverageOf, ClippedTrianglesDiffersOnlyWhereTheirBordersAreInDoubt) {
  for (const Kind kind : {Kind::crossing, Kind::through, Kind::huge}) {
    const RasterProblem problem = clipped_problem(kind, GetParam());
    const Coverage want = cpu::span_coverage(problem.list, problem.snapping);
    const Coverage compute = gpu::edge_coverage(test_context(), problem.list, problem.snapping);
    EXPECT_EQ(raster_test::wrong_samples(problem, compute, want), 0u);
    if (!has_samples(GetParam())) continue;
    const Coverage hardware = gpu::hardware_coverage(test_context(), problem.list);
    EXPECT_EQ(raster_test::wrong_samples(problem, hardware, want), 0u);
  }
}

// A device that moves clipped triangles by two of its steps is found out.
TEST_P(CoverageOf, ClippedTrianglesMayNotMove) {
  for (const Kind kind : {Kind::crossing, Kind::through}) {
    const RasterProblem problem = clipped_problem(kind, GetParam());
    RasterProblem moved = problem;
    const float shift = 4.0f / (float(1 << problem.subpixel_bits) * float(problem.list.width));
    for (vec4& p : moved.list.clip_positions) p.x += shift * p.w;
    const Coverage want = cpu::span_coverage(problem.list, problem.snapping);
    const Coverage got = gpu::edge_coverage(test_context(), moved.list, problem.snapping);
    EXPECT_GT(raster_test::wrong_samples(problem, got, want), 20u);
  }
}

// The evidence that nothing else differs: with Mesa's way of clipping the reference is exact again.
TEST_P(CoverageOf, ClippedTrianglesIsThatOfMesasPieces) {
  if (!test_context().info().is_mesa_software || !has_samples(GetParam()))
    GTEST_SKIP() << "skipped: how this device clips is not known, or it lacks that many samples";
  for (const Kind kind : {Kind::crossing, Kind::through}) {
    const RasterProblem problem = clipped_problem(kind, GetParam(), 1024);
    const Coverage hardware = gpu::hardware_coverage(test_context(), problem.list);
    EXPECT_EQ(differences(hardware, raster_test::mesa_coverage(problem.list)), 0u);
  }
}

}  // namespace
}  // namespace parity
