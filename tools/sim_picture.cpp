#include "tools/sim_picture.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/fluid/draw_field.h"
#include "cpu_reference/fluid/draw_scene.h"
#include "geometry/random.h"
#include "gpu/fluid/draw_field.h"
#include "gpu/fluid/draw_scene.h"
#include "sim/color_map.h"

namespace parity::tools {
namespace {

constexpr int map_size = 256;

/// Particles or cells as numbers along the colour map.
struct Shade {
  std::vector<float> value;  ///< 0 to 1
  std::vector<vec3> map;
};

SimColor color_of(const SimScene& scene) {
  if (scene.picture.color != SimColor::automatic) return scene.picture.color;
  return view_of(scene) == SimView::field && !scene.sources.empty() ? SimColor::smoke
                                                                    : SimColor::speed;
}

/// Maps the range that the scene names, else all values, to 0..1.
Shade shaded(const SimScene& scene, std::vector<float> values, ColorMapKind kind) {
  dvec2 range = scene.picture.range.value_or(dvec2(0));
  if (!scene.picture.range && !values.empty()) {
    const auto [least, most] = std::ranges::minmax(values);
    range = {double(least), std::max(double(most), double(least) + 1e-9)};
    if (kind == ColorMapKind::diverging) {
      const double largest = std::max(std::abs(range.x), std::abs(range.y));
      range = {-largest, largest};
    } else if (color_of(scene) != SimColor::height) {
      range.x = std::min(range.x, 0.0);
    }
  }
  for (float& v : values)
    v = float(std::clamp((double(v) - range.x) / (range.y - range.x), 0.0, 1.0));
  return {std::move(values), color_map(kind, map_size)};
}

/// Values of particles averaged over cells: pressure differs from one particle to the next more
/// than from one place to another.
std::vector<float> averaged(const SimContent& content, const std::vector<float>& values,
                            float cell) {
  vec3 low(0), high(0);
  for (const vec3& p : content.positions) low = glm::min(low, p), high = glm::max(high, p);
  const ivec3 n = ivec3((high - low) / cell) + 2;
  const double cells = double(n.x) * n.y * n.z;
  if (!(cells < 1e8)) return values;  // something has flown far away
  std::vector<vec2> sums(static_cast<std::size_t>(cells), vec2(0));
  // Calls with each of the eight cells around a particle and its weight.
  const auto around = [&](const vec3& p, const auto& visit) {
    const vec3 at = (p - low) / cell;
    const ivec3 first = ivec3(at);
    for (int corner = 0; corner < 8; ++corner) {
      const ivec3 c = first + ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
      const vec3 near = 1.0f - glm::abs(at - vec3(c));
      visit((std::size_t(c.z) * std::size_t(n.y) + std::size_t(c.y)) * std::size_t(n.x) +
                std::size_t(c.x),
            near.x * near.y * near.z);
    }
  };
  for (std::size_t i = 0; i < values.size(); ++i)
    around(content.positions[i],
           [&](std::size_t k, float weight) { sums[k] += weight * vec2(values[i], 1); });
  std::vector<float> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    around(content.positions[i], [&](std::size_t k, float weight) {
      if (sums[k].y > 0) result[i] += weight * sums[k].x / sums[k].y;
    });
  return result;
}

Shade particle_shade(const SimScene& scene, const SimContent& content) {
  const SimColor color = color_of(scene);
  std::vector<float> values(content.positions.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (color == SimColor::pressure && !content.pressures.empty())
      values[i] = content.pressures[i];
    else if (color == SimColor::height)
      values[i] = content.positions[i].y;
    else
      values[i] = glm::length(content.velocities[i]);
  }
  if (color == SimColor::pressure && !content.pressures.empty())
    values = averaged(content, values, float(2 * scene.spacing));
  return shaded(scene, std::move(values),
                color == SimColor::speed ? ColorMapKind::water : ColorMapKind::sequential);
}

/// Curl at cell centres by central differences, one-sided at the border.
std::vector<float> vorticity(const SimContent& content) {
  const ivec3 n = content.cells;
  std::vector<float> result;
  const auto at = [&](int x, int y) -> const vec3& {
    return content.flow[std::size_t(y) * std::size_t(n.x) + std::size_t(x)];
  };
  for (int y = 0; y < n.y; ++y)
    for (int x = 0; x < n.x; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, n.x - 1);
      const int below = std::max(y - 1, 0), above = std::min(y + 1, n.y - 1);
      const float dv = (at(right, y).y - at(left, y).y) / float(std::max(right - left, 1));
      const float du = (at(x, above).x - at(x, below).x) / float(std::max(above - below, 1));
      result.push_back((dv - du) / content.spacing);
    }
  return result;
}

Shade field_shade(const SimScene& scene, const SimContent& content) {
  switch (color_of(scene)) {
    case SimColor::vorticity:
      return shaded(scene, vorticity(content), ColorMapKind::diverging);
    case SimColor::pressure:
      return shaded(scene, content.pressure, ColorMapKind::sequential);
    case SimColor::smoke:
      return shaded(scene, content.smoke, ColorMapKind::sequential);
    default: {
      std::vector<float> speeds;
      for (const vec3& v : content.flow) speeds.push_back(glm::length(v));
      return shaded(scene, std::move(speeds), ColorMapKind::sequential);
    }
  }
}

void add_box(DrawnScene& drawn, const dvec3& low, const dvec3& high, const vec3& color) {
  drawn.solids.push_back(
      {.is_box = 1, .casts_shadow = 0, .low = vec3(low), .high = vec3(high), .color = color});
}

/// The twelve edges of the domain (four in 2 dimensions) as thin rods.
void add_frame(DrawnScene& drawn, const SimScene& scene, const vec3& color) {
  const dvec3 size = scene.size;
  const double r = 0.0022 * std::max({size.x, size.y, size.z});
  for (int axis = 0; axis < scene.dimensions; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (scene.dimensions == 2 && ((u == 2 && (corner & 1)) || (v == 2 && (corner & 2)))) continue;
      dvec3 low{-r}, high{r};
      low[u] += corner & 1 ? size[u] : 0;
      high[u] += corner & 1 ? size[u] : 0;
      low[v] += corner & 2 ? size[v] : 0;
      high[v] += corner & 2 ? size[v] : 0;
      high[axis] += size[axis];
      add_box(drawn, low, high, color);
    }
}

void add_solids(DrawnScene& drawn, const SimScene& scene, double time, const vec3& color) {
  const double depth = scene.dimensions == 2 ? scene.spacing : 0;
  for (const SimBody& solid : scene.solids) {
    const dvec3 moved = solid.velocity * time;
    DrawnSolid d{.color = color};
    if (solid.shape.kind == SimShape::Kind::box) {
      d.is_box = 1;
      d.low = vec3(solid.shape.low + moved - dvec3(0, 0, depth));
      d.high = vec3(solid.shape.high + moved + dvec3(0, 0, depth));
    } else {
      d.low = vec3(solid.shape.center + moved);
      d.high = vec3(float(solid.shape.radius));
    }
    drawn.solids.push_back(d);
  }
}

/// How much of each cell particles fill, each spread over the eight nearest cells.
DrawnVolume filled_volume(const SimScene& scene, const SimContent& content, double cell,
                          double particle_volume) {
  DrawnVolume volume{.mode = VolumeMode::shadow,
                     .size = ivec3(glm::ceil(scene.size / cell)) + 2,
                     .origin = vec3(float(-cell)),
                     .cell = float(cell)};
  const ivec3 n = volume.size;
  volume.values.assign(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z), 0.0f);
  const auto part = float(particle_volume / (cell * cell * cell));
  for (const vec3& p : content.positions) {
    const vec3 at = (p - volume.origin) / volume.cell - 0.5f;
    const ivec3 low = ivec3(glm::floor(at));
    for (int corner = 0; corner < 8; ++corner) {
      const ivec3 step{corner & 1, (corner >> 1) & 1, corner >> 2}, c = low + step;
      if (glm::any(glm::lessThan(c, ivec3(0))) || glm::any(glm::greaterThanEqual(c, n))) continue;
      const vec3 near = 1.0f - glm::abs(at - vec3(c));
      volume.values[(std::size_t(c.z) * std::size_t(n.y) + std::size_t(c.y)) * std::size_t(n.x) +
                    std::size_t(c.x)] += part * near.x * near.y * near.z;
    }
  }
  return volume;
}

