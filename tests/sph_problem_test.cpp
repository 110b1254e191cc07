#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim/sph.h"

namespace parity {
namespace {

TEST(SphProblem, ShippedScenesPassTheirOwnCheck) {
  for (const std::uint32_t d : {2u, 3u}) {
    EXPECT_NO_THROW(check_sph_problem(sph_dam_break(d, 0.1, 8)));
    EXPECT_NO_THROW(check_sph_problem(sph_hydrostatic_column(d, 0.3, 0.5, 10)));
    EXPECT_NO_THROW(check_sph_problem(sph_double_dam_break(d, 8)));
    EXPECT_NO_THROW(check_sph_problem(sph_random_drop(d, 6, 1, 3)));
  }
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    EXPECT_NO_THROW(check_sph_problem(sph_random_scene(seed))) << seed;
}

TEST(SphProblem, TheMassIsThatOfTheVolume) {
  const SphProblem column = sph_dam_break(3, 0.1, 8);
  EXPECT_NEAR(measure(column.parameters, column.initial).mass, 1000 * 0.1 * 0.2 * 0.1, 1e-9);
  EXPECT_NEAR(measure(column.parameters, column.initial).center.y, 0.1, 1e-7);
}

//  o o o o o     a tank of 3 x 2 spacings has 5 x 4 walls around it, its top 3 open
TEST(SphProblem, WallsHaveNoHoles) {
  const SphBox box{dvec3(0), dvec3(3, 2, 4)};
  EXPECT_EQ(cover_box(box, 1, 2, true, true).size(), 5u * 4u - 3u * 2u - 3u);
  EXPECT_EQ(cover_box(box, 1, 2, true, false).size(), 5u * 4u - 3u * 2u);
  EXPECT_EQ(cover_box(box, 1, 3, true, false).size(), 5u * 4u * 6u - 3u * 2u * 4u);
  EXPECT_EQ(cover_box(box, 1, 3, false, false).size(), 3u * 2u * 4u - 1u * 0u);
}

TEST(SphProblem, BadNumbersAreRefusedByName) {
  const auto refused = [](const std::function<void(SphProblem&)>& spoil) {
    SphProblem problem = sph_dam_break(2, 0.1, 4);
    spoil(problem);
    try {
      check_sph_problem(problem);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto names = [](const std::string& text, const char* what) {
    return text.find(what) != std::string::npos && text.find("must be") != std::string::npos;
  };
  EXPECT_EQ(refused([](SphProblem&) {}), "");
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.parameters.viscosity = -1; }), "viscosity"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.parameters.spacing = 0; }), "spacing"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.parameters.dimensions = 4; }), "dimensions"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.initial.positions[3].x = NAN; }), "particle 3"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.initial.positions[2].x = 9; }), "particle 2"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.initial.positions[1].z = 1; }), "particle 1"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.initial.velocities.pop_back(); }), "velocities"));
  EXPECT_TRUE(names(refused([](SphProblem& p) { p.domain.high.x = 1e9; }), "cells"));
}

TEST(SphProblem, OnlyCompressionIsADensityError) {
  const SphParameters p;
  const std::vector<float> densities{500, 1000, 1010, 1030};
  const SphDensityError error = density_error(p, densities);
  EXPECT_NEAR(error.average, 0.01, 1e-7);
  EXPECT_NEAR(error.largest, 0.03, 1e-7);
  EXPECT_EQ(density_error(p, {}).largest, 0);
}

}  // namespace
}  // namespace parity
