#include "tests/raster/triangles.h"

#include <algorithm>
#include <cmath>

#include "geometry/random.h"

namespace parity::raster_test {
namespace {

/// The clip position that falls on a place of the window.
vec4 clip_at(vec2 pixel, int side, float w, float depth) {
  const vec2 ndc = pixel * (2.0f / float(side)) - 1.0f;
  return {ndc.x * w, ndc.y * w, depth * w, w};
}

class Maker {
 public:
  Maker(int side, std::uint64_t seed) : side_(side), random_(seed) {
    list_.width = list_.height = side;
  }

  void add(const vec2 (&corners)[3], bool perspective) {
    const auto first = std::uint32_t(list_.clip_positions.size());
    for (const vec2& corner : corners) {
      const float w = perspective ? random_.uniform(0.5f, 4.0f) : 1.0f;
      list_.clip_positions.push_back(clip_at(corner, side_, w, random_.uniform(0.1f, 0.9f)));
    }
    list_.triangles.push_back({first, first + 1, first + 2});
  }

  vec2 inside(float border = 0.25f) {
    const float high = float(side_) - border;
    return {random_.uniform(border, high), random_.uniform(border, high)};
  }
  vec2 clamp(vec2 p) const { return glm::clamp(p, vec2(0.25f), vec2(float(side_) - 0.25f)); }
  vec2 sixteenths(vec2 p) const {
    return glm::clamp(glm::round(p * 16.0f), vec2(1.0f), vec2(float(side_) * 16 - 1)) / 16.0f;
  }

  void random_triangle() { add({inside(), inside(), inside()}, true); }
  void sliver() {
    const vec2 a = inside();
    const vec2 b = inside();
    add({a, b, clamp(a + vec2(random_.uniform(-1, 1), random_.uniform(-1, 1)))}, true);
  }
  void tie() {
    vec2 a = sixteenths(inside());
    vec2 b = sixteenths(inside());
    vec2 c = sixteenths(inside());
    if (random_.below(2)) b.y = a.y;
    if (random_.below(2)) c.x = a.x;
    add({a, b, c}, false);
  }
  void subpixel() {
    const vec2 a = inside();
    const auto near = [&] {
      return clamp(a + vec2(random_.uniform(-0.7f, 0.7f), random_.uniform(-0.7f, 0.7f)));
    };
    add({a, near(), near()}, true);
  }
  void off_screen() {
    const float far = float(side_) * random_.uniform(1.1f, 3.0f);
    const vec2 shift = random_.below(2) ? vec2(random_.below(2) ? far : -far, 0)
                                        : vec2(0, random_.below(2) ? far : -far);
    add({inside() + shift, inside() + shift, inside() + shift}, true);
  }
  void behind() {
    random_triangle();
    for (std::size_t i = list_.clip_positions.size() - 3; i < list_.clip_positions.size(); ++i)
      list_.clip_positions[i] = -list_.clip_positions[i];
  }

  /// Squares of a jittered grid cut in two; the border stays inside the viewport.
  void mesh(int count) {
    const int cells = std::max(1, int(std::sqrt(count / 2.0)));
    const float step = (float(side_) - 1.0f) / float(cells);
    const auto first = std::uint32_t(list_.clip_positions.size());
    for (int y = 0; y <= cells; ++y)
      for (int x = 0; x <= cells; ++x) {
        vec2 p = vec2(0.5f) + step * vec2(x, y);
        if (x > 0 && x < cells) p.x += step * random_.uniform(-0.3f, 0.3f);
        if (y > 0 && y < cells) p.y += step * random_.uniform(-0.3f, 0.3f);
        list_.clip_positions.push_back(clip_at(p, side_, random_.uniform(0.5f, 4.0f), 0.5f));
      }
    const auto vertex = [&](int x, int y) { return first + std::uint32_t(y * (cells + 1) + x); };
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const std::uint32_t a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
                            d = vertex(x, y + 1);
        list_.triangles.push_back({a, b, c});
        list_.triangles.push_back({a, c, d});
      }
  }

