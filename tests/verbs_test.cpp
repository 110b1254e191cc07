#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "cpu_reference/sampling/reconstruct.h"
#include "geometry/atomic_file.h"
#include "geometry/image_io.h"

namespace parity {
namespace {

struct Answer {
  int exit_code = -1;
  std::string output;
};

/// Runs the program in a folder of its own, which goes with its files at the end.
class Verbs : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// @param arguments  as a shell takes them; `redirection` says what becomes of the streams.
  Answer run(const std::string& arguments, const std::string& redirection) const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" PARITY_PROGRAM "' " + arguments + " " + redirection;
    Answer answer;
    FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
      answer.output.append(buffer.data(), count);
    answer.exit_code = WEXITSTATUS(::pclose(pipe));
    return answer;
  }
  Answer run_for_output(const std::string& arguments) const { return run(arguments, "2>&-"); }
  Answer run_for_errors(const std::string& arguments) const { return run(arguments, "2>&1 >&-"); }

  void expect_one_line(const std::string& arguments, int exit_code) const {
    const Answer answer = run_for_errors(arguments);
    EXPECT_EQ(answer.exit_code, exit_code) << arguments;
    EXPECT_TRUE(answer.output.starts_with("parity: ")) << answer.output;
    EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1) << answer.output;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("parity_verbs_" + std::to_string(::getpid()));
};

TEST_F(Verbs, SpectrumFindsTheAliasOfAGrating) {
  for (const char* backend : {"cpu", "gpu"}) {
    const Answer answer = run_for_output("spectrum --grating 0.8,1.1 --size 96 --json --backend " +
                                         std::string(backend));
    EXPECT_EQ(answer.exit_code, 0);
    const nlohmann::json json = nlohmann::json::parse(answer.output);
    ASSERT_EQ(json.at("peaks").size(), 1u) << backend;
    const nlohmann::json& f = json.at("peaks")[0].at("frequency");
    EXPECT_NEAR(f[0].get<double>(), 0.2, 0.02 / 96);
    EXPECT_NEAR(f[1].get<double>(), -0.1, 0.02 / 96);
  }
  EXPECT_NE(run_for_output("spectrum --grating 0.8,0").output.find("looks like (0.2, 0)"),
            std::string::npos);
}

TEST_F(Verbs, SpectrumSaysWhatItCanAndNoMore) {
  const std::string half = run_for_output("spectrum --grating 0.5,0 --size 64").output;
  EXPECT_NE(half.find("looks like (0.5, 0), as strong or faint as its phase has it"),
            std::string::npos);
  EXPECT_NE(half.find("no frequency but 0"), std::string::npos) << "samples fall on its zeros";
  const std::string none = run_for_output("spectrum --grating 0.3,0 --size 64 --peaks 0").output;
  EXPECT_EQ(none.find("no frequency"), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(
      run_for_output("spectrum --grating 0.75,1.25 --size 64 --scale 2 --json").output);
  // Half of these a pixel after scaling.
  EXPECT_EQ(json.at("grating"), (nlohmann::json{0.375, 0.625}));
  EXPECT_EQ(json.at("looks_like"), (nlohmann::json{0.375, -0.375}));
}

TEST_F(Verbs, NoNumberIsRefusedWhereverOneIsAsked) {
  const std::string scene = "'" PARITY_SOURCE_DIR "/assets/demo.glb'";
  for (const std::string value : {"nan", "-nan", "inf", "1e999", "x"}) {
    expect_one_line("render " + scene + " -o a.png --exposure " + value, 2);
    expect_one_line("render " + scene + " -o a.png --aa auto --max-error " + value, 2);
    expect_one_line("diff a.png a.png --max-error " + value, 2);
    expect_one_line("diff a.png a.png --pixels-per-degree " + value, 2);
    expect_one_line("check nothing --timeout " + value, 2);
  }
  expect_one_line("render " + scene + " -o a.png --backend cpu --device 0", 2);
  expect_one_line("render", 2);
  expect_one_line("render " + scene + " --no-such-option", 2);
}

TEST_F(Verbs, RenderSaysHowManySamplesItTook) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write_file_atomically(file("a.obj"), std::as_bytes(std::span(text)));
  const std::string scene = "render a.obj --size 16x16 -o a.png ";
  const std::array<std::pair<const char*, int>, 6> modes{{{"--backend cpu", 4},
                                                          {"--backend cpu --msaa 8", 8},
                                                          {"--backend cpu --aa none", 1},
                                                          {"--backend cpu --aa ssaa9", 9},
                                                          {"--backend cpu --aa accumulate3", 3},
                                                          {"--aa adaptive", 16}}};
  for (const auto& [mode, samples] : modes) {
    ASSERT_EQ(run_for_output(scene + mode + " --metrics m.json").exit_code, 0) << mode;
    std::ifstream metrics(file("m.json"));
    EXPECT_EQ(nlohmann::json::parse(metrics).at("samples"), samples) << mode;
  }
  EXPECT_NE(run_for_errors(scene + "-v --backend cpu --aa none").output.find(" 1 samples"),
            std::string::npos);
}

TEST_F(Verbs, SpectrumShowsThatAFilterTakesAwayWhatWouldAlias) {
  const auto strongest = [&](const std::string& filter) {
    const Answer answer = run_for_output(
        "spectrum --grating 0.075,0.0125 --size 640 --scale 0.125 --json --filter " + filter);
    const nlohmann::json peaks = nlohmann::json::parse(answer.output).at("peaks");
    return peaks.empty() ? 0.0 : peaks[0].at("amplitude").get<double>();
  };
  // 0.6 cycles a new pixel look like 0.4, whatever filter was there; it leaves what its spectrum
  // does at 0.6, and at 8 - 0.6, as it is sampled at 8 texels a new pixel: there at most
  // 1 / (7.4 pi)^2.
  EXPECT_NEAR(strongest("none"), 0.5, 0.5 * 3 * std::exp(-8.0));
  for (const ReconstructionFilter filter :
       {ReconstructionFilter::tent, ReconstructionFilter::lanczos})
    EXPECT_NEAR(
        strongest(name_of(filter)),
        0.5 * std::abs(cpu::filter_spectrum(filter, 0.6) * cpu::filter_spectrum(filter, 0.1)),
        0.5 / 50)
        << name_of(filter);
}