DrawnView view_for(const SimScene& scene) {
  const SimPicture& picture = scene.picture;
  DrawnView view = scene.dimensions == 2 ? flat_view(picture.size, {0, 0}, dvec2(scene.size))
                   : picture.eye ? perspective_view(picture.size, *picture.eye, *picture.target,
                                                    picture.fov_degrees)
                                 : framing_view(picture.size, scene.size, picture.fov_degrees);
  view.samples = picture.samples;
  return view;
}

/// A bright studio for liquids.
DrawnLight day_light(const SimScene& scene) {
  const double reach = glm::length(scene.size);
  DrawnLight light;
  light.sun = vec3(glm::normalize(scene.picture.sun));
  light.sun_color = {0.78f, 0.75f, 0.69f};
  light.sky_color = {0.50f, 0.53f, 0.58f};
  light.ground_color = {0.26f, 0.25f, 0.24f};
  light.horizon = {0.86f, 0.88f, 0.90f};
  light.zenith = {0.50f, 0.62f, 0.78f};
  light.floor_color = {0.66f, 0.66f, 0.65f};
  light.floor_y = float(-0.004 * reach);
  light.fade = float(6 * reach);
  light.has_floor = scene.dimensions == 3 ? 1 : 0;
  if (scene.dimensions == 2) light.sun = glm::normalize(vec3(0.35f, 0.55f, 0.75f));
  return light;
}