  void make(Kind kind, int count) {
    if (kind == Kind::mesh) return mesh(count);
    for (int i = 0; i < count; ++i) switch (kind) {
        case Kind::slivers:
          sliver();
          break;
        case Kind::ties:
          tie();
          break;
        case Kind::subpixel:
          subpixel();
          break;
        case Kind::off_screen:
          off_screen();
          break;
        case Kind::behind:
          behind();
          break;
        default:
          random_triangle();
      }
  }

  TriangleList take() { return std::move(list_); }

 private:
  int side_;
  Random random_;
  TriangleList list_;
};

/// Distance of a point from a segment, px.
double distance_to_edge(dvec2 p, dvec2 a, dvec2 b) {
  const dvec2 along = b - a;
  const double squared = glm::dot(along, along);
  const double t = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

/// Whether a sample is nearer to an edge of any triangle than a device may move a vertex:
/// sqrt2 2^-b, and 4 roundings of a coordinate.
bool is_near_an_edge(const RasterProblem& problem, dvec2 sample) {
  const TriangleList& list = problem.list;
  const double reach =
      std::sqrt(2.0) * std::exp2(-problem.subpixel_bits) + 4 * 0x1p-24 * list.width;
  const auto window = [&](std::uint32_t v) {
    const dvec4 c{list.clip_positions[v]};
    return (dvec2(c) / c.w + 1.0) * 0.5 * dvec2(list.width, list.height);
  };
  return std::any_of(list.triangles.begin(), list.triangles.end(), [&](const uvec3& t) {
    for (int i = 0; i < 3; ++i)
      if (distance_to_edge(sample, window(t[i]), window(t[(i + 1) % 3])) < reach) return true;
    return false;
  });
}

}  // namespace

Axis kind_axis() {
  return {
      .name = "kind", .low = 0, .high = kind_count - 1, .standard = 0, .whole = true, .each = true};
}

Axis samples_axis() {
  return {
      .name = "samples", .low = 1, .high = 8, .standard = 4, .logarithmic = true, .whole = true};
}

Axis side_axis() {
  return {.name = "side",
          .unit = "px",
          .low = 1,
          .high = 257,
          .standard = 131,
          .logarithmic = true,
          .whole = true};
}

TriangleList make_triangles(Kind kind, int side, int samples, int count, std::uint64_t seed) {
  Maker maker{side, seed};
  maker.make(kind, count);
  TriangleList list = maker.take();
  list.samples = samples;
  return list;
}

RasterProblem for_device(TriangleList list, const gpu::DeviceInfo& device) {
  RasterProblem problem;
  problem.list = std::move(list);
  problem.snapping = device.is_swiftshader ? Snapping::swiftshader : Snapping::mesa;
  problem.snapping_is_known =
      device.name.empty() || device.is_mesa_software || device.is_swiftshader;
  if (device.subpixel_bits > 0) problem.subpixel_bits = device.subpixel_bits;
  return problem;
}

RasterProblem make_raster_problem(const Setting& setting, const gpu::DeviceInfo& device) {
  const auto kind = Kind(setting.count("kind"));
  const int samples = 1 << int(std::lround(std::log2(setting.at("samples"))));
  const int count = kind == Kind::random || kind == Kind::ties ? 40 : 400;
  return for_device(make_triangles(kind, setting.count("side"), samples, count, setting.seed),
                    device);
}

double wrong_samples(const RasterProblem& problem, const Coverage& got, const Coverage& want) {
  const std::vector<ivec2> places = standard_sample_places(want.samples);
  double wrong = 0;
  for (std::size_t i = 0; i < want.count.size(); ++i) {
    if (got.count[i] == want.count[i] && got.last[i] == want.last[i]) continue;
    const std::size_t pixel = i / std::size_t(want.samples);
    const dvec2 corner{double(pixel % std::size_t(want.width)),
                       double(pixel / std::size_t(want.width))};
    const dvec2 sample = corner + dvec2(places[i % std::size_t(want.samples)]) / 16.0;
    if (problem.snapping_is_known || !is_near_an_edge(problem, sample)) ++wrong;
  }
  return wrong;
}

}  // namespace parity::raster_test
