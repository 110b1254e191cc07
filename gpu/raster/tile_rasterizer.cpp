#include "gpu/raster/tile_rasterizer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/raster/raster_target.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr int greatest_side = 16384;
constexpr std::uint32_t greatest_triangle_count = 1u << 28;

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
  return context.info().type == "cpu" ? std::min(32u, 8 * std::uint32_t(samples))
                                      : std::uint32_t(samples);
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
      pieces_(context, target_, std::uint32_t(options.depth), options.triangle_capacity),
      pair_count_(context, 1),
      begins_(context, std::size_t{tile_count_} + 1),
      elements_(context, sample_count(options)),
      depths_(context, sample_count(options)) {
  resize_pieces(context);
  resize_pairs(context, 2 * options.triangle_capacity + tile_count_);
}

void TileRasterizer::resize_pieces(Context& context) {
  const std::size_t count = std::size_t{pieces_.capacity()} + 1;
  offsets_ = {};
  offsets_ = Buffer<std::uint32_t>(context, count);
  prefix_sum_.emplace(context, count);
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
  pieces_.record(commands, source);
  const std::uint32_t pieces = pieces_.capacity();
  commands.dispatch(count_, {pieces + 1},
                    {target_, pieces_.count(), pieces_.pieces(), offsets_, pieces, 0});
  prefix_sum_->record(commands, offsets_, pieces + 1);
  commands.copy(offsets_, pair_count_, pieces, 0, 1);
  commands.dispatch(emit_, {pieces},
                    {target_, pieces_.count(), pieces_.pieces(), offsets_, keys_, values_, pieces,
                     pair_capacity_});
  sort_->record(commands, pair_count_, keys_, values_,
                std::uint32_t(std::bit_width(tile_count_ - 1)));
  commands.dispatch(range_, {tile_count_ + 1},
                    {pair_count_, keys_, begins_, pair_capacity_, tile_count_});
  commands.dispatch(setup_, {pair_capacity_},
                    {pair_count_, keys_, values_, pieces_.pieces(), tile_triangles_, pair_capacity_,
                     target_.tiles_x});
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
  if (!pieces_.fit(context)) {
    resize_pieces(context);
    return false;
  }
  const std::uint32_t pairs = pair_count_.read()[0];
  if (pairs <= pair_capacity_) return true;
  resize_pairs(context, pairs + pairs / 4);
  return false;
}

}  // namespace parity::gpu
