#include "gpu/sampling/antialias.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/jitter.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/compute_renderer.h"
#include "gpu/raster/half.h"
#include "gpu/raster/pipeline_renderer.h"
#include "gpu/raster/prefix_sum.h"
#include "gpu/raster/renderer.h"
#include "gpu/raster/scene_buffers.h"
#include "gpu/raster/scene_frame.h"
#include "gpu/raster/tile_rasterizer.h"
#include "shaders.h"
#include "shaders/raster/scene_compute_layout.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {
namespace {

/// A tile's list holds what may touch places up to 8/16 px from the middles of its pixels, unless
/// it is made for 1 sample.
constexpr int list_samples = 8;

Context& checked(Context& context) {
  if (can_render(context.info())) return context;
  throw Error(ErrorKind::missing_feature,
              "device " + context.info().name + " cannot compile the renderer's shaders");
}

std::uint32_t tiles(int pixels) { return (std::uint32_t(pixels) + tile_side - 1) / tile_side; }

/// What the kernel that draws pixels anew is made for.
struct RefineKey {
  DepthMode depth;
  bool blends;
  bool environment;  ///< a picture of it
  bool shadows;
  bool openness;
  bool behind;

  bool operator==(const RefineKey&) const = default;
};

std::vector<Specialization> refine_constants(const SceneFeatures& features, RefineKey key) {
  std::vector<Specialization> constants = scene_specializations(features, {});
  constants.push_back({9, features.cuts_out});
  constants.push_back({11, std::uint32_t(key.depth)});
  constants.push_back({12, key.blends});
  constants.push_back({22, features.layers});
  constants.push_back({25, features.metals});
  constants.push_back({23, key.environment});
  constants.push_back({24, key.shadows});
  constants.push_back({26, key.openness});
  constants.push_back({27, key.behind});
  return constants;
}

/// The triangles of a frame in the lists of its tiles.
struct Lists {
  Lists(Context& context, const Frame& frame, std::size_t count)
      : items(context, count),
        scene_args(context, 1),
        clip_positions(context, count * 3),
        triangles(context, count),
        flags(context, count),
        rasterizer(context, options_of(frame, count)) {}

  static TileRasterizerOptions options_of(const Frame& frame, std::size_t count) {
    return {.width = frame.options.width,
            .height = frame.options.height,
            .samples = list_samples,
            .snapping = Snapping::mesa,
            .depth = frame.options.depth,
            .near = float(frame.near),
            .far = float(frame.far),
            .triangle_capacity = std::uint32_t(count)};
  }

  bool fits(const Frame& frame, std::size_t count) const {
    const TileRasterizerOptions& have = rasterizer.options();
    const TileRasterizerOptions want = options_of(frame, count);
    return have.width == want.width && have.height == want.height && have.depth == want.depth &&
           have.near == want.near && have.far == want.far &&
           have.triangle_capacity == want.triangle_capacity;
  }

  void record(Commands& commands, const Kernel<SceneTriangleArgs>& kernel, const Frame& frame) {
    const auto count = std::uint32_t(items.count());
    if (count > 0)
      commands.dispatch(kernel, {count},
                        SceneTriangleArgs{.scene = scene_args,
                                          .items = items,
                                          .clip_positions = clip_positions,
                                          .triangles = triangles,
                                          .flags = flags,
                                          .count = count,
                                          .width = std::uint32_t(frame.options.width),
                                          .height = std::uint32_t(frame.options.height),
                                          .padding = 0});
    rasterizer.record_lists(commands, {.clip_positions = clip_positions,
                                       .triangles = triangles,
                                       .flags = flags,
                                       .triangle_count = count,
                                       .first_element = 1});
  }

  Buffer<uvec2> items;
  Buffer<SceneArgs> scene_args;
  Buffer<vec4> clip_positions;
  Buffer<uvec3> triangles;
  Buffer<std::uint32_t> flags;
  TileRasterizer rasterizer;
};

/// What is kept for pictures of one size.
struct Target {
  Target(Context& context, ivec2 picture)
      : size(picture),
        rows(std::size_t(tiles(size.x)) * tiles(size.y) * tile_side),
        pixel_count(std::size_t(size.x) * std::size_t(size.y)),
        masks(context, rows),
        counts(context, rows + 1),
        pixels(context, pixel_count),
        codes(context, pixel_count),
        averages(context, 2 * pixel_count),
        prefix_sum(context, rows + 1) {}

  PixelNeedArgs need(const Buffer<std::uint32_t>& words, float contrast, float gain) const {
    return {.words = words,
            .codes = codes,
            .averages = averages,
            .masks = masks,
            .counts = counts,
            .pixels = pixels,
            .width = std::uint32_t(size.x),
            .height = std::uint32_t(size.y),
            .tiles_x = tiles(size.x),
            .row_count = std::uint32_t(rows),
            .gain = gain,
            .contrast = contrast};
  }

