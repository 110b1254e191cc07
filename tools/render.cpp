#include <omp.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "geometry/frame.h"
#include "geometry/image_io.h"
#include "geometry/scene_io.h"
#include "tools/options.h"
#include "tools/render_job.h"
#include "tools/render_options.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

/// A pixel, at most.
int samples_of(const Job& job, const FrameOptions& options) {
  return job.aa.empty() ? options.samples : parse_antialiasing(job.aa).samples;
}

nlohmann::json metrics(const RenderArguments& arguments, const Frame& frame, const Job& job,
                       double load_seconds) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  nlohmann::json passes = nlohmann::json::array();
  for (const auto& [name, seconds] : job.picture.pass_seconds)
    passes.push_back({{"name", name}, {"time_ms", seconds * 1e3}});
  nlohmann::json trials = nlohmann::json::array();
  for (const AntialiasingTrial& trial : job.trials)
    trials.push_back(
        {{"mode", trial.mode}, {"flip", trial.error}, {"time_ms", trial.seconds * 1e3}});
  return {
      {"schema", "parity.render"},
      {"version", 1},
      {"input", arguments.input},
      {"backend", arguments.backend},
      {"device", job.device},
      {"width", frame.options.width},
      {"height", frame.options.height},
      {"samples", samples_of(job, frame.options)},
      {"antialiasing", job.aa.empty() ? "msaa" + std::to_string(frame.options.samples) : job.aa},
      {"antialiasing_trials", trials},
      {"triangles", job.picture.triangle_count},
      {"draws", frame.draws.size()},
      {"lights", frame.lights.size()},
      {"load_ms", load_seconds * 1e3},
      {"render_ms", job.seconds * 1e3},
      {"passes", passes},
      {"device_memory_bytes", job.picture.memory_bytes},
      {"peak_process_bytes", std::uint64_t(usage.ru_maxrss) * 1024}};
}

/// What --aa auto chose and why, in one line.
void say_choice(const RenderArguments& arguments, const Job& job) {
  if (job.trials.empty()) return;
  std::string tried;
  for (const AntialiasingTrial& trial : job.trials) {
    char text[96];
    std::snprintf(text, sizeof text, "%s%s FLIP %.4f %.0f ms", tried.empty() ? "" : ", ",
                  trial.mode.c_str(), trial.error, trial.seconds * 1e3);
    tried += text;
  }
  std::fprintf(stderr, "parity: --aa auto, FLIP at most %g: %s (%s)\n", *arguments.max_error,
               job.meets ? job.aa.c_str() : "no mode meets it", tried.c_str());
}

void save(const RenderArguments& arguments, const Job& job) {
  if (!job.display.empty()) {
    save_png(arguments.output, job.display);
    return;
  }
  Grid<vec4> color = straight_alpha(job.picture.color);
  const float gain = std::exp2(float(arguments.exposure));
  for (vec4& c : color) c = vec4(vec3(c) * gain, c.w);
  save_image(arguments.output, color,
             {.attributes = {{"device", job.device}, {"software", "Parity " PARITY_VERSION}}});
}

int render(const RenderArguments& arguments) {
  check_output(arguments);
  antialiasing(arguments);
  check_device(arguments.backend, arguments.device);
  const bool display = std::filesystem::path(arguments.output).extension() == ".png";
  const ivec2 size = parse_size(arguments.size);
  const vec4 background = parse_background(arguments.background);
  FrameOptions options{.width = size.x,
                       .height = size.y,
                       .samples = arguments.msaa,
                       .camera = arguments.camera,
                       .depth = parse_depth(arguments.depth),
                       .background = background,
                       .environment = parse_environment(arguments.environment)};
  const double start = seconds_now();
  Scene scene = load_scene(arguments.input);
  for (Texture& texture : scene.textures) texture.sampler.max_anisotropy = default_max_anisotropy;
  const double load_seconds = seconds_now() - start;
  if (!arguments.quiet)
    for (const std::string& note : scene.notes)
      std::fprintf(stderr, "%s: %s\n", arguments.input.c_str(), note.c_str());
  Task task{arguments,
            scene,
            {},
            load_environment(arguments.environment, arguments.background.empty()),
            display};
  if (display || task.shows_environment()) options.background = vec4(0);
  options.key_light = !task.environment;
  task.frame = make_frame(scene, options);
  const Frame& frame = task.frame;
  if (arguments.dry_run) {
    std::printf("%s: fine, %zu draws, %zu lights, %zu materials, %zu images\n",
                arguments.input.c_str(), frame.draws.size(), frame.lights.size(),
                scene.materials.size(), scene.images.size());
    return 0;
  }
  const Job job = arguments.backend == "cpu" ? render_on_cpu(task) : render_on_gpu(task);
  if (!arguments.quiet || !job.meets) say_choice(arguments, job);
  if (!job.meets) return 3;
  save(arguments, job);
  if (!arguments.metrics.empty()) {
    const std::string text = metrics(arguments, frame, job, load_seconds).dump(2) + "\n";
    write_file_atomically(arguments.metrics, std::as_bytes(std::span(text)));
  }
  if (arguments.verbose)
    std::fprintf(stderr, "%s: %llu triangles, %dx%d, %d samples, %.1f ms on %s\n",
                 arguments.output.c_str(),
                 static_cast<unsigned long long>(job.picture.triangle_count), size.x, size.y,
                 samples_of(job, options), job.seconds * 1e3, job.device.c_str());
  return 0;
}

}  // namespace

