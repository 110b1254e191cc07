#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/gltf_files.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "geometry/scene_io.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool is_picture(const fs::path& file) { return file.extension() == ".png"; }
bool is_scene(const fs::path& file) {
  return file.extension() == ".gltf" || file.extension() == ".glb";
}

/// What came of a file: "ok", "drop" (loaded, with notes) or "reject", and the message.
struct Verdict {
  std::string word;
  std::string message;
};

Verdict judge(const fs::path& file) {
  try {
    if (is_picture(file)) {
      decode_image(gltf::read_file(file, 1 << 20), file.string());
      return {"ok", ""};
    }
    const Scene scene = load_scene(file);
    return {scene.notes.empty() ? "ok" : "drop", ""};
  } catch (const InputError& error) {
    return {"reject", error.what()};
  }
}

/// An extension that is not supported is optional: a note is as good as silence.
bool fulfils(const std::string& expected, const std::string& got) {
  if (expected == "bound") return true;
  if (expected == "ok") return got != "reject";
  return expected == got;
}

template <typename Test>
void for_each_hostile_file(Test test) {
  const auto list = shared_data("hostile/hostile.json");
  if (!list) GTEST_SKIP() << "skipped: no shared data";
  std::ifstream in(*list);
  int seen = 0;
  for (const json& entry : json::parse(in)) {
    const fs::path file = list->parent_path().parent_path() / entry["file"].get<std::string>();
    if (!is_scene(file) && !is_picture(file)) continue;
    SCOPED_TRACE(file.filename().string() + ": " + entry["wrong"].get<std::string>());
    test(file, entry["expect"].get<std::string>());
    ++seen;
  }
  EXPECT_GT(seen, 70);
}

TEST(HostileScenes, GetTheVerdictOfTheManifest) {
  for_each_hostile_file([](const fs::path& file, const std::string& expected) {
    const Verdict verdict = judge(file);
    EXPECT_TRUE(fulfils(expected, verdict.word))
        << "expected " << expected << ", got " << verdict.word << " " << verdict.message;
  });
}

TEST(HostileScenes, AreRefusedInOneLineThatNamesTheFile) {
  for_each_hostile_file([](const fs::path& file, const std::string&) {
    const std::string message = judge(file).message;
    if (message.empty()) return;
    EXPECT_TRUE(message.starts_with(file.string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), file.string().size() + 400) << message;
  });
}

TEST(HostileScenes, NameTheExtensionThatIsRequired) {
  const auto file = shared_data("hostile/ext_required_unknown.gltf");
  if (!file) GTEST_SKIP() << "skipped: no shared data";
  EXPECT_NE(judge(*file).message.find("ACME_warp"), std::string::npos);
}

TEST(HostileScenes, ASparseAccessorMovesVertexTwo) {
  const auto file = shared_data("hostile/sparse_valid.gltf");
  if (!file) GTEST_SKIP() << "skipped: no shared data";
  EXPECT_EQ(load_scene(*file).meshes.at(0).primitives.at(0).positions.at(2), vec3(2, 2, 0));
}

TEST(HostileScenes, QuantizedPositionsAreThoseOfTheControl) {
  const auto control = shared_data("hostile/control_quad.gltf");
  const auto quantized = shared_data("hostile/quantized_valid.gltf");
  if (!control || !quantized) GTEST_SKIP() << "skipped: no shared data";
  EXPECT_EQ(load_scene(*control).meshes.at(0).primitives.at(0).positions,
            load_scene(*quantized).meshes.at(0).primitives.at(0).positions);
}

#ifndef __SANITIZE_ADDRESS__  // which reserves terabytes of addresses

std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

/// Judges a file in a process that may take 1 GiB more than this one and 10 s. True: it ended by
/// itself, in order.
bool survives_in_bounds(const fs::path& file) {
  const std::size_t limit = address_space() + (std::size_t(1) << 30);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit bound{limit, limit};
    ::setrlimit(RLIMIT_AS, &bound);
    ::alarm(10);
    try {
      judge(file);
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(HostileScenes, TakeNoMoreThanOneGibibyteAndTenSeconds) {
  for_each_hostile_file(
      [](const fs::path& file, const std::string&) { EXPECT_TRUE(survives_in_bounds(file)); });
}

#endif

}  // namespace
}  // namespace parity
