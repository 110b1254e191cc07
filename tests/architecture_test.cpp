#include "tests/architecture.h"

#include <gtest/gtest.h>

namespace parity {
namespace {

using Faults = std::vector<std::string>;

TEST(Architecture, TheTreeKeepsItsRules) {
  for (const std::string& fault : tree_faults(PARITY_SOURCE_DIR)) ADD_FAILURE() << fault;
}

Faults faults_of_include(const std::string& path, const std::string& included) {
  return architecture_faults(path, "#pragma once\n#include " + included + "\n");
}

TEST(Architecture, TheSidesMayNotIncludeEachOther) {
  const Faults expected{"may not include gpu/raster/clip.h"};
  EXPECT_EQ(faults_of_include("cpu_reference/raster/clip.h", "\"gpu/raster/clip.h\""), expected);
  EXPECT_EQ(faults_of_include("gpu/raster/clip.h", "\"cpu_reference/raster/clip.h\"").size(), 1u);
  EXPECT_EQ(faults_of_include("geometry/mesh.h", "\"gpu/core/buffer.h\"").size(), 1u);
  EXPECT_EQ(faults_of_include("gpu/raster/clip.h", "\"tests/stage.h\"").size(), 1u);
  EXPECT_EQ(faults_of_include("gpu/core/buffer.h", "\"geometry/mesh.h\"").size(), 1u);
  EXPECT_EQ(faults_of_include("cpu_reference/raster/clip.h", "\"shaders/raster/clip.glsl\"").size(),
            1u);
  EXPECT_EQ(
      faults_of_include("shaders/raster/clip.comp", "\"../cpu_reference/raster/clip.h\"").size(),
      1u);
}

TEST(Architecture, WhatTheTableAllowsPasses) {
  EXPECT_EQ(faults_of_include("cpu_reference/raster/clip.h", "\"geometry/raster.h\""), Faults{});
  EXPECT_EQ(faults_of_include("cpu_reference/raster/clip.h", "\"shaders/raster/layout.h\""),
            Faults{});
  EXPECT_EQ(faults_of_include("gpu/raster/clip.cpp", "\"shaders.h\""), Faults{});
  EXPECT_EQ(faults_of_include("gpu/raster/clip.cpp", "<vector>"), Faults{});
  EXPECT_EQ(faults_of_include("tests/stage.h", "\"gpu/core/context.h\""), Faults{});
}

TEST(Architecture, LibrariesStayInTheirFiles) {
  EXPECT_EQ(faults_of_include("gpu/core/buffer.cpp", "<volk.h>"), Faults{});
  EXPECT_EQ(faults_of_include("gpu/core/buffer.h", "<volk.h>").size(), 1u);
  EXPECT_EQ(faults_of_include("gpu/raster/clip.cpp", "<vulkan/vulkan.h>").size(), 1u);
  EXPECT_EQ(faults_of_include("geometry/png_io.cpp", "<png.h>"), Faults{});
  EXPECT_EQ(faults_of_include("geometry/mesh.cpp", "<tiny_gltf.h>").size(), 1u);
  EXPECT_EQ(faults_of_include("cpu_reference/raster/clip.cpp", "<glm/glm.hpp>").size(), 1u);
}

TEST(Architecture, PlantedLeftOversAreFound) {
  const auto count = [](const std::string& text) {
    return architecture_faults("geometry/mesh.cpp", text).size();
  };
  EXPECT_EQ(count("int a;\n"), 0u);
  EXPECT_EQ(count("\tint a;\n"), 1u);
  EXPECT_EQ(count("int a; \n"), 1u);
  EXPECT_EQ(count(std::string("// TO") + "DO later\n"), 1u);
  EXPECT_EQ(count(std::string("\"/wo") + "rk/data\"\n"), 1u);
}

TEST(Architecture, NamesAreSnakeCaseInChapters) {
  EXPECT_EQ(architecture_faults("gpu/raster/Clip.cpp", "").size(), 1u);
  EXPECT_EQ(architecture_faults("gpu/raster/clipPolygon.cpp", "").size(), 1u);
  EXPECT_EQ(architecture_faults("gpu/rasters/clip.cpp", "").size(), 1u);
  EXPECT_EQ(architecture_faults("geometry/mesh.h", "int a;\n"), Faults{"has no #pragma once"});
}

}  // namespace
}  // namespace parity
