#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/raster/srgb.h"
#include "cpu_reference/shading/ambient_occlusion.h"
#include "cpu_reference/shading/prefilter.h"
#include "cpu_reference/shading/tone_map.h"
#include "geometry/ambient_occlusion.h"
#include "geometry/atomic_file.h"
#include "geometry/cast_shadows.h"
#include "geometry/environment.h"
#include "geometry/frame.h"
#include "geometry/image_io.h"
#include "geometry/opaque_frame.h"
#include "geometry/scene_io.h"
#include "geometry/texture_levels.h"
#include "gpu/core/context.h"
#include "gpu/raster/encode_srgb.h"
#include "gpu/raster/renderer.h"
#include "gpu/shading/ambient_occlusion.h"
#include "gpu/shading/prefilter.h"
#include "gpu/shading/tone_map.h"
#include "tools/antialias.h"
#include "tools/options.h"
#include "tools/progress.h"
#include "tools/render_options.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A colour over nothing is stored premultiplied; files hold straight colour.
Grid<vec4> straight_alpha(Grid<vec4> color) {
  for (vec4& c : color)
    if (c.w > 0 && c.w < 1) c = vec4(vec3(c) / c.w, c.w);
  return color;
}

/// Straight colours over a straight background.
Grid<vec4> over(Grid<vec4> color, const vec4& background) {
  for (vec4& c : color) {
    const float behind = background.w * (1 - c.w);
    const float alpha = c.w + behind;
    const vec3 sum = vec3(c) * c.w + vec3(background) * behind;
    c = vec4(alpha > 0 ? sum / alpha : vec3(0), alpha);
  }
  return color;
}

struct Job {
  Picture picture;
  Grid<u8vec4> display;  ///< filled for 8-bit output
  std::string aa;        ///< what --aa made it with; empty: not asked
  std::vector<AntialiasingTrial> trials;
  bool meets = true;  ///< the error that --aa auto was given
  std::string device;
  double seconds = 0;
};

void take(Job& job, Antialiased result) {
  job.picture = std::move(result.picture);
  job.aa = result.mode;
  job.trials = std::move(result.trials);
  job.meets = result.meets;
}

/// Side of the largest level of an environment; samples of each texel of its rough mirrors.
constexpr int environment_side = 256;
constexpr int environment_samples = 128;

/// Side of what is shown of it behind the scene: as fine as pictures of 2048 x 1024.
constexpr int backdrop_side = 1024;

/// A picture of the light from all around.
struct Surroundings {
  EnvironmentMap light;
  EnvironmentMap backdrop;
};

std::optional<Surroundings> load_environment(const std::string& text, bool is_shown) {
  if (text.empty() || !names_a_file(text)) return std::nullopt;
  const Grid<vec4> picture = load_image(text);
  return Surroundings{environment_map(picture, environment_side),
                      is_shown ? environment_map(picture, backdrop_side) : EnvironmentMap{}};
}

/// Puts the environment behind all that is not opaque.
void show_environment(const EnvironmentMap& map, const Frame& frame, Picture& picture) {
#pragma omp parallel for
  for (int y = 0; y < picture.color.height(); ++y)
    for (int x = 0; x < picture.color.width(); ++x) {
      vec4& c = picture.color(x, y);
      if (c.w >= 1) continue;
      const vec3 seen = radiance_toward(map, view_direction(frame, {x + 0.5, y + 0.5}));
      c = vec4(vec3(c) + seen * (1 - c.w), 1);
    }
}

/// What a job draws.
struct Task {
  const RenderArguments& arguments;
  const Scene& scene;
  Frame frame;
  std::optional<Surroundings> environment;
  bool display = false;  ///< 8-bit output

  bool casts_shadows() const { return arguments.shadows == "on"; }
  bool occludes() const { return arguments.ambient_occlusion == "on"; }
  bool shows_environment() const { return environment && arguments.background.empty(); }
  void finish(Picture& picture) const {
    if (shows_environment()) show_environment(environment->backdrop, frame, picture);
  }
};

