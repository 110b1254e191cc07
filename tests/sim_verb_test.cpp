#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "sim/scene_io.h"
#include "tests/gpu_context.h"
#include "tests/temporary_folder.h"
#include "tools/sim_checkpoint.h"
#include "tools/sim_job.h"

namespace parity {
namespace {

using nlohmann::json;
using tools::Checkpoint;
using tools::SimJob;

constexpr const char* small_dam = R"({
  "parity_sim": 1, "method": "wcsph", "resolution": 24, "duration": 0.1,
  "frames_per_second": 50,
  "domain": {"size": [1, 0.5], "sides": {"top": "open"}},
  "liquid": [{"box": {"min": [0, 0], "max": [0.3, 0.4]}}],
  "picture": {"size": [96, 54], "samples": 1}, "output": ["png", "ply", "vtk"]})";

constexpr const char* small_smoke = R"({
  "parity_sim": 1, "method": "grid", "resolution": 10, "duration": 0.06, "frames_per_second": 50,
  "domain": {"size": [1, 1], "sides": {"top": "open"}},
  "sources": [{"sphere": {"center": [0.55, 0.25], "radius": 0.15}, "temperature": 200}],
  "solids": [{"sphere": {"center": [0.5, 0.7], "radius": 0.12}}],
  "picture": {"size": [64, 64]}, "output": ["png", "vtk"]})";

constexpr const char* small_splash = R"({
  "parity_sim": 1, "method": "flip", "resolution": 10, "duration": 0.06, "frames_per_second": 50,
  "domain": {"size": [1, 0.5]}, "liquid": [{"box": {"min": [0, 0], "max": [0.25, 0.4]}}],
  "picture": {"size": [64, 36], "samples": 1}})";

std::string bytes_of(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path, std::size_t(1) << 30);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Runs on the device (or, for backend "cpu", the reference) into a folder below `root`.
int run(const TemporaryFolder& root, const std::string& name, SimScene scene, SimJob job) {
  job.folder = (root.path() / name).string();
  job.input = "small.json";
  job.quiet = true;
  job.checkpoint_seconds = 0;
  return tools::run_sim_job(job, scene, job.backend == "cpu" ? nullptr : &test_context());
}

Checkpoint checkpoint_of(const std::filesystem::path& folder) {
  return tools::decode_checkpoint(bytes_of(folder / "checkpoint.bin"), "checkpoint.bin");
}

/// Everything in two folders but the seconds that the runs took.
void expect_equal_runs(const std::filesystem::path& a, const std::filesystem::path& b) {
  Checkpoint first = checkpoint_of(a), second = checkpoint_of(b);
  first.seconds = second.seconds = 0;
  EXPECT_EQ(first, second);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(a)) {
    const std::filesystem::path name = entry.path().filename();
    if (name == "checkpoint.bin" || name == "metrics.json") continue;
    EXPECT_EQ(bytes_of(entry.path()), bytes_of(b / name)) << name;
    ++count;
  }
  EXPECT_GT(count, 0u);
  const json m = json::parse(bytes_of(a / "metrics.json"));
  const json n = json::parse(bytes_of(b / "metrics.json"));
  EXPECT_EQ(m["frames"], n["frames"]);
  EXPECT_EQ(m["steps"], n["steps"]);
  EXPECT_EQ(m.value("refused_steps", 0), n.value("refused_steps", 0));
}

void expect_resumes(const std::string& backend, const SimScene& scene) {
  const TemporaryFolder root;
  ASSERT_EQ(run(root, "whole", scene, {.backend = backend}), 0);
  int asked = 0;
  EXPECT_EQ(
      run(root, "cut", scene, {.backend = backend, .is_interrupted = [&] { return ++asked > 3; }}),
      130);
  EXPECT_FALSE(json::parse(bytes_of(root.path() / "cut/metrics.json"))["finished"]);
  EXPECT_EQ(run(root, "cut", scene, {.backend = backend, .resume = true}), 0);
  expect_equal_runs(root.path() / "whole", root.path() / "cut");
  SimScene shorter = scene;
  shorter.duration = 0.04;
  EXPECT_EQ(run(root, "longer", shorter, {.backend = backend}), 0);
  EXPECT_EQ(run(root, "longer", scene, {.backend = backend, .resume = true}), 0);
  expect_equal_runs(root.path() / "whole", root.path() / "longer");
}

