#include "cpu_reference/raster/elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/painter.h"

namespace parity::cpu {
namespace {

const Material default_material{};

void check(const Primitive& p) {
  for (const std::uint32_t i : p.indices)
    if (i >= p.positions.size())
      throw std::invalid_argument("cpu::render: an index is " + std::to_string(i) +
                                  ", must be less than the " + std::to_string(p.positions.size()) +
                                  " positions");
}

std::uint32_t corner_count(Topology topology) {
  return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
}

/// ((c0 x + c1 y) + c2 z) + c3 in float, in this order: positions decide what covers what.
std::vector<vec4> transform(const mat4& clip_from_object, const std::vector<vec3>& positions) {
  std::vector<vec4> clip(positions.size());
  const vec4 c0 = clip_from_object[0], c1 = clip_from_object[1];
  const vec4 c2 = clip_from_object[2], c3 = clip_from_object[3];
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const vec3 p = positions[i];
    clip[i] = ((c0 * p.x + c1 * p.y) + c2 * p.z) + c3;
  }
  return clip;
}

std::vector<PlacedDraw> place_draws(const Scene& scene, const Frame& frame) {
  std::vector<PlacedDraw> placed;
  placed.reserve(frame.draws.size());
  std::uint64_t first = 0;
  for (const Draw& draw : frame.draws) {
    PlacedDraw p;
    p.draw = &draw;
    p.primitive = &scene.meshes[std::size_t(draw.mesh)].primitives[std::size_t(draw.primitive)];
    check(*p.primitive);
    p.material =
        draw.material < 0 ? &default_material : &scene.materials[std::size_t(draw.material)];
    p.first_element = std::uint32_t(first);
    p.element_count =
        std::uint32_t(p.primitive->indices.size() / corner_count(p.primitive->topology));
    first += p.element_count;
    if (first >= 0x7fffffff)
      throw std::invalid_argument("cpu::render: the frame has more than 2147483647 elements");
    placed.push_back(std::move(p));
  }
  return placed;
}

std::vector<SnappedTriangle> triangle_pieces(const PlacedDraw& placed, const FrameOptions& o,
                                             Snapping snapping) {
  TriangleList list;
  list.width = o.width;
  list.height = o.height;
  list.samples = o.samples;
  list.clip_positions = placed.clip;
  list.cull = placed.material->double_sided ? Cull::none : Cull::back;
  const auto& indices = placed.primitive->indices;
  list.triangles.reserve(placed.element_count);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    list.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  return set_up(list, snapping, placed.draw->mirrored);
}

/// A position in the window on the grid of the device.
ivec2 on_grid(dvec2 window, const SampleGrid& grid, int samples) {
  const dvec2 place = dvec2(standard_sample_places(samples)[0]) / 16.0;
  const dvec2 step = (window - place) * double(grid.steps) + dvec2(grid.places[0]);
  return {int(std::nearbyint(step.x)), int(std::nearbyint(step.y))};
}

/// A rectangle a, b, c, d around its border as two triangles of positive area.
void add_rectangle(std::vector<SnappedTriangle>& to, const std::array<ivec2, 4>& corners,
                   std::uint32_t element) {
  for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
    std::array<ivec2, 3> t{corners[0], corners[std::size_t(b)], corners[std::size_t(c)]};
    const ivec2 u = t[1] - t[0], v = t[2] - t[0];
    const std::int64_t area = std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x;
    if (area == 0) continue;
    if (area < 0) std::swap(t[1], t[2]);
    to.push_back({t, element, true});
  }
}

bool inside_view(vec4 p) {
  return p.w > 0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0 && p.z <= p.w;
}

/// Rectangles of width 1 px around lines, squares of 1 px around points.
/// Source: Vulkan 1.3, "Basic Line Segment Rasterization" (strict), "Basic Point Rasterization".
std::vector<SnappedTriangle> line_and_point_pieces(const PlacedDraw& placed, const FrameOptions& o,
                                                   const SampleGrid& grid) {
  std::vector<SnappedTriangle> pieces;
  for (std::uint32_t i = 0; i < placed.element_count; ++i) {
    const std::array<vec4, 3> corner = clip_corners(placed, placed.first_element + i);
    dvec2 a, b, half;
    if (placed.primitive->topology == Topology::points) {
      if (!inside_view(corner[0]) || std::isinf(corner[0].w)) continue;
      const dvec2 center = window_of(dvec4(corner[0]), o.width, o.height);
      a = center - dvec2(0.5, 0.0);
      b = center + dvec2(0.5, 0.0);
      half = {0.0, 0.5};
    } else {
      const ClippedLine line = clip_line(corner[0], corner[1]);
      if (line.empty) continue;
      a = window_of(line.ends[0], o.width, o.height);
      b = window_of(line.ends[1], o.width, o.height);
      const double length = glm::length(b - a);
      if (!(length > 0) || !std::isfinite(length)) continue;
      half = dvec2(a.y - b.y, b.x - a.x) * (0.5 / length);
    }
    const auto corner_at = [&](dvec2 p) { return on_grid(p, grid, o.samples); };
    add_rectangle(
        pieces,
        {corner_at(a - half), corner_at(b - half), corner_at(b + half), corner_at(a + half)}, i);
  }
  return pieces;
}

