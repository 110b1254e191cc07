#include "gpu/raster/tile_rasterizer.h"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/raster/raster_target.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr int greatest_side = 16384;
constexpr std::uint32_t greatest_triangle_count = 1u << 28;  // 8 triangle + piece is 32 bits

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("TileRasterizer: " + what);
}

const TileRasterizerOptions& checked(const TileRasterizerOptions& options) {
  if (options.width < 1 || options.width > greatest_side || options.height < 1 ||
      options.height > greatest_side)
    refuse("size is " + std::to_string(options.width) + "x" + std::to_string(options.height) +
           ", sides must be 1 to 16384");
  standard_sample_places(options.samples);
  if (options.triangle_capacity > greatest_triangle_count)
    refuse("triangle_capacity is " + std::to_string(options.triangle_capacity) +
           ", must be at most 2^28");
  if (options.depth == DepthMode::logarithmic && !(options.near > 0 && options.far > options.near))
    refuse("near is " + std::to_string(options.near) + ", far is " + std::to_string(options.far) +
           ", must be 0 < near < far");
  return options;
}

/// Samples in the registers of one thread: few where threads are many.
std::uint32_t held_samples(const Context& context, int samples) {
  return context.info().type == "cpu" ? 8 : std::uint32_t(samples);
}

std::vector<Specialization> raster_constants(const Context& context,
                                             const TileRasterizerOptions& options,
                                             bool counts_only) {
  return {{0, std::uint32_t(options.samples)},
          {1, std::uint32_t(options.depth)},
          {2, counts_only ? 1u : 0u},
          {3, held_samples(context, options.samples)}};
}

std::size_t sample_count(const TileRasterizerOptions& options) {
  return std::size_t(options.width) * std::size_t(options.height) * std::size_t(options.samples);
}

}  // namespace

TileRasterizer::TileRasterizer(Context& context, const TileRasterizerOptions& options)
    : options_(checked(options)),
      target_(raster_target(options.width, options.height, options.samples, options.snapping)),
      tile_count_(target_.tiles_x * ((std::uint32_t(options.height) + tile_side - 1) / tile_side)),
      held_(held_samples(context, options.samples)),
      count_(context, shaders::raster_tile_count_comp),
      emit_(context, shaders::raster_tile_emit_comp),
      setup_(context, shaders::raster_tile_setup_comp),
      range_(context, shaders::raster_tile_range_comp),
      visibility_(context, shaders::raster_tile_raster_comp,
                  raster_constants(context, options, false)),
      coverage_(context, shaders::raster_tile_raster_comp,
                raster_constants(context, options, true)),
      prefix_sum_(context, std::size_t{options.triangle_capacity} + 1),
      offsets_(context, std::size_t{options.triangle_capacity} + 1),
      pair_count_(context, 1),
      begins_(context, std::size_t{tile_count_} + 1),
      elements_(context, sample_count(options)),
      depths_(context, sample_count(options)) {
  resize_pairs(context, 2 * options.triangle_capacity + tile_count_);
}

void TileRasterizer::resize_pairs(Context& context, std::uint32_t pairs) {
  pair_capacity_ = pairs;
  keys_ = {};
  values_ = {};
  tile_triangles_ = {};
  sort_.reset();
  keys_ = Buffer<std::uint32_t>(context, pairs);
  values_ = Buffer<std::uint32_t>(context, pairs);
  tile_triangles_ = Buffer<TileTriangle>(context, pairs);
  sort_.emplace(context, pairs);
}

void TileRasterizer::record_lists(Commands& commands, const TriangleSource& source) {
  if (source.triangle_count > options_.triangle_capacity || source.first_element < 1)
    refuse("triangle_count is " + std::to_string(source.triangle_count) + ", first_element is " +
           std::to_string(source.first_element) + ", must be at most " +
           std::to_string(options_.triangle_capacity) + " and at least 1");
  const std::uint32_t triangles = source.triangle_count;
  commands.dispatch(count_, {triangles + 1}, {source, target_, offsets_});
  prefix_sum_.record(commands, offsets_, triangles + 1);
  commands.copy(offsets_, pair_count_, triangles, 0, 1);
  if (triangles > 0)
    commands.dispatch(emit_, {triangles},
                      {source, target_, offsets_, keys_, values_, pair_capacity_, 0});
  sort_->record(commands, pair_count_, keys_, values_,
                std::uint32_t(std::bit_width(tile_count_ - 1)));
  commands.dispatch(range_, {tile_count_ + 1},
                    {pair_count_, keys_, begins_, pair_capacity_, tile_count_});
  commands.dispatch(setup_, {pair_capacity_},
                    {source, target_, pair_count_, keys_, values_, tile_triangles_, pair_capacity_,
                     std::uint32_t(options_.depth)});
}

void TileRasterizer::record(Commands& commands, const TriangleSource& source) {
  record_lists(commands, source);
  raster(commands, visibility_, {});
}

void TileRasterizer::record_coverage(Commands& commands, const TriangleSource& source,
                                     const Buffer<std::uint32_t>& counts) {
  if (counts.count() < elements_.count())
    refuse("counts holds " + std::to_string(counts.count()) + ", must hold " +
           std::to_string(elements_.count()));
  record_lists(commands, source);
  raster(commands, coverage_, counts);
}

void TileRasterizer::raster(Commands& commands, const Kernel<TileRasterArgs>& kernel,
                            BufferRef<std::uint32_t> counts) {
  const bool logarithmic = options_.depth == DepthMode::logarithmic;
  const std::uint32_t threads = tile_side * tile_side * std::uint32_t(options_.samples) / held_;
  commands.dispatch(
      kernel, {tile_count_ * threads},
      {.begins = begins_,
       .triangles = tile_triangles_,
       .elements = elements_,
       .depths = depths_,
       .counts = counts,
       .width = target_.width,
       .height = target_.height,
       .tiles_x = target_.tiles_x,
       .tile_count = tile_count_,
       .log_scale = logarithmic ? float(-1 / std::log2(double(options_.far) / options_.near)) : 0,
       .log_near = options_.near});
}

bool TileRasterizer::fit(Context& context) {
  const std::uint32_t pairs = pair_count_.read()[0];
  if (pairs <= pair_capacity_) return true;
  resize_pairs(context, pairs + pairs / 4);
  return false;
}

}  // namespace parity::gpu