  ivec2 size;
  std::size_t rows;  ///< of 8 pixels, of whole tiles
  std::size_t pixel_count;
  Buffer<std::uint32_t> masks;
  Buffer<std::uint32_t> counts;
  Buffer<std::uint32_t> pixels;
  Buffer<std::uint32_t> codes;
  Buffer<std::uint32_t> averages;
  PrefixSum prefix_sum;
};

}  // namespace

struct Antialiaser::State {
  State(Context& device, const Scene& scene, std::vector<LevelRange> levels)
      : context(device),
        bytes_before(device.memory_bytes()),
        buffers(device, scene, std::move(levels)),
        blended(scene),
        pipelines(device, buffers, {}),
        sum(device, shaders::sampling_frame_sum_comp),
        display(device, shaders::sampling_display_codes_comp),
        need(device, shaders::sampling_pixel_need_comp),
        list(device, shaders::sampling_pixel_list_comp),
        triangles(device, shaders::raster_scene_triangles_comp) {}

  void begin(const Frame& frame);
  void add(Commands& commands, const Frame& frame, const SceneFrame& data, bool is_first,
           float weight);
  void find_needs(Commands& commands, float contrast, float gain);
  void make_lists(const Frame& moved, const SceneFrame& data);
  void refine(const Frame& frame, std::uint32_t count, bool blends);
  void keep(const Timing& timing) {
    passes.insert(passes.end(), timing.passes.begin(), timing.passes.end());
  }
  Picture finish(const Frame& frame, const SceneFrame& data, std::vector<vec4> colors);

  Context& context;
  std::uint64_t bytes_before;
  SceneBuffers buffers;
  BlendedPrimitives blended;
  PipelineRenderer pipelines;
  Kernel<FrameSumArgs> sum;
  Kernel<PixelNeedArgs> display, need, list;
  Kernel<SceneTriangleArgs> triangles;
  std::optional<Kernel<RefineArgs>> refine_kernel;
  RefineKey refine_key{};
  std::optional<Target> target;
  std::optional<Buffer<vec4>> mean;  ///< of accumulated frames
  std::optional<Lists> lists;        ///< kept while size, depth and count of triangles stay
  std::vector<std::pair<std::string, double>> passes;
  double refined = 0;
};

void Antialiaser::State::begin(const Frame& frame) {
  const std::vector<int>& offered = context.info().sample_counts;
  if (std::ranges::find(offered, frame.options.samples) == offered.end())
    throw std::invalid_argument("gpu::Antialiaser: " + std::to_string(frame.options.samples) +
                                " samples, which the device does not offer");
  const ivec2 size{frame.options.width, frame.options.height};
  if (!target || target->size != size) {
    target.reset();
    mean.reset();
    target.emplace(context, size);
  }
  passes.clear();
}

void Antialiaser::State::add(Commands& commands, const Frame& frame, const SceneFrame& data,
                             bool is_first, float weight) {
  pipelines.record(commands, frame, data);
  commands.pass("sum");
  const auto count = std::uint32_t(target->pixel_count);
  if (!mean) mean.emplace(context, target->pixel_count);
  commands.dispatch(sum, {count},
                    FrameSumArgs{.words = pipelines.color_words(),
                                 .colors = *mean,
                                 .pixel_count = count,
                                 .is_first = is_first ? 1u : 0u,
                                 .weight = weight});
}

void Antialiaser::State::find_needs(Commands& commands, float contrast, float gain) {
  Target& t = *target;
  const PixelNeedArgs args = t.need(pipelines.color_words(), contrast, gain);
  const auto rows = std::uint32_t(t.rows);
  commands.pass("need");
  commands.fill(t.counts, 0);
  commands.copy(pipelines.color_words(), t.averages, 0, 0, 2 * t.pixel_count);
  commands.dispatch(display, {std::uint32_t(t.pixel_count)}, args);
  commands.dispatch(need, {rows}, args);
  t.prefix_sum.record(commands, t.counts, rows + 1);
  commands.dispatch(list, {rows}, args);
}

/// The frame, moved by half of a sixteenth: the places of the samples are whole sixteenths, whose
/// mean is that much above and left of the middle.
Frame moved_to_places(const Frame& frame) { return shifted(frame, dvec2(-1.0 / 32)); }