/// How far the middle of a triangle is, larger first; decides the order of blending, in float.
float painter_key(const PlacedDraw& placed, std::uint32_t triangle, const Frame& frame) {
  const auto& indices = placed.primitive->indices;
  const auto& positions = placed.primitive->positions;
  const std::size_t i = std::size_t(triangle) * 3;
  const vec3 middle =
      ((positions[indices[i]] + positions[indices[i + 1]]) + positions[indices[i + 2]]) *
      (1.0f / 3.0f);
  const mat4& m = placed.draw->clip_from_object;
  const vec4 clip = ((m[0] * middle.x + m[1] * middle.y) + m[2] * middle.z) + m[3];
  const bool nearer_is_more = frame.options.depth == DepthMode::reverse_z;
  const float key = !frame.orthographic ? clip.w : nearer_is_more ? -clip.z : clip.z;
  return std::isnan(key) ? 0.0f : key;
}

/// The vertex stage and the pieces of each draw. Scenes of many draws are spread over the threads
/// draw by draw; the loops inside of a lone draw are parallel themselves.
std::vector<std::vector<SnappedTriangle>> draw_pieces(Elements& elements, const FrameOptions& o,
                                                      Snapping snapping) {
  std::vector<std::vector<SnappedTriangle>> pieces(elements.draws.size());
#pragma omp parallel for schedule(dynamic) if (elements.draws.size() > 1)
  for (std::size_t d = 0; d < elements.draws.size(); ++d) {
    PlacedDraw& placed = elements.draws[d];
    placed.clip = transform(placed.draw->clip_from_object, placed.primitive->positions);
    pieces[d] = placed.primitive->topology == Topology::triangles
                    ? triangle_pieces(placed, o, snapping)
                    : line_and_point_pieces(placed, o, elements.grid);
  }
  return pieces;
}

/// Blended pieces in the order of the scene, each with its key.
struct Unsorted {
  std::vector<Piece> pieces;
  std::vector<float> keys;
};

void append(Elements& elements, Unsorted& blended, std::uint32_t draw,
            const std::vector<SnappedTriangle>& pieces, const Frame& frame) {
  const PlacedDraw& placed = elements.draws[draw];
  const bool blends =
      placed.primitive->topology == Topology::triangles && is_blended(*placed.material);
  for (SnappedTriangle shape : pieces) {
    if (blends) blended.keys.push_back(painter_key(placed, shape.triangle, frame));
    shape.triangle += placed.first_element;
    (blends ? blended.pieces : elements.opaque).push_back({shape, draw});
  }
}

/// The cut of a segment against one plane: keeps where the distance is not negative.
void cut(double from, double to, std::array<double, 2>& at, bool& empty) {
  if (from < 0 && to < 0) empty = true;
  if (from < 0 && to >= 0) at[0] = std::max(at[0], from / (from - to));
  if (from >= 0 && to < 0) at[1] = std::min(at[1], from / (from - to));
}

}  // namespace

Elements place_elements(const Scene& scene, const Frame& frame, Snapping snapping) {
  const FrameOptions& o = frame.options;
  Elements elements;
  elements.draws = place_draws(scene, frame);
  elements.grid = sample_grid(o.samples, snapping);
  const std::vector<std::vector<SnappedTriangle>> pieces = draw_pieces(elements, o, snapping);
  Unsorted blended;
  for (std::uint32_t d = 0; d < elements.draws.size(); ++d) {
    const PlacedDraw& placed = elements.draws[d];
    if (placed.primitive->topology == Topology::triangles)
      elements.triangle_count += placed.element_count;
    append(elements, blended, d, pieces[d], frame);
  }
  elements.blended.reserve(blended.pieces.size());
  for (const std::uint32_t i : painter_order(blended.keys))
    elements.blended.push_back(blended.pieces[i]);
  return elements;
}

bool is_masked(const PlacedDraw& draw) {
  return draw.material->alpha_mode == AlphaMode::mask &&
         draw.primitive->topology == Topology::triangles;
}

ClippedLine clip_line(vec4 from, vec4 to) {
  const dvec4 a{from}, b{to};
  ClippedLine line;
  line.empty = false;
  constexpr double smallest_w = 1.1754943508222875e-38;
  cut(a.w - smallest_w, b.w - smallest_w, line.at, line.empty);
  cut(a.z, b.z, line.at, line.empty);
  cut(a.w - a.z, b.w - b.z, line.at, line.empty);
  for (int axis = 0; axis < 2; ++axis) {
    cut(a.w + a[axis], b.w + b[axis], line.at, line.empty);
    cut(a.w - a[axis], b.w - b[axis], line.at, line.empty);
  }
  if (!(line.at[0] < line.at[1])) line.empty = true;
  for (std::size_t i = 0; i < 2; ++i) line.ends[i] = a + (b - a) * line.at[i];
  if (!(line.ends[0].w > 0) || !(line.ends[1].w > 0)) line.empty = true;
  return line;
}

std::array<std::uint32_t, 3> element_vertices(const PlacedDraw& draw, std::uint32_t element) {
  const std::uint32_t corners = corner_count(draw.primitive->topology);
  const std::size_t first = std::size_t(element - draw.first_element) * corners;
  std::array<std::uint32_t, 3> vertices{};
  for (std::uint32_t i = 0; i < 3; ++i)
    vertices[i] = draw.primitive->indices[first + std::min(i, corners - 1)];
  return vertices;
}

std::array<vec4, 3> clip_corners(const PlacedDraw& draw, std::uint32_t element) {
  const auto v = element_vertices(draw, element);
  return {draw.clip[v[0]], draw.clip[v[1]], draw.clip[v[2]]};
}

dvec2 window_of(dvec4 clip, int width, int height) {
  return (dvec2(clip) / clip.w + 1.0) * 0.5 * dvec2(double(width), double(height));
}

}  // namespace parity::cpu