/// A dark one for smoke.
DrawnLight night_light(const SimScene& scene) {
  DrawnLight light = day_light(scene);
  light.sun_color = {1.25f, 1.16f, 1.02f};
  light.sky_color = {0.30f, 0.36f, 0.46f};
  light.ground_color = {0.10f, 0.10f, 0.12f};
  light.horizon = {0.055f, 0.065f, 0.085f};
  light.zenith = {0.015f, 0.02f, 0.035f};
  light.floor_color = {0.08f, 0.083f, 0.09f};
  light.medium = vec3(0.92f);
  light.forward_scatter = 0.2f;
  return light;
}

double particle_spacing(const SimScene& scene) {
  return is_sph(scene.method) ? scene.spacing : 0.5 * scene.spacing;
}

void add_particles(DrawnScene& drawn, const SimScene& scene, const SimContent& content) {
  const double spacing = particle_spacing(scene);
  const Shade shade = particle_shade(scene, content);
  drawn.positions = content.positions;
  drawn.radius = float(0.58 * spacing);
  for (const float v : shade.value)
    drawn.colors.push_back(shade.map[std::size_t(v * (map_size - 1) + 0.5f)]);
  if (scene.dimensions == 2) return;
  drawn.volume = filled_volume(scene, content, 2 * spacing, std::pow(spacing, 3));
  for (float& v : drawn.volume.values) v *= float(0.45 / spacing);
}

void add_smoke(DrawnScene& drawn, const SimScene& scene, const SimContent& content) {
  drawn.volume = {.mode = VolumeMode::smoke,
                  .size = content.cells,
                  .origin = vec3(0),
                  .cell = content.spacing,
                  .values = content.smoke};
  const auto thickness = float(28 / std::min(scene.size.x, scene.size.z));
  for (float& v : drawn.volume.values) v = std::max(v, 0.0f) * thickness;
}

}  // namespace

SimView view_of(const SimScene& scene) {
  if (scene.picture.view != SimView::automatic) return scene.picture.view;
  if (scene.method != SimMethod::grid) return SimView::spheres;
  return scene.dimensions == 2 ? SimView::field : SimView::smoke;
}

DrawnScene drawn_scene(const SimScene& scene, const SimContent& content) {
  const bool is_smoke = view_of(scene) == SimView::smoke;
  DrawnScene drawn;
  drawn.view = view_for(scene);
  drawn.light = is_smoke ? night_light(scene) : day_light(scene);
  if (is_smoke)
    add_smoke(drawn, scene, content);
  else
    add_particles(drawn, scene, content);
  if (drawn.volume.mode == VolumeMode::none) drawn.volume.cell = float(scene.spacing);
  add_solids(drawn, scene, content.time,
             is_smoke ? vec3(0.55f, 0.42f, 0.30f) : vec3(0.80f, 0.36f, 0.16f));
  add_frame(drawn, scene, is_smoke ? vec3(0.10f) : vec3(0.10f, 0.11f, 0.13f));
  return drawn;
}

DrawnField drawn_field(const SimScene& scene, const SimContent& content) {
  Shade shade = field_shade(scene, content);
  DrawnField field{.cells = ivec2(content.cells)};
  float fastest = 0;
  for (const vec3& v : content.flow) {
    field.velocity.emplace_back(v.x, v.y);
    fastest = std::max(fastest, glm::length(v));
  }
  field.value = std::move(shade.value);
  field.color_map = std::move(shade.map);
  field.solid = content.solid.empty() ? std::vector<float>(content.flow.size()) : content.solid;
  field.slowest = std::max(0.03f * fastest, 1e-20f);
  field.noise = Grid<float>(256, 256);
  Random random{1};
  for (float& v : field.noise) v = random.uniform();
  // The largest picture of the domain's own shape.
  const double scale =
      std::min(scene.picture.size.x / scene.size.x, scene.picture.size.y / scene.size.y);
  field.width = std::max(1, int(std::lround(scene.size.x * scale)));
  field.height = std::max(1, int(std::lround(scene.size.y * scale)));
  return field;
}

struct FrameDrawer::Kernels {
  gpu::SceneDrawer scene;
};

FrameDrawer::FrameDrawer(gpu::Context* context) : context_(context) {
  if (context_ != nullptr) kernels_ = std::make_unique<Kernels>(gpu::SceneDrawer(*context_));
}
FrameDrawer::~FrameDrawer() = default;

Grid<vec4> FrameDrawer::draw(const SimScene& scene, const SimContent& content) const {
  const bool is_field = view_of(scene) == SimView::field;
  if (context_ != nullptr)
    return is_field ? gpu::draw_field(*context_, drawn_field(scene, content))
                    : kernels_->scene.draw(*context_, drawn_scene(scene, content));
  const Grid<dvec4> exact = is_field ? cpu::draw_field(drawn_field(scene, content))
                                     : cpu::draw_scene(drawn_scene(scene, content));
  Grid<vec4> picture{exact.width(), exact.height()};
  for (std::size_t i = 0; i < exact.size(); ++i) picture.values()[i] = vec4(exact.values()[i]);
  return picture;
}

}  // namespace parity::tools