/// The triangles of the frame that is moved to the places.
///
/// @param data  of that frame; the lists refer to it.
void Antialiaser::State::make_lists(const Frame& moved, const SceneFrame& data) {
  const std::vector<uvec2> items = triangle_items(moved, buffers, data);
  if (!lists || !lists->fits(moved, items.size())) {
    lists.reset();
    lists.emplace(context, moved, items.size());
  }
  lists->items.write(items);
  lists->scene_args.write(std::vector<SceneArgs>{data.args()});
  do {
    keep(context.run([&](Commands& commands) {
      commands.pass("lists");
      lists->record(commands, triangles, moved);
    }));
  } while (!lists->rasterizer.fit(context));
}

void Antialiaser::State::refine(const Frame& frame, std::uint32_t count, bool blends) {
  const RefineKey key{.depth = frame.options.depth,
                      .blends = blends,
                      .environment = frame.environment.has_value(),
                      .shadows = !frame.shadows.empty(),
                      .openness = !frame.openness.empty(),
                      .behind = frame.behind.has_value()};
  if (!refine_kernel || refine_key != key)
    refine_kernel.emplace(context, shaders::sampling_refine_comp,
                          refine_constants(buffers.features(), key));
  refine_key = key;
  const vec4 b = frame.options.background;
  const RefineArgs args{.scene = lists->scene_args,
                        .items = lists->items,
                        .clip_positions = lists->clip_positions,
                        .begins = lists->rasterizer.tile_begins(),
                        .tile_triangles = lists->rasterizer.tile_triangles(),
                        .pixels = target->pixels,
                        .averages = target->averages,
                        .width = std::uint32_t(target->size.x),
                        .height = std::uint32_t(target->size.y),
                        .background = vec4(vec3(b) * b.w, b.w),
                        .tiles_x = lists->rasterizer.tiles_x(),
                        .pixel_count = count};
  keep(context.run([&](Commands& commands) {
    commands.pass("refine");
    commands.dispatch(*refine_kernel, {count}, args);
  }));
}

Picture Antialiaser::State::finish(const Frame& frame, const SceneFrame& data,
                                   std::vector<vec4> colors) {
  Picture picture;
  picture.color = Grid<vec4>(frame.options.width, frame.options.height);
  picture.color.values() = std::move(colors);
  picture.triangle_count = data.triangle_count();
  picture.pass_seconds = passes;
  const std::uint64_t bytes = context.memory_bytes();
  picture.memory_bytes = bytes > bytes_before ? bytes - bytes_before : 0;
  return picture;
}

Antialiaser::Antialiaser(Context& context, const Scene& scene, std::vector<LevelRange> levels)
    : state_(std::make_unique<State>(checked(context), scene, std::move(levels))) {}
Antialiaser::~Antialiaser() = default;
Antialiaser::Antialiaser(Antialiaser&&) noexcept = default;
Antialiaser& Antialiaser::operator=(Antialiaser&&) noexcept = default;

Picture Antialiaser::accumulate(const Frame& frame, std::span<const dvec2> shifts) {
  if (shifts.empty()) throw std::invalid_argument("gpu::Antialiaser: no shift");
  State& s = *state_;
  s.begin(frame);
  double seconds = 0;
  const FramePictures pictures(s.context, frame);
  std::optional<SceneFrame> data;
  Frame moved = frame;
  for (const dvec2& shift : shifts) {
    shift_into(moved, frame, shift);
    data.emplace(s.context, s.buffers, s.blended, moved, pictures);
    s.pipelines.prepare(moved, *data);
    seconds +=
        s.context
            .run([&](Commands& commands) {
              s.add(commands, moved, *data, &shift == shifts.data(), 1.0f / float(shifts.size()));
            })
            .seconds;
  }
  s.passes = {{"frames", seconds}};
  return s.finish(frame, *data, s.mean->read());
}

Picture Antialiaser::adaptive(const Frame& frame, float contrast, float gain) {
  if (frame.options.samples != 1)
    throw std::invalid_argument("gpu::Antialiaser: " + std::to_string(frame.options.samples) +
                                " samples, must be 1");
  State& s = *state_;
  s.begin(frame);
  const FramePictures pictures(s.context, frame);
  const SceneFrame data(s.context, s.buffers, s.blended, frame, pictures);
  s.pipelines.prepare(frame, data);
  s.keep(s.context.run([&](Commands& commands) {
    s.pipelines.record(commands, frame, data);
    s.find_needs(commands, contrast, gain);
  }));
  const Target& t = *s.target;
  const std::uint32_t count = t.counts.read(t.rows, 1)[0];
  s.refined = double(count) / double(t.pixel_count);
  if (count > 0) {
    const Frame moved = moved_to_places(frame);
    const SceneFrame moved_data(s.context, s.buffers, s.blended, moved, pictures);
    s.make_lists(moved, moved_data);
    s.refine(frame, count, !data.order().empty());
  }
  return s.finish(frame, data, vec4_from_halves(t.averages.read()));
}

double Antialiaser::refined() const { return state_->refined; }

}  // namespace parity::gpu