void add_render_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("render", "Render a scene or mesh to a picture, without a window");
  auto a = std::make_shared<RenderArguments>();
  verb->add_option("input", a->input, "Scene (.gltf, .glb) or mesh (.obj, .ply, .stl, .off)")
      ->required();
  verb->add_option("-o,--output", a->output,
                   "Picture: .png is display-referred sRGB; .exr, .hdr, .pfm are linear");
  verb->add_option("--size", a->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  verb->add_option(
      "--camera", a->camera,
      "Name or number of a camera of the scene (default: the first, else all is framed)");
  CLI::Option* msaa = verb->add_option("--msaa", a->msaa, "Samples a pixel")
                          ->check(CLI::IsMember({1, 2, 4, 8}))
                          ->capture_default_str();
  verb->add_option("--aa", a->aa,
                   "Antialiasing: none, msaa2, msaa4, msaa8; ssaaN (N a square): larger, then "
                   "averaged, or ssaaN:tent, gaussian, mitchell, lanczos; accumulateN: N shifted "
                   "frames; adaptive: 16 samples where neighbours "
                   "differ; auto: the fastest within --max-error")
      ->excludes(msaa);
  verb->add_option("--max-error", a->max_error,
                   "With --aa auto: mean FLIP against 64 frames of this picture")
      ->check(within(0, 1));
  verb->add_option("--backend", a->backend, "gpu: Vulkan; cpu: the reference alone")
      ->check(CLI::IsMember({"gpu", "cpu"}))
      ->capture_default_str();
  verb->add_option("--device", a->device,
                   "Vulkan device: number or part of its name (see parity devices)");
  verb->add_option("--exposure", a->exposure, "Stops: +1 is twice as bright")
      ->check(within(-64, 64))
      ->capture_default_str();
  verb->add_option("--tone-map", a->tone_map,
                   "How light becomes a .png: neutral (Khronos PBR Neutral), aces, agx, none")
      ->check(CLI::IsMember({"neutral", "aces", "agx", "none"}))
      ->capture_default_str();
  verb->add_option("--background", a->background,
                   "#rrggbb[aa], linear r,g,b[,a], or transparent; neither exposed nor tone-mapped "
                   "(default: the environment's picture, else #2b2f36)");
  verb->add_option(
      "--environment", a->environment,
      "A picture of the light from all around (equirectangular .hdr or .exr; of a .png or .jpg the "
      "light that a screen would give), or its radiance, "
      "linear: l or r,g,b (default: 0 if the scene has lights)");
  verb->add_option("--shadows", a->shadows,
                   "Shadows of directional, spot and point lights, by shadow maps")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  verb->add_option("--ambient-occlusion", a->ambient_occlusion,
                   "Less light from all around in corners, by what is near in the picture; an "
                   "approximation that costs one more pass")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  verb->add_option("--depth", a->depth, "Depth buffer")
      ->check(CLI::IsMember({"reverse", "standard", "logarithmic"}))
      ->capture_default_str();
  verb->add_option("--threads", a->threads, "Threads of the CPU reference (default: all)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--metrics", a->metrics, "Write times, counts and memory to this JSON file");
  verb->add_flag("--dry-run", a->dry_run, "Load and check everything, render nothing");
  verb->add_flag("-q,--quiet", a->quiet, "No notes, no progress");
  verb->add_flag("-v,--verbose", a->verbose, "Say what was done");
  verb->footer(
      "Examples:\n"
      "  parity render assets/demo.glb -o demo.png\n"
      "  parity render bunny.ply -o bunny.png --size 1024x1024 --background transparent\n"
      "  parity render scene.gltf -o scene.exr --camera 1 --msaa 8 --metrics scene.json\n"
      "  parity render scene.glb -o lit.png --environment studio.hdr --tone-map agx\n"
      "  parity render room.glb -o room.png --environment 0.5 --ambient-occlusion on\n"
      "  parity render scene.glb -o reference.png --backend cpu\n"
      "  parity render scene.glb -o smooth.png --aa auto --max-error 0.002");
  verb->callback([a, &exit_code] {
    if (a->threads > 0) omp_set_num_threads(a->threads);
    exit_code = render(*a);
  });
}

}  // namespace parity::tools
