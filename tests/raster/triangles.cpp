#include "tests/raster/triangles.h"

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

  /// @param ratio  of the largest w to the smallest; 1: no perspective.
  void add(const vec2 (&corners)[3], float ratio) {
    const auto first = std::uint32_t(list_.clip_positions.size());
    for (const vec2& corner : corners) {
      const float w = ratio > 1 ? random_.uniform(4.0f / ratio, 4.0f) : 1.0f;
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

  void random_triangle() { add({inside(), inside(), inside()}, 8); }
  void sliver() {
    const vec2 a = inside();
    const vec2 b = inside();
    add({a, b, clamp(a + vec2(random_.uniform(-1, 1), random_.uniform(-1, 1)))}, 8);
  }
  void tie() {
    vec2 a = sixteenths(inside());
    vec2 b = sixteenths(inside());
    vec2 c = sixteenths(inside());
    if (random_.below(2)) b.y = a.y;
    if (random_.below(2)) c.x = a.x;
    add({a, b, c}, 1);
  }
  void subpixel() {
    const vec2 a = inside();
    const auto near = [&] {
      return clamp(a + vec2(random_.uniform(-0.7f, 0.7f), random_.uniform(-0.7f, 0.7f)));
    };
    add({a, near(), near()}, 8);
  }
  void off_screen() {
    const float far = float(side_) * random_.uniform(1.1f, 3.0f);
    const vec2 shift = random_.below(2) ? vec2(random_.below(2) ? far : -far, 0)
                                        : vec2(0, random_.below(2) ? far : -far);
    add({inside() + shift, inside() + shift, inside() + shift}, 8);
  }
  void behind() {
    random_triangle();
    for (std::size_t i = list_.clip_positions.size() - 3; i < list_.clip_positions.size(); ++i)
      list_.clip_positions[i] = -list_.clip_positions[i];
  }

  /// Corners up to `out` px out of the viewport.
  void crossing(float out) {
    const auto corner = [&] {
      const float high = float(side_) + out;
      return vec2(random_.uniform(-out, high), random_.uniform(-out, high));
    };
    add({corner(), corner(), corner()}, 2);
  }

  /// Corners at distances of -1 to 2 from the eye, the near plane at 0.5.
  void through() {
    const auto first = std::uint32_t(list_.clip_positions.size());
    const float near = 0.5f;
    for (int k = 0; k < 3; ++k) {
      const float w = random_.uniform(-1, 2);
      list_.clip_positions.emplace_back(random_.uniform(-1, 1), random_.uniform(-1, 1), w - near,
                                        w);
    }
    list_.triangles.push_back({first, first + 1, first + 2});
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
        case Kind::crossing:
          crossing(40);
          break;
        case Kind::through:
          through();
          break;
        case Kind::huge:
          crossing(65536);
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

}  // namespace

Axis kind_axis(Kind last) {
  return {
      .name = "kind", .low = 0, .high = double(last), .standard = 0, .whole = true, .each = true};
}

Axis samples_axis() {
  return {.name = "samples",
          .low = 1,
          .high = 8,
          .standard = 4,
          .logarithmic = true,
          .whole = true,
          .each = true};
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
  const bool large = kind == Kind::random || kind == Kind::ties || kind >= Kind::crossing;
  const int count = large ? 40 : 400;
  return for_device(make_triangles(kind, setting.count("side"), samples, count, setting.seed),
                    device);
}

}  // namespace parity::raster_test
