#include "cpu_reference/raster/renderer.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/band.h"
#include "cpu_reference/raster/border.h"

namespace parity::cpu {
namespace {

constexpr int band_rows = 16;

void check(const Frame& frame) {
  const FrameOptions& o = frame.options;
  if (o.width < 1 || o.height < 1 || o.width > 16384 || o.height > 16384)
    throw std::invalid_argument("cpu::render: size is " + std::to_string(o.width) + "x" +
                                std::to_string(o.height) + ", sides must be 1 to 16384");
  if (o.depth == DepthMode::logarithmic && (!(frame.far > frame.near) || !(frame.near > 0)))
    throw std::invalid_argument("cpu::render: logarithmic depth from " +
                                std::to_string(frame.near) + " to " + std::to_string(frame.far) +
                                ", must be from above 0 to a finite far plane beyond");
}

/// Seconds since the last call, by name.
class PassClock {
 public:
  explicit PassClock(Picture& picture) : picture_(picture) {}
  void finish(const char* pass) {
    const auto now = std::chrono::steady_clock::now();
    picture_.pass_seconds.emplace_back(pass, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  Picture& picture_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Which pieces reach which band, in their order.
using Bins = std::vector<std::vector<std::uint32_t>>;

Bins bin(const std::vector<Piece>& pieces, const Elements& elements, const FrameOptions& o) {
  Bins bins(std::size_t((o.height + band_rows - 1) / band_rows));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PixelBox box = pixel_box(pieces[i].shape, elements.grid, {0, 0, o.width, o.height});
    if (box.empty()) continue;
    for (int b = box.top / band_rows; b <= (box.bottom - 1) / band_rows; ++b)
      bins[std::size_t(b)].push_back(std::uint32_t(i));
  }
  return bins;
}

/// Elements whose borders are in doubt, by the bands they reach.
using DoubtBins = std::vector<std::vector<ElementName>>;

void add_doubt(const RenderJob& job, ElementName name, DoubtBins& bins) {
  const PlacedDraw& placed = job.elements.draws[name.draw];
  const FrameOptions& o = job.frame.options;
  const Planes planes = element_planes(placed, name.element, o.width, o.height);
  const ElementError error(placed, name.element, planes, job.frame, job.options.device);
  const PixelBox box = ElementBorder(placed, name.element, planes, error, job.frame).box();
  if (box.empty()) return;
  for (int b = box.top / band_rows; b <= (box.bottom - 1) / band_rows; ++b)
    bins[std::size_t(b)].push_back(name);
}

/// Triangles count where they have pieces (culled ones have none), lines and points always.
DoubtBins doubtful_borders(const RenderJob& job, const std::vector<Piece>& pieces,
                           bool lines_and_points) {
  DoubtBins bins(std::size_t((job.frame.options.height + band_rows - 1) / band_rows));
  if (!job.options.bounds) return bins;
  std::uint32_t last = 0xffffffff;
  for (const Piece& piece : pieces) {
    const PlacedDraw& placed = job.elements.draws[piece.draw];
    const std::uint32_t element = piece.shape.triangle;
    if (element == last || placed.primitive->topology != Topology::triangles) continue;
    last = element;
    if (has_doubtful_border(placed, element)) add_doubt(job, {piece.draw, element}, bins);
  }
  for (std::uint32_t d = 0; lines_and_points && d < job.elements.draws.size(); ++d) {
    const PlacedDraw& placed = job.elements.draws[d];
    if (placed.primitive->topology == Topology::triangles) continue;
    for (std::uint32_t i = 0; i < placed.element_count; ++i)
      add_doubt(job, {d, placed.first_element + i}, bins);
  }
  return bins;
}

/// What each band draws.
struct BandWork {
  Bins opaque;
  Bins blended;
  DoubtBins opaque_doubt;
  DoubtBins blended_doubt;
};

void draw_band(const RenderJob& job, int band, const BandWork& work, Rendered& rendered) {
  const FrameOptions& o = job.frame.options;
  const PixelBox box{0, band * band_rows, o.width, std::min(o.height, (band + 1) * band_rows)};
  const std::size_t b = std::size_t(band);
  Band rows(job, box);
  for (const std::uint32_t piece : work.opaque[b]) rows.draw_opaque(job.elements.opaque[piece]);
  for (const ElementName& name : work.opaque_doubt[b]) rows.doubt_border(name, false);
  if (job.options.colors) rows.shade();
  for (const std::uint32_t piece : work.blended[b]) rows.draw_blended(job.elements.blended[piece]);
  for (const ElementName& name : work.blended_doubt[b]) rows.doubt_border(name, true);
  rows.store(rendered);
}

void draw_bands(const RenderJob& job, const std::function<void(double)>& progress,
                Rendered& rendered) {
  const Elements& e = job.elements;
  const BandWork work{bin(e.opaque, e, job.frame.options), bin(e.blended, e, job.frame.options),
                      doubtful_borders(job, e.opaque, true),
                      doubtful_borders(job, e.blended, false)};
  const int count = int(work.opaque.size());
  int done = 0;
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic)
  for (int b = 0; b < count; ++b) {
    try {
      draw_band(job, b, work, rendered);
#pragma omp critical(parity_render_progress)
      if (progress) progress(double(++done) / count);
    } catch (...) {
#pragma omp critical(parity_render_failure)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

Rendered blank(const FrameOptions& o, const RenderOptions& options) {
  Rendered r;
  r.picture.color = {o.width, o.height};
  r.picture.depth = {o.width, o.height};
  if (options.elements) r.picture.element = {o.width, o.height};
  if (options.bounds) {
    r.color_bound = {o.width, o.height};
    r.depth_bound = {o.width, o.height};
    r.ambiguous = {o.width, o.height};
  }
  return r;
}

std::uint64_t memory_bytes(const Elements& elements) {
  std::uint64_t bytes = (elements.opaque.size() + elements.blended.size()) * sizeof(Piece);
  for (const PlacedDraw& draw : elements.draws) bytes += draw.clip.size() * sizeof(vec4);
  return bytes;
}

std::vector<dvec2> sample_places_in_pixels(int samples) {
  std::vector<dvec2> places;
  for (const ivec2 place : standard_sample_places(samples)) places.push_back(dvec2(place) / 16.0);
  return places;
}

}  // namespace

Rendered render(const Scene& scene, const Frame& frame, const RenderOptions& options,
                const std::function<void(double)>& progress) {
  check(frame);
  const FrameOptions& o = frame.options;
  Rendered rendered = blank(o, options);
  PassClock clock(rendered.picture);
  const std::vector<dvec2> places = sample_places_in_pixels(o.samples);
  const Elements elements = place_elements(scene, frame, options.snapping);
  clock.finish("vertices");
  const SceneTextures textures(scene, frame, options.bounds ? options.device.mip_codes : 0.0);
  clock.finish("textures");
  const RenderJob job{
      frame, options, elements, textures, shading_scene(frame), {o.depth, frame.near, frame.far},
      places};
  draw_bands(job, progress, rendered);
  clock.finish("raster");
  rendered.picture.triangle_count = elements.triangle_count;
  rendered.picture.memory_bytes = textures.memory_bytes() + memory_bytes(elements);
  return rendered;
}

}  // namespace parity::cpu
