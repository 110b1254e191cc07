#include "tools/antialias.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/sampling/pattern.h"
#include "cpu_reference/sampling/reconstruct.h"
#include "geometry/flip.h"
#include "geometry/jitter.h"
#include "geometry/texture_levels.h"
#include "gpu/raster/renderer.h"
#include "gpu/sampling/antialias.h"
#include "gpu/sampling/reconstruct.h"
#include "tests/stage.h"

namespace parity::tools {
namespace {

using Kind = Antialiasing::Kind;

constexpr float adaptive_contrast = 0.04f;
constexpr int most_frames = 4096;

int root_of(int samples) { return int(std::lround(std::sqrt(double(samples)))); }

/// The number after a name; none if the text is not that name and a number.
std::optional<int> number_after(const std::string& text, const std::string& name) {
  if (!text.starts_with(name)) return std::nullopt;
  int number = 0;
  const char* begin = text.data() + name.size();
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

std::vector<dvec2> shifts_of(int frames) {
  std::vector<dvec2> shifts = cpu::pattern(SamplePattern::multi_jittered, std::uint32_t(frames), 1);
  for (dvec2& shift : shifts) shift -= 0.5;
  return shifts;
}

/// The same view with other options.
Frame remade(const Scene& scene, const Frame& frame, const FrameOptions& options) {
  Frame result = make_frame(scene, options);
  result.environment = frame.environment;
  result.shadows = frame.shadows;
  result.openness = frame.openness;
  result.behind = frame.behind;
  return result;
}

Frame with_samples(const Scene& scene, const Frame& frame, int samples) {
  FrameOptions options = frame.options;
  options.samples = samples;
  return remade(scene, frame, options);
}

Frame enlarged(const Scene& scene, const Frame& frame, int samples) {
  const int factor = root_of(samples);
  FrameOptions options = frame.options;
  options.samples = 1;
  if (options.width > 16384 / factor || options.height > 16384 / factor)
    throw std::invalid_argument("--aa ssaa" + std::to_string(samples) + " makes a picture of " +
                                std::to_string(options.width * factor) + "x" +
                                std::to_string(options.height * factor) +
                                ", sides must be at most 16384");
  options.width *= factor;
  options.height *= factor;
  return remade(scene, frame, options);
}

/// Filters with negative lobes go past what they filter: no light is below 0, no alpha above 1.
Grid<vec4> within_range(Grid<vec4> color) {
  for (vec4& c : color) c = vec4(glm::max(vec3(c), vec3(0)), glm::clamp(c.w, 0.0f, 1.0f));
  return color;
}

/// "ssaaN" or "ssaaN:FILTER".
std::optional<Antialiasing> parse_supersampling(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto samples = number_after(text.substr(0, colon), "ssaa");
  if (!samples || *samples < 4 || *samples > 256 ||
      root_of(*samples) * root_of(*samples) != *samples)
    return std::nullopt;
  Antialiasing mode{.kind = Kind::ssaa, .samples = *samples};
  if (colon == std::string::npos) return mode;
  for (const ReconstructionFilter filter : all_reconstruction_filters)
    if (name_of(filter) == text.substr(colon + 1)) {
      mode.filter = filter;
      return mode;
    }
  return std::nullopt;
}

/// One scene by any mode.
class Device {
 public:
  Device(gpu::Context& context, const Scene& scene, const Frame& frame, const Screen& screen)
      : context_(context),
        scene_(scene),
        frame_(frame),
        screen_(screen),
        gain_(std::exp2(float(screen.exposure))) {}

  Picture render(const Antialiasing& mode) {
    switch (mode.kind) {
      case Kind::ssaa: {
        Picture picture = gpu::render(context_, scene_, enlarged(scene_, frame_, mode.samples));
        picture.color = within_range(gpu::reconstruct(
            context_, picture.color, {frame_.options.width, frame_.options.height}, mode.filter));
        return picture;
      }
      case Kind::accumulate:
        return antialiaser(mode).accumulate(with_samples(scene_, frame_, 1),
                                            shifts_of(mode.samples));
      case Kind::adaptive:
        return antialiaser(mode).adaptive(with_samples(scene_, frame_, 1), adaptive_contrast,
                                          gain_);
      default:
        if (!renderer_)
          renderer_.emplace(context_, scene_, gpu::RenderOptions{}, still_levels(mode.samples));
        return renderer_->render(with_samples(scene_, frame_, mode.samples));
    }
  }

  Antialiased choose(double max_error) {
    chooses_ = true;
    const Grid<vec4> truth = shown(render({.kind = Kind::accumulate, .samples = 64}));
    Antialiased best;
    best.meets = false;
    double least = 0;
    for (const Antialiasing& mode : candidates()) {
      render(mode);  // what is made once is not counted
      const double start = detail::wall_seconds();
      Picture picture = render(mode);
      const double seconds = detail::wall_seconds() - start;
      const double error = mean(flip(truth, shown(picture), usual_pixels_per_degree));
      best.trials.push_back({name_of(mode), error, seconds});
      if (error > max_error || (best.meets && seconds >= least)) continue;
      best.picture = std::move(picture);
      best.mode = name_of(mode);
      best.meets = true;
      least = seconds;
    }
    return best;
  }

 private:
  /// ssaaN costs what accumulateN does, at places that are no better.
  static std::vector<Antialiasing> candidates() {
    return {{.kind = Kind::msaa, .samples = 1},       {.kind = Kind::msaa, .samples = 2},
            {.kind = Kind::msaa, .samples = 4},       {.kind = Kind::adaptive, .samples = 16},
            {.kind = Kind::msaa, .samples = 8},       {.kind = Kind::accumulate, .samples = 4},
            {.kind = Kind::accumulate, .samples = 8}, {.kind = Kind::accumulate, .samples = 16}};
  }

  /// Of what the first mode reads, or, where several are tried, of all.
  gpu::Antialiaser& antialiaser(const Antialiasing& mode) {
    if (!antialiaser_) antialiaser_.emplace(context_, scene_, moved_levels(mode));
    return *antialiaser_;
  }

  std::vector<LevelRange> still_levels(int samples) const {
    if (!chooses_) return read_levels(scene_, with_samples(scene_, frame_, samples));
    std::vector<LevelRange> levels = read_levels(scene_, with_samples(scene_, frame_, 1));
    for (const int more : {2, 4, 8})
      join(levels, read_levels(scene_, with_samples(scene_, frame_, more)));
    return levels;
  }

  std::vector<LevelRange> moved_levels(const Antialiasing& mode) const {
    constexpr int most_looked_at = 16;
    const Frame one = with_samples(scene_, frame_, 1);
    if (chooses_ || mode.kind != Kind::accumulate || mode.samples > most_looked_at)
      return read_levels(scene_, one, true);
    std::vector<LevelRange> levels(scene_.images.size());
    for (const dvec2& shift : shifts_of(mode.samples))
      join(levels, read_levels(scene_, shifted(one, shift)));
    return levels;
  }

  Grid<vec4> shown(const Picture& picture) const {
    if (screen_.shown) return screen_.shown(picture);
    Grid<vec4> color = picture.color;
    for (vec4& c : color) c = vec4(vec3(c) * gain_, c.w);
    return color;
  }

  gpu::Context& context_;
  const Scene& scene_;
  const Frame& frame_;
  const Screen& screen_;
  float gain_;
  bool chooses_ = false;
  std::optional<gpu::Renderer> renderer_;
  std::optional<gpu::Antialiaser> antialiaser_;
};

Picture mean_of_frames(const Scene& scene, const Frame& frame, int count) {
  Picture sum;
  for (const dvec2& shift : shifts_of(count)) {
    Picture picture = cpu::render(scene, shifted(frame, shift)).picture;
    const float weight = 1.0f / float(count);
    for (vec4& c : picture.color) c *= weight;
    if (sum.color.empty()) {
      sum = std::move(picture);
      continue;
    }
    for (std::size_t i = 0; i < sum.color.size(); ++i)
      sum.color.values()[i] += picture.color.values()[i];
  }
  return sum;
}

}  // namespace

Antialiasing parse_antialiasing(const std::string& text) {
  if (text == "none") return {};
  if (text == "adaptive") return {.kind = Kind::adaptive, .samples = 16};
  if (text == "auto") return {.kind = Kind::automatic};
  if (const auto n = number_after(text, "msaa"); n && (*n == 2 || *n == 4 || *n == 8))
    return {.kind = Kind::msaa, .samples = *n};
  if (const auto mode = parse_supersampling(text)) return *mode;
  if (const auto n = number_after(text, "accumulate"); n && *n >= 1 && *n <= most_frames)
    return {.kind = Kind::accumulate, .samples = *n};
  throw std::invalid_argument(
      "--aa is '" + text +
      "', must be none, msaa2, msaa4, msaa8, ssaaN or ssaaN:FILTER (N a square, 4 to 256; "
      "box, tent, gaussian, mitchell, lanczos), accumulateN (1 to 4096), adaptive or auto");
}

std::string name_of(const Antialiasing& mode) {
  switch (mode.kind) {
    case Kind::ssaa:
      return "ssaa" + std::to_string(mode.samples) +
             (mode.filter == ReconstructionFilter::box ? "" : ":" + name_of(mode.filter));
    case Kind::accumulate:
      return "accumulate" + std::to_string(mode.samples);
    case Kind::adaptive:
      return "adaptive";
    case Kind::automatic:
      return "auto";
    default:
      return mode.samples == 1 ? "none" : "msaa" + std::to_string(mode.samples);
  }
}

Antialiased render_antialiased(gpu::Context& context, const Scene& scene, const Frame& frame,
                               const Antialiasing& mode, const Screen& screen) {
  Device device(context, scene, frame, screen);
  if (mode.kind == Kind::automatic) return device.choose(mode.max_error);
  return {.picture = device.render(mode), .mode = name_of(mode), .trials = {}};
}

Antialiased render_antialiased(const Scene& scene, const Frame& frame, const Antialiasing& mode) {
  Antialiased result{.picture = {}, .mode = name_of(mode), .trials = {}};
  if (mode.kind == Kind::msaa) {
    result.picture = cpu::render(scene, with_samples(scene, frame, mode.samples)).picture;
  } else if (mode.kind == Kind::accumulate) {
    result.picture = mean_of_frames(scene, with_samples(scene, frame, 1), mode.samples);
  } else if (mode.kind == Kind::ssaa) {
    result.picture = cpu::render(scene, enlarged(scene, frame, mode.samples)).picture;
    const ivec2 size{frame.options.width, frame.options.height};
    Grid<dvec4> wide{result.picture.color.width(), result.picture.color.height()};
    std::copy(result.picture.color.begin(), result.picture.color.end(), wide.begin());
    wide = cpu::reconstruct(wide, size, mode.filter);
    result.picture.color = {size.x, size.y};
    std::copy(wide.begin(), wide.end(), result.picture.color.begin());
    result.picture.color = within_range(std::move(result.picture.color));
  } else {
    throw std::invalid_argument("--aa " + result.mode + " is of --backend gpu only");
  }
  return result;
}

}  // namespace parity::tools
