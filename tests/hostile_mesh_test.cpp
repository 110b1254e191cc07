#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "geometry/mesh_io.h"
#include "geometry/mesh_measure.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

struct Verdict {
  std::string file, expect, what_is_wrong;
};

/// The hostile files with one of these endings and what must become of them.
std::vector<Verdict> verdicts(std::initializer_list<const char*> endings) {
  std::ifstream stream(*shared_data("hostile/hostile.json"));
  std::vector<Verdict> list;
  for (const nlohmann::json& entry : nlohmann::json::parse(stream)) {
    const std::string file = entry.at("file");
    for (const char* ending : endings)
      if (file.ends_with(ending)) list.push_back({file, entry.at("expect"), entry.at("wrong")});
  }
  return list;
}

/// Runs `load`, which gives whether it has noted something, and compares with the verdict.
template <typename Load>
void expect_verdict(const Verdict& verdict, Load load) {
  SCOPED_TRACE(verdict.file + ": " + verdict.what_is_wrong);
  try {
    const bool has_notes = load(*shared_data(verdict.file));
    EXPECT_NE(verdict.expect, "reject");
    EXPECT_TRUE(verdict.expect == "bound" || has_notes == (verdict.expect == "drop"));
  } catch (const InputError& error) {
    EXPECT_TRUE(verdict.expect == "reject" || verdict.expect == "bound") << error.what();
    EXPECT_NE(std::string(error.what()).find(verdict.file), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(HostileMesh, EveryFileGetsItsVerdict) {
  if (!shared_data("hostile/hostile.json")) GTEST_SKIP() << "skipped: no shared data";
  for (const Verdict& verdict : verdicts({".obj", ".ply", ".stl", ".off"}))
    expect_verdict(verdict, [](const std::filesystem::path& path) {
      const Mesh mesh = load_mesh(path);
      const MeshReport report = measure(mesh);
      refuse_crowded_edges(report, path.string());
      return !mesh.notes.empty() || report.nonmanifold_vertices > 0;
    });
}

TEST(HostileImage, EveryFileGetsItsVerdict) {
  if (!shared_data("hostile/hostile.json")) GTEST_SKIP() << "skipped: no shared data";
  for (const Verdict& verdict : verdicts({".png", ".jpg", ".hdr", ".exr"}))
    expect_verdict(verdict, [](const std::filesystem::path& path) {
      load_image(path);
      return false;
    });
}

}  // namespace
}  // namespace parity
