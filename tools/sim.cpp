#include <omp.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "geometry/input_error.h"
#include "gpu/core/context.h"
#include "sim/scene_io.h"
#include "tools/bad_option.h"
#include "tools/options.h"
#include "tools/sim_job.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct SimArguments {
  std::string input;
  std::string output;
  std::string backend = "gpu";
  std::string device;
  std::string frames;
  std::string formats;
  std::string size;
  double duration = 0;
  double checkpoint_seconds = 20;
  int resolution = 0;
  int threads = 0;
  bool resume = false;
  bool video = false;
  bool dry_run = false;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

ivec2 parse_pair(const char* option, const std::string& text, const char* form, int least, int most,
                 const char* expected) {
  ivec2 pair{0};
  char rest = 0;
  if (std::sscanf(text.c_str(), form, &pair.x, &pair.y, &rest) != 2 || pair.x < least ||
      pair.y < least || pair.x > most || pair.y > most)
    throw bad_option(option, text, expected);
  return pair;
}

SimOutput parse_formats(const std::string& text) {
  SimOutput output{.png = false};
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    if (name == "png")
      output.png = true;
    else if (name == "ply")
      output.ply = true;
    else if (name == "vtk")
      output.vtk = true;
    else if (name != "none")
      throw bad_option("formats", text, "of png, ply, vtk with commas between, or none");
    begin = end + 1;
  }
  return output;
}

/// The scene as the command line changes it.
SimScene scene_of(const SimArguments& a) {
  SimScene scene = load_sim_scene(a.input);
  if (a.duration > 0) scene.duration = a.duration;
  if (!a.size.empty())
    scene.picture.size = parse_pair("size", a.size, "%dx%d%c", 16, 8192, "from 16x16 to 8192x8192");
  if (!a.formats.empty()) scene.output = parse_formats(a.formats);
  if (a.resolution > 0) set_resolution(scene, a.resolution);
  if (const std::string fault = scene_fault(scene); !fault.empty())
    throw std::invalid_argument(a.input + ": " + fault);
  return scene;
}

int dry_run(const SimArguments& a, const SimScene& scene) {
  const ivec3 cells = cells_of(scene);
  std::printf("%s: fine, method %s, %d x %d x %d cells of %g m, %d frames in %g s\n",
              a.input.c_str(), name_of(scene.method), cells.x, cells.y, cells.z, scene.spacing,
              frame_count(scene) + 1, scene.duration);
  return 0;
}

volatile std::sig_atomic_t interrupted = 0;
extern "C" void note_interrupt(int) { interrupted = 1; }

int sim(const SimArguments& a) {
  check_device(a.backend, a.device);
  const SimScene scene = scene_of(a);
  SimJob job{.input = a.input,
             .folder = a.output,
             .backend = a.backend,
             .resume = a.resume,
             .video = a.video,
             .quiet = a.quiet,
             .verbose = a.verbose,
             .json = a.json,
             .checkpoint_seconds = a.checkpoint_seconds,
             .is_interrupted = [] { return interrupted != 0; }};
  if (!a.frames.empty())
    job.frames = parse_pair("frames", a.frames, "%d-%d%c", 0, max_sim_frames, "FIRST-LAST");
  if (a.dry_run) return dry_run(a, scene);
  if (a.output.empty()) throw std::invalid_argument("sim: -o DIR is missing");
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  std::optional<gpu::Context> context;
  if (a.backend == "gpu") context.emplace(gpu::ContextOptions{.device = a.device});
  return run_sim_job(job, scene, context ? &*context : nullptr);
}

}  // namespace

void add_sim_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("sim", "Simulate a fluid and draw it, without a window");
  auto a = std::make_shared<SimArguments>();
  verb->add_option("input", a->input, "Scene (.json, see docs/simulation.md)")->required();
  verb->add_option("-o,--output", a->output,
                   "Folder for frame_####.png, metrics.json, checkpoint.bin and other files");
  verb->add_option("--duration", a->duration, "Seconds to simulate, instead of the scene's")
      ->check(within(1e-6, 1e6));
  verb->add_option("--resolution", a->resolution,
                   "Cells or particles along the longest side, instead of the scene's")
      ->check(CLI::Range(2, 4096));
  verb->add_option("--size", a->size, "WIDTHxHEIGHT of pictures in pixels");
  verb->add_option("--frames", a->frames, "FIRST-LAST: write only these frames");
  verb->add_option("--formats", a->formats,
                   "What to write for each frame: png, ply, vtk (with commas between) or none");
  verb->add_option("--backend", a->backend, "gpu: Vulkan; cpu: the reference alone")
      ->check(CLI::IsMember({"gpu", "cpu"}))
      ->capture_default_str();
  verb->add_option("--device", a->device,
                   "Vulkan device: number or part of its name (see parity devices)");
  verb->add_option("--threads", a->threads, "Threads of the CPU reference (default: all)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--checkpoint-seconds", a->checkpoint_seconds,
                   "Write a checkpoint after a frame when the last one is that old")
      ->check(within(0, 1e6))
      ->capture_default_str();
  verb->add_flag("--resume", a->resume, "Go on from the folder's checkpoint, to the same bits");
  verb->add_flag("--video", a->video, "Make video.mp4 of the frames (needs ffmpeg)");
  verb->add_flag("--dry-run", a->dry_run, "Load and check the scene, simulate nothing");
  verb->add_flag("--json", a->json, "Print metrics.json on stdout at the end");
  verb->add_flag("-q,--quiet", a->quiet, "No notes, no progress");
  verb->add_flag("-v,--verbose", a->verbose, "Say what was done");
  verb->footer(
      "Examples:\n"
      "  parity sim assets/sim/dam_break.json -o dam --video\n"
      "  parity sim assets/sim/smoke_plume.json -o smoke --resolution 64 --duration 2\n"
      "  parity sim assets/sim/dam_break.json -o dam --resume --duration 3\n"
      "  parity sim assets/sim/taylor_green.json -o tg --formats png,vtk --backend cpu\n"
      "Ctrl-C leaves a checkpoint; --resume goes on from it.");
  verb->callback([a, &exit_code] {
    if (a->threads > 0) omp_set_num_threads(a->threads);
    exit_code = sim(*a);
  });
}

}  // namespace parity::tools
