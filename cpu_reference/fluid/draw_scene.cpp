#include "cpu_reference/fluid/draw_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace parity::cpu {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ray {
  dvec3 from, along;
  dvec3 at(double t) const { return from + t * along; }
};

struct Interval {
  double enter = -infinity, leave = infinity;
};

Interval cross_box(const Ray& ray, const dvec3& low, const dvec3& high) {
  Interval both;
  for (int a = 0; a < 3; ++a) {
    if (ray.along[a] == 0) {
      if (ray.from[a] < low[a] || ray.from[a] > high[a]) return {infinity, -infinity};
      continue;
    }
    const double one = (low[a] - ray.from[a]) / ray.along[a];
    const double other = (high[a] - ray.from[a]) / ray.along[a];
    both.enter = std::max(both.enter, std::min(one, other));
    both.leave = std::min(both.leave, std::max(one, other));
  }
  return both;
}

/// The smaller root of |from + t along - center|^2 = radius^2, if it is positive.
double meet_ball(const Ray& ray, const dvec3& center, double radius) {
  const dvec3 c = ray.from - center;
  const double b = glm::dot(c, ray.along);
  const double discriminant = b * b - (glm::dot(c, c) - radius * radius);
  if (discriminant < 0) return infinity;
  const double t = -b - std::sqrt(discriminant);
  return t > 0 ? t : infinity;
}

double meet_solid(const Ray& ray, const DrawnSolid& solid) {
  if (solid.is_box == 0) return meet_ball(ray, dvec3(solid.low), double(solid.high.x));
  const Interval in = cross_box(ray, dvec3(solid.low), dvec3(solid.high));
  return in.leave >= in.enter && in.enter > 0 ? in.enter : infinity;
}

/// Of the face whose plane is nearest in units of the half sides.
dvec3 solid_normal(const DrawnSolid& solid, const dvec3& point) {
  const dvec3 low{solid.low}, high{solid.high};
  if (solid.is_box == 0) return glm::normalize(point - low);
  dvec3 normal{0};
  double best = -1;
  for (int a = 0; a < 3; ++a) {
    const double part = 2 * (point[a] - low[a]) / (high[a] - low[a]) - 1;
    if (std::abs(part) <= best) continue;
    best = std::abs(part);
    normal = dvec3(0);
    normal[a] = part < 0 ? -1 : 1;
  }
  return normal;
}

/// The volume with the light that reaches its cells.
struct Lit {
  double value, sun, sky, lit;
};
Lit operator*(double w, const Lit& c) { return {w * c.value, w * c.sun, w * c.sky, w * c.lit}; }
Lit operator+(const Lit& a, const Lit& b) {
  return {a.value + b.value, a.sun + b.sun, a.sky + b.sky, a.lit + b.lit};
}

class Painter {
 public:
  explicit Painter(const DrawnScene& scene)
      : scene_(scene), volume_(scene.volume), sun_(scene.light.sun) {
    if (volume_.mode != VolumeMode::none) light_cells();
    sort_particles();
  }

  dvec3 sample(int x, int y) const {
    const Ray ray = ray_of(x + 0.5, y + 0.5);
    return seen(ray, candidates(x, y));
  }

 private:
  struct Hit {
    double t = infinity;
    dvec3 normal{0}, color{0};
    double shine = 0;
  };

  Ray ray_of(double x, double y) const {
    const DrawnView& view = scene_.view;
    const double u = 2 * x / (view.width * view.samples) - 1;
    const double v = 1 - 2 * y / (view.height * view.samples);
    const dvec3 aside = u * dvec3(view.right) + v * dvec3(view.up);
    if (view.is_orthographic) return {dvec3(view.eye) + aside, dvec3(view.forward)};
    return {dvec3(view.eye), glm::normalize(dvec3(view.forward) + aside)};
  }

  // Particles by the tiles of the picture that the cone around their ball may touch.
  static constexpr int tile = 16;

  void sort_particles() {
    const DrawnView& view = scene_.view;
    columns_ = (view.width * view.samples + tile - 1) / tile;
    rows_ = (view.height * view.samples + tile - 1) / tile;
    tiles_.resize(std::size_t(columns_) * std::size_t(rows_));
    for (std::size_t i = 0; i < scene_.positions.size(); ++i) put_into_tiles(std::uint32_t(i));
  }

