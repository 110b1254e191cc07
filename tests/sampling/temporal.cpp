#include "cpu_reference/sampling/temporal.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/sampling/pattern.h"
#include "geometry/random.h"
#include "gpu/sampling/temporal.h"
#include "tests/chart.h"
#include "tests/stage.h"

namespace parity {

static auto fields_of(const TemporalStep*) {
  return std::tuple{&TemporalStep::current, &TemporalStep::history, &TemporalStep::motion,
                    &TemporalStep::longest, &TemporalStep::clamps};
}

namespace {

TemporalStep random_step(const Setting& setting) {
  const int width = setting.count("side"), height = std::max(1, width - 5);
  Random random{setting.seed};
  TemporalStep step{{width, height}, {width, height}, {width, height}};
  for (std::size_t i = 0; i < step.current.size(); ++i) {
    step.current.values()[i] = vec4(random.in_box(0.5f) + 0.5f, 1);
    step.history.values()[i] = vec4(random.in_box(0.7f) + 0.5f, 1 + random.below(20));
    // Eighths are exact: both sides decide alike what left the picture.
    step.motion.values()[i] = vec2(int(random.below(64)) - 32, int(random.below(64)) - 32) / 8.0f *
                              float(setting.at("motion"));
  }
  step.longest = float(setting.at("longest"));
  step.clamps = setting.count("clamps") != 0;
  return step;
}

double largest(const Grid<dvec4>& got, const Grid<dvec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < 4; ++c)
      worst = std::max(worst, std::abs(got.values()[i][c] - want.values()[i][c]));
  return worst;
}

Grid<dvec4> on_device(gpu::Context& context, const TemporalStep& step) {
  const Grid<vec4> result = gpu::accumulate(context, step);
  Grid<dvec4> wide{result.width(), result.height()};
  for (std::size_t i = 0; i < result.size(); ++i) wide.values()[i] = dvec4(result.values()[i]);
  return wide;
}

const Registration registration = register_stage<TemporalStep, Grid<dvec4>>({
    .name = "sampling/temporal",
    .title = "Temporal accumulation: jittered frames, reprojected, rejected where they do not fit",
    .source = "notes 1.8; Karis 2014; Yang, Liu & Salvi 2020",
    .rows = {21},
    .axes = {{.name = "side",
              .unit = "px",
              .low = 1,
              .high = 131,
              .standard = 48,
              .logarithmic = true,
              .whole = true},
             {.name = "motion", .low = 0, .high = 4, .standard = 1, .whole = true},
             {.name = "longest", .unit = "frames", .low = 1, .high = 64, .standard = 16},
             {.name = "clamps", .low = 0, .high = 1, .standard = 1, .whole = true, .each = true}},
    .problem = random_step,
    .cpu = {{.solve = [](const TemporalStep& step) { return cpu::accumulate(step); }}},
    .gpu = {{.solve = on_device}},
    .distance = largest,
    .tolerance = [](const TemporalStep& step) { return 0x1p-24 * 32 * (20 * 17 + step.longest); },
    .why = "colours to 1.2 and counts to 20 by 8 roundings; the share of a history that is lost "
           "is its distance from the range, divided by the range plus 1/16: 17 times as wrong, of "
           "20 frames; places have up to 8 bits before the point",
    .chart_axes = {"side"},
});

/// A disc of radius 20 at `middle`, one sample a pixel at the shift; 96 x 96.
Grid<vec4> disc_frame(dvec2 middle, dvec2 shift) {
  Grid<vec4> frame{96, 96};
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      frame(x, y) = vec4(glm::distance(dvec2(x + 0.5, y + 0.5) + shift, middle) < 20 ? 1.0f : 0.0f);
  return frame;
}

Grid<vec4> disc_truth(dvec2 middle) {
  Grid<vec4> truth{96, 96};
  for (const dvec2& p : cpu::pattern(SamplePattern::regular, 256, 1)) {
    const Grid<vec4> frame = disc_frame(middle, p - 0.5);
    for (std::size_t i = 0; i < truth.size(); ++i) truth.values()[i] += frame.values()[i] / 256.0f;
  }
  return truth;
}

double error_of(const Grid<vec4>& got, const Grid<vec4>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += std::pow(double(got.values()[i].x) - double(truth.values()[i].x), 2);
  return std::sqrt(sum / double(truth.size()));
}

constexpr double speed = 1.5;  ///< px a frame

/// Where each pixel was: the disc, and the pixels that it touches, move.
Grid<vec2> disc_motion(int frame, dvec2 middle) {
  if (frame == 0) return {96, 96, vec2(1e6f)};
  Grid<vec2> motion{96, 96};
  for (int y = 0; y < 96 && frame >= 32; ++y)
    for (int x = 0; x < 96; ++x)
      if (glm::distance(dvec2(x + 0.5, y + 0.5), middle) < 21) motion(x, y).x = -float(speed);
  return motion;
}

/// A disc that rests for 32 frames and then moves. Without motion vectors, what is accumulated must
/// be given up.
Series accumulate_disc(gpu::Context& context, const std::string& name, bool clamps, float longest,
                       bool follows = false) {
  Series series{name, {}};
  Grid<vec4> history{96, 96};
  const std::vector<dvec2> shifts = cpu::pattern(SamplePattern::r2, 64, 1);
  for (int frame = 0; frame < 48; ++frame) {
    const dvec2 middle{40.3 + speed * std::max(0, frame - 31), 47.8};
    history = gpu::accumulate(
        context, {disc_frame(middle, shifts[std::size_t(frame)] - 0.5), history,
                  disc_motion(follows ? frame : std::min(frame, 1), middle), longest, clamps});
    series.points.push_back({double(frame + 1), error_of(history, disc_truth(middle))});
  }
  return series;
}

ChartData error_over_frames(gpu::Context& context) {
  const Series held = accumulate_disc(context, "history held to the neighbours", true, 64);
  const Series free = accumulate_disc(context, "history as it is", false, 64);
  const Series followed = accumulate_disc(context, "with motion vectors", true, 64, true);
  const Series none = accumulate_disc(context, "no history", false, 1);
  return {.series = {followed, held, free, none},
          .assertions = {{"at rest, frame 32: error over that of one frame",
                          held.points[31].y / none.points[31].y, 0.25},
                         {"moving, frame 48: error with motion vectors over that of one frame",
                          followed.points[47].y / none.points[47].y, 1},
                         {"moving, frame 48: error over that of one frame",
                          held.points[47].y / none.points[47].y, 2},
                         {"moving, frame 48: error without holding over that of one frame",
                          free.points[47].y / none.points[47].y, 2, Assertion::Relation::at_least}},
          .settings = {{"picture", "disc, 96x96; moves 1.5 px a frame from frame 33"},
                       {"longest history", "64 frames"}}};
}

const Registration chart = register_chart({
    .name = "sampling/temporal_error",
    .title = "Temporal accumulation of a disc that rests, then moves",
    .x = {.label = "frame", .logarithmic = false},
    .y = {.label = "RMSE"},
    .produce = error_over_frames,
});

}  // namespace
}  // namespace parity
