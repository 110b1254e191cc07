#include "cpu_reference/raster/band.h"

namespace parity::cpu {

const ElementSurface& SurfaceCache::of(std::uint32_t draw, std::uint32_t element) {
  Entry& entry = entries_[element % entry_count];
  if (entry.element != element) {
    entry.surface = element_surface(job_.elements.draws[draw], element, job_.textures, job_.frame);
    entry.element = element;
  }
  return entry.surface;
}

Band::Band(const RenderJob& job, PixelBox box) : job_(job), box_(box), surfaces_(job) {
  const std::size_t samples =
      std::size_t(box.right) * std::size_t(box.bottom - box.top) * job.places.size();
  Front empty;
  empty.depth = job.depth.cleared();
  front_.assign(samples, empty);
  const dvec4 background{job.frame.options.background};
  color_.assign(samples, dvec4(dvec3(background) * background.w, background.w));
}

/// The samples of a mask that pass the depth test.
std::uint32_t Band::visible(const ElementDepth& depth, int x, int y, std::uint32_t mask) const {
  const std::size_t first = first_sample(x, y);
  std::uint32_t passed = 0;
  for (std::size_t s = 0; s < job_.places.size(); ++s)
    if ((mask >> s & 1) && job_.depth.passes(depth(x, y, job_.places[s]), front_[first + s].depth))
      passed |= 1u << s;
  return passed;
}

void Band::draw_opaque(const Piece& piece) {
  const PlacedDraw& placed = job_.elements.draws[piece.draw];
  const std::uint32_t element = piece.shape.triangle;
  const bool masked = placed.material->alpha_mode == AlphaMode::mask &&
                      placed.primitive->topology == Topology::triangles;
  const ElementDepth depth(
      masked ? surfaces_.of(piece.draw, element).planes
             : element_planes(placed, element, job_.frame.options.width, job_.frame.options.height),
      job_.depth);
  rasterize_triangle(piece.shape, job_.elements.grid, box_, [&](int x, int y, std::uint32_t mask) {
    const std::uint32_t passed = visible(depth, x, y, mask);
    if (passed == 0) return;
    if (masked &&
        alpha_at(surfaces_.of(piece.draw, element), x, y) < double(placed.material->alpha_cutoff))
      return;
    const std::size_t first = first_sample(x, y);
    for (std::size_t s = 0; s < job_.places.size(); ++s)
      if (passed >> s & 1)
        front_[first + s] = {depth(x, y, job_.places[s]), element, piece.draw, !piece.shape.front};
  });
}

void Band::shade_pixel(int x, int y) {
  const std::size_t first = first_sample(x, y);
  std::uint32_t last = no_element;
  dvec4 color{0.0};
  for (std::size_t i = first; i < first + job_.places.size(); ++i) {
    const Front& f = front_[i];
    if (f.element == no_element) continue;
    if (f.element != last) {
      const auto shaded = shade_at(surfaces_.of(f.draw, f.element), job_.lights, x, y, f.back);
      color = {shaded.rgb[0], shaded.rgb[1], shaded.rgb[2], 1.0};
      last = f.element;
    }
    color_[i] = color;
  }
}

void Band::shade() {
  for (int y = box_.top; y < box_.bottom; ++y)
    for (int x = box_.left; x < box_.right; ++x) shade_pixel(x, y);
}

void Band::draw_blended(const Piece& piece) {
  const ElementSurface& surface = surfaces_.of(piece.draw, piece.shape.triangle);
  const ElementDepth depth(surface.planes, job_.depth);
  rasterize_triangle(piece.shape, job_.elements.grid, box_, [&](int x, int y, std::uint32_t mask) {
    const std::uint32_t passed = visible(depth, x, y, mask);
    if (passed == 0) return;
    const auto source = shade_at(surface, job_.lights, x, y, !piece.shape.front);
    const dvec4 premultiplied{source.rgb[0] * source.alpha, source.rgb[1] * source.alpha,
                              source.rgb[2] * source.alpha, source.alpha};
    const std::size_t first = first_sample(x, y);
    for (std::size_t s = 0; s < job_.places.size(); ++s)
      if (passed >> s & 1)
        color_[first + s] = premultiplied + color_[first + s] * (1 - source.alpha);
  });
}

void Band::store(Rendered& rendered) const {
  Picture& picture = rendered.picture;
  const double share = 1.0 / double(job_.places.size());
  for (int y = box_.top; y < box_.bottom; ++y)
    for (int x = box_.left; x < box_.right; ++x) {
      const std::size_t first = first_sample(x, y);
      dvec4 sum{0.0};
      for (std::size_t s = 0; s < job_.places.size(); ++s) sum += color_[first + s];
      picture.color(x, y) = vec4(sum * share);
      picture.depth(x, y) = front_[first].depth;
      if (job_.options.elements) picture.element(x, y) = front_[first].element + 1;
    }
}

}  // namespace parity::cpu