  /// Corners of the cube around the ball bound it on the screen; behind the eye it is unseen.
  void put_into_tiles(std::uint32_t particle) {
    const DrawnView& view = scene_.view;
    const dvec3 right{view.right}, up{view.up}, forward{view.forward}, eye{view.eye};
    const double r = double(scene_.radius);
    dvec2 low{infinity}, high{-infinity};
    const dvec3 to = dvec3(scene_.positions[particle]) - eye;
    if (!view.is_orthographic && !(glm::dot(to, forward) > 1.01 * r)) return;
    for (int corner = 0; corner < 8; ++corner) {
      const auto end = [&](int bit) { return corner & bit ? r : -r; };
      const double x = glm::dot(to, right) / glm::length(right) + end(1);
      const double y = glm::dot(to, up) / glm::length(up) + end(2);
      const double depth =
          view.is_orthographic ? 1.0 : std::max(glm::dot(to, forward) + end(4), 0.01 * r);
      const dvec2 at{x / depth / glm::length(right), y / depth / glm::length(up)};
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const auto column = [&](double u) {
      return int(std::clamp((u + 1) / 2 * view.width * view.samples / tile, 0.0, columns_ - 1.0));
    };
    const auto row = [&](double v) {
      return int(std::clamp((1 - v) / 2 * view.height * view.samples / tile, 0.0, rows_ - 1.0));
    };
    for (int j = row(high.y); j <= row(low.y); ++j)
      for (int i = column(low.x); i <= column(high.x); ++i)
        tiles_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)].push_back(particle);
  }

  const std::vector<std::uint32_t>& candidates(int x, int y) const {
    return tiles_[std::size_t(y / tile) * std::size_t(columns_) + std::size_t(x / tile)];
  }

  dvec3 cell_center(int x, int y, int z) const {
    return dvec3(volume_.origin) + double(volume_.cell) * (dvec3(x, y, z) + 0.5);
  }
  dvec3 volume_high() const {
    return dvec3(volume_.origin) + double(volume_.cell) * dvec3(volume_.size);
  }
  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(volume_.size.y) + std::size_t(y)) *
               std::size_t(volume_.size.x) +
           std::size_t(x);
  }
  bool is_before_sun(const dvec3& point) const {
    return std::ranges::any_of(scene_.solids, [&](const DrawnSolid& solid) {
      return solid.casts_shadow != 0 && meet_solid({point, sun_}, solid) < infinity;
    });
  }

  /// One direction's light at all cells, from the top layer down.
  std::vector<double> sweep(const dvec3& direction) const {
    const ivec3 n = volume_.size;
    const dvec3 step = direction / direction.y;
    const double way = glm::length(step) * double(volume_.cell);
    std::vector<double> light(volume_.values.size());
    for (int y = n.y - 1; y >= 0; --y)
      for (int z = 0; z < n.z; ++z)
        for (int x = 0; x < n.x; ++x) {
          const double i = std::floor(x + step.x), k = std::floor(z + step.z);
          const double a = x + step.x - i, b = z + step.z - k;
          double comes = 0, value = 0;
          for (int corner = 0; corner < 4; ++corner) {
            const int u = int(i) + (corner & 1), w = int(k) + (corner >> 1);
            const double weight = (corner & 1 ? a : 1 - a) * (corner >> 1 ? b : 1 - b);
            const bool is_inside = y + 1 < n.y && u >= 0 && u < n.x && w >= 0 && w < n.z;
            comes += weight * (is_inside ? light[index(u, y + 1, w)] : 1.0);
            value += weight * (is_inside ? double(volume_.values[index(u, y + 1, w)]) : 0.0);
          }
          value = 0.5 * (value + double(volume_.values[index(x, y, z)]));
          light[index(x, y, z)] = comes * std::exp(-way * value);
        }
    return light;
  }

  void light_cells() {
    const ivec3 n = volume_.size;
    const std::vector<double> sun = sweep(sun_);
    std::vector<double> sky(sun.size());
    const std::array<dvec3, 6> directions{
        {{0, 1, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 1, 1}, {0, 1, -1}}};
    for (const dvec3& direction : directions) {
      const std::vector<double> light = sweep(direction);
      for (std::size_t i = 0; i < sky.size(); ++i) sky[i] += light[i] / 6;
    }
    cells_.resize(sun.size());
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          const std::size_t i = index(x, y, z);
          cells_[i] = {double(volume_.values[i]), sun[i], sky[i],
                       is_before_sun(cell_center(x, y, z)) ? 0.0 : 1.0};
        }
  }

  Lit cell_at(const dvec3& point) const {
    const dvec3 g = (point - dvec3(volume_.origin)) / double(volume_.cell) - 0.5;
    Lit sum{0, 0, 0, 0};
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      ivec3 cell{0};
      for (int a = 0; a < 3; ++a) {
        const int last = volume_.size[a] - 1;
        const double at = std::clamp(g[a], 0.0, double(last));
        const int low = std::min(int(at), std::max(last - 1, 0));
        const bool upper = (corner >> a & 1) != 0;
        weight *= upper ? at - low : 1 - (at - low);
        cell[a] = std::min(low + int(upper), last);
      }
      if (weight > 0) sum = sum + weight * cells_[index(cell.x, cell.y, cell.z)];
    }
    return sum;
  }

  /// (sun, sky) through the volume.
  dvec2 light_at(const dvec3& point) const {
    if (volume_.mode == VolumeMode::none) return {1, 1};
    const dvec3 low{volume_.origin}, high = volume_high();
    const dvec3 nearest = glm::clamp(point, low, high);
    const double away = glm::distance(point, nearest);
    const Lit there = cell_at(nearest);
    if (away == 0) return {there.sun, there.sky};
    const double part = std::min(away / (0.25 * (high.y - low.y)), 1.0);
    const double sky = there.sky + part * (1 - there.sky);
    const Ray to_sun{point, sun_};
    const Interval in = cross_box(to_sun, low, high);
    const double enter = std::max(in.enter, 0.0);
    return {in.leave > enter ? cell_at(to_sun.at(enter)).sun : 1.0, sky};
  }

  Hit surroundings(const Ray& ray) const {
    const DrawnLight& light = scene_.light;
    Hit hit;
    if (light.has_floor != 0 && ray.along.y < 0 && ray.from.y > double(light.floor_y))
      hit = {(double(light.floor_y) - ray.from.y) / ray.along.y, dvec3(0, 1, 0),
             dvec3(light.floor_color), 0};
    for (const DrawnSolid& solid : scene_.solids)
      if (const double t = meet_solid(ray, solid); t < hit.t)
        hit = {t, solid_normal(solid, ray.at(t)), dvec3(solid.color), 0.04};
    return hit;
  }

  Hit nearest_particle(const Ray& ray, const std::vector<std::uint32_t>& list) const {
    Hit hit;
    for (const std::uint32_t i : list) {
      const dvec3 center{scene_.positions[i]};
      const double t = meet_ball(ray, center, double(scene_.radius));
      if (t < hit.t) hit = {t, glm::normalize(ray.at(t) - center), dvec3(scene_.colors[i]), 0.12};
    }
    return hit;
  }

  dvec3 shaded(const Ray& ray, const Hit& hit) const {
    const DrawnLight& light = scene_.light;
    const dvec3 sun_color{light.sun_color};
    const double lift = 1.5 * double(volume_.cell);
    const dvec2 passes = light_at(ray.at(hit.t) + lift * hit.normal);
    const double cosine = glm::dot(hit.normal, sun_);
    const dvec3 around =
        glm::mix(dvec3(light.ground_color), dvec3(light.sky_color), 0.5 + 0.5 * hit.normal.y);
    dvec3 color = hit.color * passes.y * around;
    if (cosine > 0 && !is_before_sun(ray.at(hit.t) + 1e-3 * lift * hit.normal)) {
      const dvec3 half = glm::normalize(sun_ - ray.along);
      color += passes.x * cosine * hit.color * sun_color;
      if (cosine * passes.x >= 1e-6)
        color += hit.shine * std::pow(std::max(glm::dot(hit.normal, half), 0.0), 40) * passes.x *
                 sun_color;
    }
    const double clear = std::exp(-std::pow(hit.t / double(light.fade), 2));
    return light.has_floor != 0 ? glm::mix(dvec3(light.horizon), color, clear) : color;
  }

  dvec3 background(const Ray& ray) const {
    const DrawnLight& light = scene_.light;
    if (light.has_floor == 0) return dvec3(light.horizon);
    const double s = std::clamp(ray.along.y / 0.6, 0.0, 1.0);
    return glm::mix(dvec3(light.horizon), dvec3(light.zenith), s * s * (3 - 2 * s));
  }

  /// What the smoke adds before `end`, and the part of what is behind that passes.
  std::pair<dvec3, double> smoke(const Ray& ray, double end) const {
    const DrawnLight& light = scene_.light;
    const Interval in = cross_box(ray, dvec3(volume_.origin), volume_high());
    const double stop = std::min(in.leave, end), stride = 0.6 * double(volume_.cell);
    const double g = double(light.forward_scatter);
    const double phase = (1 - g * g) / std::pow(1 + g * g - 2 * g * glm::dot(ray.along, sun_), 1.5);
    const dvec3 ambient = 0.5 * (dvec3(light.sky_color) + dvec3(light.ground_color));
    dvec3 sum{0};
    double passes = 1;
    for (double t = std::max(in.enter, 0.0); t < stop && passes > 0.002; t += stride) {
      const Lit c = cell_at(ray.at(t + 0.5 * stride));
      const double left = std::exp(-c.value * std::min(stride, stop - t));
      const dvec3 comes = phase * c.sun * c.lit * dvec3(light.sun_color) + c.sky * ambient;
      sum += passes * (1 - left) * dvec3(light.medium) * comes;
      passes *= left;
    }
    return {sum, passes};
  }

  dvec3 seen(const Ray& ray, const std::vector<std::uint32_t>& particles) const {
    const Hit solid = surroundings(ray), particle = nearest_particle(ray, particles);
    const Hit hit = particle.t < solid.t ? particle : solid;
    const dvec3 behind = hit.t < infinity ? shaded(ray, hit) : background(ray);
    if (volume_.mode != VolumeMode::smoke) return behind;
    const auto [light, passes] = smoke(ray, hit.t);
    return light + passes * behind;
  }

  const DrawnScene& scene_;
  const DrawnVolume& volume_;
  dvec3 sun_;
  std::vector<Lit> cells_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> tiles_;
};

}  // namespace

Grid<dvec4> draw_scene(const DrawnScene& scene) {
  check_drawn_scene(scene);
  const Painter painter(scene);
  const int n = scene.view.samples;
  Grid<dvec4> picture{scene.view.width, scene.view.height};
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      dvec3 sum{0};
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) sum += painter.sample(x * n + i, y * n + j);
      picture(x, y) = dvec4(sum / double(n * n), 1);
    }
  return picture;
}

}  // namespace parity::cpu