TEST(SimVerb, ResumedParticlesGoOnToTheSameBits) {
  const SimScene scene = decode_sim_scene(small_dam, "small.json");
  expect_resumes("gpu", scene);
  expect_resumes("cpu", scene);
}

TEST(SimVerb, ResumedGridsGoOnToTheSameBits) {
  for (const char* text : {small_smoke, small_splash})
    for (const bool sparse : {false, true}) {
      SimScene scene = decode_sim_scene(text, "small.json");
      scene.solver.sparse = sparse;
      expect_resumes("gpu", scene);
      expect_resumes("cpu", scene);
    }
}

TEST(SimVerb, ResumedStepsByErrorGoOnToTheSameBits) {
  SimScene scene = decode_sim_scene(small_smoke, "small.json");
  scene.solver.error = 3e-3;
  expect_resumes("gpu", scene);
  expect_resumes("cpu", scene);
}

TEST(SimVerb, SmokeComesOutOfItsSourceAndLiquidKeepsItsMass) {
  const TemporaryFolder root;
  for (const char* text : {small_smoke, small_splash}) {
    ASSERT_EQ(run(root, "out", decode_sim_scene(text, "small.json"), {.frames = ivec2(9, 9)}), 0);
    const json frames = json::parse(bytes_of(root.path() / "out/metrics.json"))["frames"];
    const double first = frames.front()["mass_kg"], last = frames.back()["mass_kg"];
    // The ball of the source in cells of 1/10 m, a slab one cell thick; all of the liquid.
    const double least = text == small_smoke ? 0.8 * 3.14159 * 0.15 * 0.15 / 10 : first;
    EXPECT_GE(last, least);
    EXPECT_TRUE(text == small_smoke || last == first);
    EXPECT_GT(frames.back()["kinetic_energy_j"], 0.0);
  }
}

/// A column whose lattice ends 0.2 spacings from the wall, were nothing left out.
TEST(SimVerb, NoParticleStartsPressedAgainstAWall) {
  const TemporaryFolder root;
  for (const std::string method : {"wcsph", "dfsph"}) {
    std::string text = small_dam;
    text.replace(text.find("wcsph"), 5, method);
    const std::string column = "\"min\": [0, 0], \"max\": [0.3";
    text.replace(text.find(column), column.size(), "\"min\": [0.68, 0], \"max\": [1");
    const SimScene scene = decode_sim_scene(text, "small.json");
    ASSERT_EQ(run(root, method, scene, {.frames = ivec2(9, 9)}), 0);
    const json frames = json::parse(bytes_of(root.path() / method / "metrics.json"))["frames"];
    const auto energy = [&](std::size_t k) {
      return double(frames[k]["kinetic_energy_j"]) + double(frames[k]["potential_energy_j"]);
    };
    // Friction takes more than what compression the method allows gives.
    EXPECT_LE(energy(frames.size() - 1), energy(0)) << method;
  }
}

TEST(SimVerb, WritesWhatTheSceneAsksFor) {
  const TemporaryFolder root;
  SimScene scene = decode_sim_scene(small_dam, "small.json");
  ASSERT_EQ(run(root, "out", scene, {.frames = ivec2(2, 4)}), 0);
  const std::filesystem::path folder = root.path() / "out";
  for (const char* name : {"frame_", "particles_"})
    for (int frame = 0; frame <= 5; ++frame)
      EXPECT_EQ(std::filesystem::exists(folder / (name + ("000" + std::to_string(frame)) +
                                                  (*name == 'f' ? ".png" : ".vtp"))),
                frame >= 2 && frame <= 4);
  const Grid<vec4> picture = load_image(folder / "frame_0003.png");
  EXPECT_EQ(picture.width(), 96);
  const json metrics = json::parse(bytes_of(folder / "metrics.json"));
  EXPECT_EQ(metrics["schema"], "parity.sim");
  EXPECT_EQ(metrics["frames"].size(), 6u);
  EXPECT_TRUE(metrics["finished"]);
  const json& first = metrics["frames"].front();
  const json& last = metrics["frames"].back();
  EXPECT_EQ(first["mass_kg"], last["mass_kg"]);  // particles neither come nor go
  EXPECT_NEAR(last["time_s"], 0.1, 1e-9);
  EXPECT_GT(last["kinetic_energy_j"], 0.0);
}