TEST_F(Verbs, SpectrumDrawsThePictureBesideItsSpectrum) {
  EXPECT_EQ(run_for_output("spectrum --zone-plate 0.75 --size 64 -o s.png").exit_code, 0);
  const Grid<vec4> sheet = load_image(file("s.png"));
  EXPECT_EQ(sheet.width(), 2 * 64 + 8);
  EXPECT_EQ(sheet.height(), 64);
  EXPECT_EQ(run_for_output("spectrum s.png --scale 0.4 --filter box").exit_code, 0);
}

TEST_F(Verbs, SpectrumRefusesInOneLine) {
  expect_one_line("spectrum", 2);
  expect_one_line("spectrum --grating 1", 2);
  expect_one_line("spectrum --grating nan,0", 2);
  expect_one_line("spectrum --grating 1,0 --zone-plate 1", 2);
  expect_one_line("spectrum missing.png", 2);
  expect_one_line("spectrum --zone-plate 1 -o s.jpg", 2);
  expect_one_line("spectrum --zone-plate 1 --size 4096 --scale 2", 2);
  expect_one_line("spectrum --zone-plate 1 -o missing/s.png", 5);
  expect_one_line("spectrum --zone-plate nan", 2);
  expect_one_line("spectrum --zone-plate 1 --scale nan", 2);
  expect_one_line("spectrum --zone-plate 1 --filter box", 2);
  expect_one_line("spectrum s.png --size 64", 2);
  expect_one_line("spectrum --zone-plate 1 --backend cpu --device 0", 2);
}

TEST_F(Verbs, DiffMeasuresAndJudges) {
  Grid<vec4> a{12, 9, vec4(0.5f, 0.5f, 0.5f, 1.0f)}, b = a;
  b(7, 3).y += 0.25f;
  save_image(file("a.pfm"), a, {});
  save_image(file("b.pfm"), b, {});
  EXPECT_EQ(run_for_output("diff a.pfm a.pfm --max-error 0 --metric max").exit_code, 0);
  EXPECT_EQ(run_for_output("diff a.pfm b.pfm --max-error 0.25 --metric max").exit_code, 0);
  EXPECT_EQ(run_for_output("diff a.pfm b.pfm --max-error 0.2499 --metric max").exit_code, 1);
  EXPECT_EQ(run_for_output("diff a.pfm b.pfm --max-error 60 --metric psnr").exit_code, 1);
  const Answer answer = run_for_output("diff a.pfm b.pfm --json -o error.png");
  EXPECT_EQ(answer.exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json.at("max"), 0.25);
  EXPECT_EQ(json.at("max_at"), nlohmann::json::array({7, 3}));
  EXPECT_EQ(json.at("mse"), 0.0625 / (3 * 12 * 9));
  EXPECT_EQ(json.at("values"), "linear");
  EXPECT_EQ(load_image(file("error.png")).width(), 12);
}

TEST_F(Verbs, DiffRefusesWithTheCodeThatBelongs) {
  save_image(file("a.png"), Grid<vec4>{4, 4}, {});
  save_image(file("b.png"), Grid<vec4>{5, 4}, {});
  write_file_atomically(file("text.png"), "no picture");
  expect_one_line("diff a.png b.png", 2);
  expect_one_line("diff a.png missing.png", 2);
  expect_one_line("diff a.png text.png", 2);
  expect_one_line("diff a.png a.png -o a.png", 2);
  expect_one_line("diff a.png a.png -o error.tga", 2);
  expect_one_line("diff a.png a.png -o none/error.png", 5);
  EXPECT_EQ(run_for_errors("diff a.png").exit_code, 2);
  EXPECT_EQ(run_for_errors("diff a.png a.png --metric taste").exit_code, 2);
  EXPECT_EQ(load_image(file("a.png")).width(), 4);
}

TEST_F(Verbs, MeshInfoSaysWhatAMeshIs) {
  write_file_atomically(file("square.obj"), "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n");
  const Answer answer = run_for_output("mesh info --json square.obj");
  EXPECT_EQ(answer.exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json.at("vertices"), 4);
  EXPECT_EQ(json.at("quads"), 1);
  EXPECT_EQ(json.at("genus"), 0);
  EXPECT_EQ(json.at("boundary_loops"), 1);
  EXPECT_EQ(json.at("area_m2"), 4.0);
  EXPECT_EQ(json.at("max_m"), nlohmann::json::array({2.0, 2.0, 0.0}));
  EXPECT_TRUE(json.at("volume_m3").is_null());
}

TEST_F(Verbs, MeshInfoWarnsAndRefuses) {
  const std::string fan =
      "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\n"
      "f 1 2 3\nf 1 2 4\nf 1 2 5\n";
  write_file_atomically(file("fan.obj"), fan);
  write_file_atomically(file("book.obj"), fan + "f 1 2 6\nf 1 2 7\n");
  expect_one_line("mesh info fan.obj", 0);
  expect_one_line("mesh info book.obj", 2);
  expect_one_line("mesh info missing.obj", 2);
  EXPECT_EQ(run_for_output("mesh info book.obj").output, "");
  EXPECT_EQ(run_for_errors("mesh").exit_code, 2);
}

}  // namespace
}  // namespace parity