/// Finished, as a screen shows it: linear, 0 to 1.
Grid<vec4> displayed(gpu::Context& context, const Task& task, const Picture& finished) {
  const RenderArguments& a = task.arguments;
  return over(gpu::tone_map(context, straight_alpha(finished.color), parse_tone_map(a.tone_map),
                            float(a.exposure)),
              parse_background(a.background));
}

/// What --aa auto judges: pictures to be put over something else stand over middle grey.
Grid<vec4> judged(gpu::Context& context, const Task& task, Picture picture) {
  task.finish(picture);
  constexpr float grey = 0.214f;
  return over(displayed(context, task, picture), vec4(grey, grey, grey, 1));
}

Job render_on_cpu(Task& task) {
  const RenderArguments& a = task.arguments;
  Progress progress{"rendering", 1000, a.quiet};
  Job job;
  job.device = "CPU reference";
  const double start = seconds_now();
  if (task.environment)
    task.frame.environment = cpu::prefilter(task.environment->light, environment_samples);
  const auto depths_of = [&](const Frame& frame) {
    return cpu::render(task.scene, frame, {.colors = false}).picture.depth;
  };
  if (task.casts_shadows())
    task.frame.shadows = cast_shadows(task.scene, task.frame, {}, depths_of);
  if (task.occludes()) {
    const Grid<double> open =
        cpu::ambient_occlusion(occlusion_problem(task.scene, task.frame, {}, depths_of));
    task.frame.openness = Grid<float>(open.width(), open.height());
    std::copy(open.begin(), open.end(), task.frame.openness.begin());
  }
  task.frame.behind = look_behind(task.scene, task.frame, [&](const Frame& frame) {
    return cpu::render(task.scene, frame).picture.color;
  });
  if (const auto mode = antialiasing(a))
    take(job, render_antialiased(task.scene, task.frame, *mode));
  else
    job.picture = cpu::render(task.scene, task.frame, {}, [&](double done) {
                    progress.set(std::size_t(1000 * done));
                  }).picture;
  if (job.meets) task.finish(job.picture);
  job.seconds = seconds_now() - start;
  if (task.display && job.meets)
    job.display =
        cpu::encode_srgb(over(cpu::tone_map(straight_alpha(job.picture.color),
                                            parse_tone_map(a.tone_map), float(a.exposure)),
                              parse_background(a.background)),
                         0);
  return job;
}

Job render_on_gpu(Task& task) {
  const RenderArguments& a = task.arguments;
  gpu::Context context{{.device = a.device}};
  Job job;
  job.device = context.info().name + ", " + context.info().driver;
  if (!a.quiet && context.info().cuts_loops_short)
    std::fprintf(stderr,
                 "parity: %s ends long shader loops early: large scenes may come out wrong\n",
                 context.info().driver.c_str());
  const double start = seconds_now();
  if (task.environment)
    task.frame.environment = gpu::prefilter(context, task.environment->light, environment_samples);
  gpu::Renderer renderer(context, task.scene, {}, read_levels(task.scene, task.frame));
  const auto depths_of = [&](const Frame& frame) { return renderer.render(frame).depth; };
  if (task.casts_shadows())
    task.frame.shadows = cast_shadows(task.scene, task.frame, {}, depths_of);
  if (task.occludes())
    task.frame.openness =
        gpu::ambient_occlusion(context, occlusion_problem(task.scene, task.frame, {}, depths_of));
  task.frame.behind = look_behind(task.scene, task.frame,
                                  [&](const Frame& frame) { return renderer.render(frame).color; });
  if (const auto mode = antialiasing(a))
    take(job, render_antialiased(
                  context, task.scene, task.frame, *mode,
                  {a.exposure, [&](const Picture& p) { return judged(context, task, p); }}));
  else
    job.picture = renderer.render(task.frame);
  if (job.meets) task.finish(job.picture);
  job.seconds = seconds_now() - start;
  if (task.display && job.meets)
    job.display = gpu::encode_srgb(context, displayed(context, task, job.picture), 0);
  return job;
}

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