TEST(SimVerb, AHostileStateIsRefused) {
  const TemporaryFolder root;
  const SimScene scene = decode_sim_scene(small_dam, "small.json");
  ASSERT_EQ(run(root, "out", scene, {.frames = ivec2(9, 9)}), 0);
  const std::filesystem::path path = root.path() / "out/checkpoint.bin";
  const Checkpoint good = checkpoint_of(root.path() / "out");
  std::vector<std::string> states{"", good.state.substr(0, good.state.size() - 1),
                                  good.state + "x"};
  std::string wrong = good.state;
  wrong[8] = char(wrong[8] + 1);  // another count of positions
  states.push_back(wrong);
  wrong = good.state;
  for (std::size_t i = 16; i < 20; ++i) wrong[i] = char(0xff);  // a position that is NaN
  states.push_back(wrong);
  wrong = good.state;
  for (std::size_t i = 0; i < 8; ++i) wrong[i] = char(0xff);  // a time that is NaN
  states.push_back(wrong);
  for (const std::string& state : states) {
    Checkpoint hostile = good;
    hostile.state = state;
    tools::save_checkpoint(path, hostile);
    EXPECT_THROW(run(root, "out", scene, {.resume = true}), InputError);
  }
}

/// Runs a shell line in a folder; its exit code, and what it says on stderr.
std::pair<int, std::string> shell(const TemporaryFolder& folder, const std::string& line) {
  const std::string command = "cd '" + folder.path().string() + "' && ( " + line + " ) 2>&1 >&-";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  std::string output;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), count);
  return {WEXITSTATUS(::pclose(pipe)), output};
}

const std::string program = "'" PARITY_PROGRAM "' sim ";

TEST(SimVerb, WrongUsageIsOneLineAndExitCode2) {
  const TemporaryFolder folder;
  folder.write("small.json", std::string(small_dam));
  std::string bad = small_dam;
  bad.replace(bad.find("wcsph"), 5, "magic");
  folder.write("bad.json", bad);
  std::string thin = small_dam;
  thin.replace(thin.find("\"max\": [0.3"), 11, "\"max\": [0.001");
  folder.write("thin.json", thin);
  const std::string good = program + "small.json -o out --backend cpu ";
  for (const std::string& line :
       {program + "none.json -o out", program + "bad.json -o out", program + "thin.json -o out",
        program + "small.json", good + "--resume", good + "--frames 3", good + "--formats gif",
        good + "--size 0x7", good + "--device 0", good + "--duration nan",
        good + "--checkpoint-seconds nan"}) {
    const auto [code, output] = shell(folder, line);
    EXPECT_EQ(code, 2) << line << ": " << output;
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
    EXPECT_TRUE(output.starts_with("parity: ")) << output;
  }
  EXPECT_EQ(shell(folder, program + "small.json --dry-run").first, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/frame_0000.png"));
}

TEST(SimVerb, AnInterruptLeavesACheckpointAndExitCode130) {
  const TemporaryFolder folder;
  folder.write("small.json", std::string(small_dam));
  const auto [code, output] = shell(
      folder,
      program +
          "small.json -o out --backend cpu --duration 1000 -q & pid=$!; "
          "while [ ! -e out/frame_0000.png ]; do sleep 0.02; done; kill -INT $pid; wait $pid");
  EXPECT_EQ(code, 130) << output;
  EXPECT_NO_THROW(checkpoint_of(folder.path() / "out"));
}

TEST(SimVerb, AFullDiskKeepsWhatIsThere) {
  const TemporaryFolder folder;
  folder.write("small.json", std::string(small_dam));
  ASSERT_EQ(shell(folder, program + "small.json -o out --backend cpu --duration 0.02 -q").first, 0);
  const Checkpoint before = checkpoint_of(folder.path() / "out");
  const auto [code, output] = shell(folder, "trap '' XFSZ; ulimit -f 1; " + program +
                                                "small.json -o out --backend cpu --resume -q");
  EXPECT_EQ(code, 5) << output;
  EXPECT_EQ(checkpoint_of(folder.path() / "out"), before);
  EXPECT_EQ(shell(folder, program + "small.json -o out --backend cpu --resume -q").first, 0);
}

}  // namespace
}  // namespace parity
