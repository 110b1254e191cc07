#include "tools/render_job.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/raster/srgb.h"
#include "cpu_reference/shading/ambient_occlusion.h"
#include "cpu_reference/shading/prefilter.h"
#include "cpu_reference/shading/tone_map.h"
#include "geometry/ambient_occlusion.h"
#include "geometry/cast_shadows.h"
#include "geometry/image_io.h"
#include "geometry/opaque_frame.h"
#include "geometry/texture_levels.h"
#include "gpu/core/context.h"
#include "gpu/raster/encode_srgb.h"
#include "gpu/raster/renderer.h"
#include "gpu/shading/ambient_occlusion.h"
#include "gpu/shading/prefilter.h"
#include "gpu/shading/tone_map.h"
#include "tools/progress.h"

namespace parity::tools {
namespace {

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

void finish(const Task& task, Picture& picture) {
  if (task.shows_environment()) show_environment(task.environment->backdrop, task.frame, picture);
}

/// Finished, as a screen shows it: linear, 0 to 1.
Grid<vec4> displayed(gpu::Context& context, const Task& task, const Picture& finished) {
  const RenderArguments& a = task.arguments;
  return over(gpu::tone_map(context, straight_alpha(finished.color), parse_tone_map(a.tone_map),
                            float(a.exposure)),
              parse_background(a.background));
}

/// What --aa auto judges: pictures to be put over something else stand over middle grey.
Grid<vec4> judged(gpu::Context& context, const Task& task, Picture picture) {
  finish(task, picture);
  constexpr float grey = 0.214f;
  return over(displayed(context, task, picture), vec4(grey, grey, grey, 1));
}

}  // namespace

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Grid<vec4> straight_alpha(Grid<vec4> color) {
  for (vec4& c : color)
    if (c.w > 0 && c.w < 1) c = vec4(vec3(c) / c.w, c.w);
  return color;
}

std::optional<Surroundings> load_environment(const std::string& text, bool is_shown) {
  if (text.empty() || !names_a_file(text)) return std::nullopt;
  const Grid<vec4> picture = load_image(text);
  return Surroundings{environment_map(picture, environment_side),
                      is_shown ? environment_map(picture, backdrop_side) : EnvironmentMap{}};
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
  if (job.meets) finish(task, job.picture);
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
  if (job.meets) finish(task, job.picture);
  job.seconds = seconds_now() - start;
  if (task.display && job.meets)
    job.display = gpu::encode_srgb(context, displayed(context, task, job.picture), 0);
  return job;
}

}  // namespace parity::tools
