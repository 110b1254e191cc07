#include "geometry/cast_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/camera.h"

namespace parity {
namespace {

/// Depths of maps are floats from 0 to 1, and so are those that are compared with them; positions
/// are floats too, relative to the eye: 16 roundings of either.
double depth_bias(double reach, double depth) { return 16 * 0x1p-24 * (1 + reach / depth); }

constexpr double widest_cone = 1.3962634015954636;  // 80 degrees
constexpr int most_cascades = 4;
/// The nearest thing that casts a shadow of a spot light, of the farthest.
constexpr double nearest_part = 1.0 / 500;

struct Box {
  dvec3 low{std::numeric_limits<double>::infinity()};
  dvec3 high{-std::numeric_limits<double>::infinity()};
  void add(const dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

std::array<dvec3, 8> corners_of(const Bounds& b) {
  std::array<dvec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[std::size_t(i)] = {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y,
                               i & 4 ? b.max.z : b.min.z};
  return corners;
}

/// A light's view looks along its direction.
dmat4 view_along(const dvec3& direction, const dvec3& eye) {
  const dvec3 backward = -direction;
  const dvec3 aside = std::abs(backward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 right = glm::normalize(glm::cross(aside, backward));
  const dmat3 turn = glm::transpose(dmat3(right, glm::cross(backward, right), backward));
  dmat4 view(turn);
  view[3] = dvec4(-(turn * eye), 1);
  return view;
}

/// The part of the picture's view between two distances, seen from a light: x and y only.
Box slice(const Frame& frame, const dmat4& light_from_world, double near, double far) {
  const dmat4 light_from_view = light_from_world * glm::inverse(frame.view_from_world);
  Box box;
  for (const double distance : {near, far}) {
    const double w = frame.orthographic ? 1 : distance;
    const double x = w / std::abs(frame.clip_from_view[0][0]);
    const double y = w / std::abs(frame.clip_from_view[1][1]);
    for (const dvec2& side : {dvec2(-x, -y), dvec2(x, -y), dvec2(-x, y), dvec2(x, y)})
      box.add(dvec3(light_from_view * dvec4(side, -distance, 1)));
  }
  return box;
}

/// What a map is drawn with: no light, nothing that is blended.
Frame map_frame(const Scene& scene, const Frame& frame, const Camera& camera, const dmat4& view,
                int side) {
  Frame map;
  map.options = {.width = side, .height = side, .samples = 1, .depth = DepthMode::standard};
  map.view_from_world = view;
  map.clip_from_view = clip_from_view(camera, 1, DepthMode::standard);
  const dmat4 world_from_view = glm::inverse(view);
  map.eye = dvec3(world_from_view[3]);
  map.backward = dvec3(world_from_view[2]);
  map.orthographic = camera.orthographic;
  map.near = camera.near;
  map.far = *camera.far;
  const dmat4 clip_from_world = map.clip_from_view * view;
  for (Draw draw : frame.draws) {
    if (draw.material >= 0 && is_blended(scene.materials[std::size_t(draw.material)])) continue;
    draw.clip_from_object = mat4(clip_from_world * draw.world_from_object);
    map.draws.push_back(draw);
  }
  return map;
}

/// Makes maps of one light.
class Caster {
 public:
  Caster(const Scene& scene, const Frame& frame, const ShadowOptions& options,
         const std::function<Grid<float>(const Frame&)>& depths_of)
      : scene_(scene), frame_(frame), options_(options), depths_of_(depths_of) {
    const Bounds bounds = world_bounds(scene);
    if (bounds.empty) return;
    corners_ = corners_of(bounds);
    for (const dvec3& corner : corners_) {
      const double distance = -(frame.view_from_world * dvec4(corner, 1)).z;
      reach_ = std::max(reach_, glm::length(corner - frame.eye));
      nearest_ = std::min(nearest_, distance);
      farthest_ = std::max(farthest_, distance);
    }
    // A picture of a wall from straight ahead has some depth too.
    const double rim = 1e-3 * glm::length(bounds.max - bounds.min);
    nearest_ = std::max(nearest_ - rim, frame.near);
    farthest_ += rim;
    if (frame.far > 0) farthest_ = std::min(farthest_, frame.far);
  }

  bool sees_nothing() const { return !(farthest_ > nearest_); }

  void directional(const dvec3& direction, LightShadow& shadow) const {
    const dmat4 turned = view_along(direction, dvec3(0.0));
    Box whole;
    for (const dvec3& corner : corners_) whole.add(dvec3(turned * dvec4(corner, 1)));
    const double depth = whole.high.z - whole.low.z;
    // Positions are rounded, so no map is flat.
    const double rim = std::max(1e-2 * glm::length(whole.high - whole.low), 1e-3 * farthest_);
    double near = nearest_;
    for (const double end : ends()) {
      Box seen = slice(frame_, turned, near, end);
      seen.low = glm::max(seen.low, whole.low);
      seen.high = glm::min(seen.high, whole.high);
      near = end;
      dvec2 half = 0.5 * (dvec2(seen.high) - dvec2(seen.low));
      half = glm::max(half, dvec2(rim)) *
             (options_.side / (options_.side - 2.0 * options_.radius - 4));
      const dvec2 middle = 0.5 * (dvec2(seen.high) + dvec2(seen.low));
      Camera camera;
      camera.orthographic = true;
      camera.x_magnification = camera.y_magnification = std::max(half.x, half.y);
      camera.near = rim;
      camera.far = depth + 3 * rim;
      shadow.bias = float(depth_bias(reach_, depth + 2 * rim));
      dmat4 view = turned;
      view[3] = dvec4(-middle.x, -middle.y, -(whole.high.z + 2 * rim), 1);
      add(shadow, camera, view, options_.side,
          end == farthest_ ? std::numeric_limits<double>::infinity() : end,
          2 * camera.x_magnification / options_.side);
    }
  }

  void spot(const PlacedLight& light, LightShadow& shadow) const {
    const dmat4 view = view_along(light.direction, light.position);
    double near = std::numeric_limits<double>::infinity(), far = 0;
    for (const dvec3& corner : corners_) {
      const double distance = -(view * dvec4(corner, 1)).z;
      near = std::min(near, distance);
      far = std::max(far, distance);
    }
    far = std::min(far * 1.001, double(light.light.range));
    if (!(far > 0)) return;
    Camera camera;
    camera.vertical_fov = 2 * std::min(double(light.light.outer_cone_angle), widest_cone);
    camera.near = std::max(near * 0.999, far * nearest_part);
    camera.far = far;
    if (!(camera.near < far)) return;
    shadow.bias = float(depth_bias(reach_, far));
    add(shadow, camera, view, options_.side, std::numeric_limits<double>::infinity(),
        2 * std::tan(camera.vertical_fov / 2) / options_.side);
  }

  /// Six maps around the light, wide enough for the filter and the lift of receivers at their rims.
  void point(const PlacedLight& light, LightShadow& shadow) const {
    double far = 0;
    for (const dvec3& corner : corners_) far = std::max(far, glm::length(corner - light.position));
    far = std::min(far * 1.001, double(light.light.range));
    const dvec3 inside = glm::clamp(light.position, corners_.front(), corners_.back());
    const double near = std::max(far * nearest_part, 0.57 * glm::length(light.position - inside));
    if (!(near < far)) return;
    const int side = std::max(options_.side / 2, 16);
    const double half = 1 / std::max(1 - 2.0 * (3 * options_.radius + 4) / side, 0.5);
    Camera camera;
    camera.vertical_fov = 2 * std::atan(half);
    camera.near = near;
    camera.far = far;
    shadow.is_cube = true;
    shadow.center = light.position;
    shadow.bias = float(depth_bias(reach_, far));
    for (int face = 0; face < 6; ++face) {
      dvec3 direction{0.0};
      direction[face / 2] = face % 2 ? -1 : 1;
      add(shadow, camera, view_along(direction, light.position), side,
          std::numeric_limits<double>::infinity(), 2 * half / side);
    }
  }

 private:
  std::vector<double> ends() const {
    if (frame_.orthographic || !(nearest_ > 0)) return {farthest_};
    const int count = std::clamp(int(std::ceil(std::log2(farthest_ / nearest_))), 1, most_cascades);
    std::vector<double> ends = cascade_ends(nearest_, farthest_, count, 0.5);
    ends.back() = farthest_;
    return ends;
  }

  void add(LightShadow& shadow, const Camera& camera, const dmat4& view, int side, double end,
           double texel) const {
    const Frame map = map_frame(scene_, frame_, camera, view, side);
    dmat4 unit(1.0);
    unit[0][0] = unit[1][1] = 0.5;
    unit[3] = dvec4(0.5, 0.5, 0, 1);
    shadow.cascades.push_back({unit * map.clip_from_view * view, end, texel, depths_of_(map)});
  }

  const Scene& scene_;
  const Frame& frame_;
  const ShadowOptions& options_;
  const std::function<Grid<float>(const Frame&)>& depths_of_;
  std::array<dvec3, 8> corners_{};
  double reach_ = 0;  ///< from the eye
  double nearest_ = std::numeric_limits<double>::infinity();
  double farthest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<LightShadow> cast_shadows(const Scene& scene, const Frame& frame,
                                      const ShadowOptions& options,
                                      const std::function<Grid<float>(const Frame&)>& depths_of) {
  if (options.side < 16 || options.side > 8192 || options.radius < 0 || options.radius > 8 ||
      2 * options.radius + 4 >= options.side)
    throw std::invalid_argument("cast_shadows: side is " + std::to_string(options.side) +
                                ", radius " + std::to_string(options.radius) +
                                ", must be 16 to 8192 and 0 to 8, less than half of it");
  const Caster caster(scene, frame, options, depths_of);
  std::vector<LightShadow> shadows;
  if (caster.sees_nothing()) return shadows;
  const dmat4& view = frame.view_from_world;
  for (std::size_t i = 0; i < frame.lights.size() && shadows.size() < most_shadows; ++i) {
    const PlacedLight& light = frame.lights[i];
    LightShadow shadow;
    shadow.light = int(i);
    shadow.forward = -dvec3(view[0][2], view[1][2], view[2][2]);
    shadow.offset = -view[3][2];
    shadow.radius = options.radius;
    if (light.light.kind == LightKind::directional) caster.directional(light.direction, shadow);
    if (light.light.kind == LightKind::spot) caster.spot(light, shadow);
    if (light.light.kind == LightKind::point) caster.point(light, shadow);
    if (!shadow.cascades.empty()) shadows.push_back(std::move(shadow));
  }
  return shadows;
}

}  // namespace parity
