#include "cpu_reference/raster/band.h"

#include "cpu_reference/raster/border.h"

namespace parity::cpu {

SurfaceCache::Entry& SurfaceCache::entry(ElementName name) {
  Entry& entry = entries_[name.element % entry_count];
  if (entry.element != name.element) {
    entry.surface =
        element_surface(job_.elements.draws[name.draw], name.element, job_.textures, job_.frame);
    entry.element = name.element;
    entry.error.reset();
  }
  return entry;
}

const ElementError& SurfaceCache::error_of(ElementName name) {
  Entry& e = entry(name);
  if (!e.error)
    e.error.emplace(job_.elements.draws[name.draw], name.element, e.surface.planes, job_.frame,
                    job_.options.device);
  return *e.error;
}

Band::Band(const RenderJob& job, PixelBox box) : job_(job), box_(box), surfaces_(job) {
  const std::size_t pixels = std::size_t(box.right) * std::size_t(box.bottom - box.top);
  Front empty;
  empty.depth = job.depth.cleared();
  front_.assign(pixels * job.places.size(), empty);
  const dvec4 given{job.frame.options.background};
  const dvec4 background{dvec3(given) * given.w, given.w};
  color_.assign(pixels * job.places.size(), background);
  if (!job.options.bounds) return;
  doubt_.emplace(pixels, job.places.size(), job.depth.distance(job.depth.cleared()),
                 job.options.device.half_color ? 0x1p-10 : 0x1p-23);
  for (std::size_t i = 0; i < color_.size(); ++i) doubt_->set_color(i, background, dvec4(0.0));
}

DepthRange Band::depth_range(ElementName name, const ElementDepth& depth, int x, int y,
                             std::size_t sample) {
  const dvec2 place = job_.places[sample];
  const double distance = job_.depth.distance(depth(x, y, place));
  const double error = surfaces_.error_of(name).depth(x, y, place, job_.depth);
  return {distance - error, distance + error};
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

bool Band::passes_mask(ElementName name, int x, int y) {
  const Material& material = *job_.elements.draws[name.draw].material;
  return alpha_at(surfaces_.of(name), x, y) >= double(material.alpha_cutoff);
}

/// Tells that an element may be seen at the samples of a mask.
void Band::contend(ElementName name, const ElementDepth& depth, int x, int y, std::uint32_t mask) {
  const PlacedDraw& placed = job_.elements.draws[name.draw];
  bool maybe = false;
  if (is_masked(placed)) {
    const BoundedColor alpha =
        alpha_with_bound(placed, name.element, surfaces_.of(name), surfaces_.error_of(name),
                         job_.options.device, x, y);
    const double over = alpha.value.w - double(placed.material->alpha_cutoff);
    maybe = std::abs(over) <= alpha.bound.w || alpha.in_doubt;
    if (over < 0 && !maybe) return;
  }
  const std::size_t first = first_sample(x, y);
  for (std::size_t s = 0; s < job_.places.size(); ++s)
    if (mask >> s & 1) {
      const DepthRange range = depth_range(name, depth, x, y, s);
      doubt_->contend(first + s, name.element, range, false);
      if (maybe) doubt_->contend(first + s, name.element, range, true);
    }
}

void Band::draw_opaque(const Piece& piece) {
  const PlacedDraw& placed = job_.elements.draws[piece.draw];
  const ElementName name{piece.draw, piece.shape.triangle};
  const bool masked = is_masked(placed);
  const ElementDepth depth(masked ? surfaces_.of(name).planes
                                  : element_planes(placed, name.element, job_.frame.options.width,
                                                   job_.frame.options.height),
                           job_.depth);
  rasterize_triangle(piece.shape, job_.elements.grid, box_, [&](int x, int y, std::uint32_t mask) {
    if (doubt_) contend(name, depth, x, y, mask);
    const std::uint32_t passed = visible(depth, x, y, mask);
    if (passed == 0 || (masked && !passes_mask(name, x, y))) return;
    const std::size_t first = first_sample(x, y);
    for (std::size_t s = 0; s < job_.places.size(); ++s) {
      if ((passed >> s & 1) == 0) continue;
      front_[first + s] = {depth(x, y, job_.places[s]), name.element, name.draw,
                           !piece.shape.front};
      if (doubt_) doubt_->set_front(first + s, name.element, depth_range(name, depth, x, y, s));
    }
  });
}

/// Colour of an element at a pixel; with its bound if bounds are asked for.
BoundedColor Band::shaded(ElementName name, int x, int y, bool back) {
  const ElementSurface& surface = surfaces_.of(name);
  if (!doubt_) {
    const Shaded<double> s = shade_at(surface, job_.lights, x, y, back);
    return {dvec4(s.rgb[0], s.rgb[1], s.rgb[2], s.alpha), dvec4(0.0), false};
  }
  const BoundedColor color =
      shade_with_bound(job_.elements.draws[name.draw], name.element, surface,
                       surfaces_.error_of(name), job_.lights, job_.options.device, x, y, back);
  if (color.in_doubt) doubt_->mark(pixel_index(x, y));
  return color;
}

void Band::shade_pixel(int x, int y) {
  const std::size_t first = first_sample(x, y);
  std::uint32_t last = no_element;
  BoundedColor color;
  for (std::size_t i = first; i < first + job_.places.size(); ++i) {
    const Front& f = front_[i];
    if (f.element == no_element) continue;
    if (f.element != last) {
      color = shaded({f.draw, f.element}, x, y, f.back);
      color.value.w = 1.0;
      color.bound.w = 0.0;
      last = f.element;
    }
    color_[i] = color.value;
    if (doubt_) doubt_->set_color(i, color.value, color.bound);
  }
}

void Band::shade() {
  for (int y = box_.top; y < box_.bottom; ++y)
    for (int x = box_.left; x < box_.right; ++x) shade_pixel(x, y);
}

void Band::draw_blended(const Piece& piece) {
  const ElementName name{piece.draw, piece.shape.triangle};
  const ElementDepth depth(surfaces_.of(name).planes, job_.depth);
  rasterize_triangle(piece.shape, job_.elements.grid, box_, [&](int x, int y, std::uint32_t mask) {
    const std::size_t first = first_sample(x, y);
    for (std::size_t s = 0; doubt_ && s < job_.places.size(); ++s)
      if ((mask >> s & 1) && doubt_->undecided(first + s, depth_range(name, depth, x, y, s)))
        doubt_->mark(pixel_index(x, y));
    const std::uint32_t passed = visible(depth, x, y, mask);
    if (passed == 0) return;
    const BoundedColor layer = shaded(name, x, y, !piece.shape.front);
    const dvec4 source{dvec3(layer.value) * layer.value.w, layer.value.w};
    for (std::size_t s = 0; s < job_.places.size(); ++s) {
      if ((passed >> s & 1) == 0) continue;
      const dvec4 before = color_[first + s];
      color_[first + s] = source + before * (1 - layer.value.w);
      if (doubt_) doubt_->blend(first + s, layer.value, layer.bound, before, color_[first + s]);
    }
  });
}

void Band::doubt_border(ElementName name, bool blended) {
  const Planes planes = surfaces_.of(name).planes;
  const ElementError error = surfaces_.error_of(name);
  const ElementBorder border(job_.elements.draws[name.draw], name.element, planes, error,
                             job_.frame);
  const ElementDepth depth(planes, job_.depth);
  const PixelBox& box = border.box();
  for (int y = std::max(box.top, box_.top); y < std::min(box.bottom, box_.bottom); ++y)
    for (int x = box.left; x < box.right; ++x)
      for (std::size_t s = 0; s < job_.places.size(); ++s) {
        if (!border.in_doubt(x + job_.places[s].x, y + job_.places[s].y)) continue;
        const std::size_t sample = first_sample(x, y) + s;
        const DepthRange range = depth_range(name, depth, x, y, s);
        if (!blended)
          doubt_->contend(sample, name.element, range, true);
        else if (doubt_->may_be_seen(sample, range))
          doubt_->mark(pixel_index(x, y));
      }
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
      if (!doubt_) continue;
      const std::size_t pixel = pixel_index(x, y);
      rendered.color_bound(x, y) = vec4(doubt_->color_bound(pixel, sum * share));
      rendered.depth_bound(x, y) = float(doubt_->depth_bound(first));
      rendered.ambiguous(x, y) = doubt_->ambiguous(pixel);
    }
}

}  // namespace parity::cpu
