#include "geometry/frame.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "geometry/framing_camera.h"

namespace parity {
namespace {

void check(const FrameOptions& options) {
  const auto side = [](const char* what, int value) {
    if (value < 1 || value > 16384)
      throw std::invalid_argument(std::string("make_frame: ") + what + " is " +
                                  std::to_string(value) + ", must be 1 to 16384");
  };
  side("width", options.width);
  side("height", options.height);
  const int s = options.samples;
  if (s != 1 && s != 2 && s != 4 && s != 8)
    throw std::invalid_argument("make_frame: samples is " + std::to_string(s) +
                                ", must be 1, 2, 4 or 8");
}

/// Index into Scene::cameras by name or number.
int find_camera(const Scene& scene, const std::string& wanted) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == wanted) return int(i);
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc{} && end == wanted.data() + wanted.size() && index < scene.cameras.size())
    return int(index);
  std::string names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names += (i ? ", " : "") + std::to_string(i) + " '" + scene.cameras[i].name + "'";
  throw std::invalid_argument("camera is '" + wanted + "', must be a name or number of: " +
                              (names.empty() ? "(the scene has no camera)" : names));
}

/// The node that carries the wanted camera; -1: none stands in the scene.
int camera_node(const Scene& scene, const std::string& wanted) {
  const int camera = wanted.empty() ? -1 : find_camera(scene, wanted);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].camera >= 0 && (camera < 0 || scene.nodes[i].camera == camera))
      return int(i);
  if (camera >= 0)
    throw std::invalid_argument("camera '" + wanted + "' does not stand in the scene");
  return -1;
}

/// Rotation part without scale; columns of unit length. Falls back to no rotation if singular.
dmat4 without_scale(const dmat4& m) {
  dmat4 rigid = m;
  for (int i = 0; i < 3; ++i) {
    const double length = glm::length(dvec3(m[i]));
    if (!(length > 0) || !std::isfinite(length)) return dmat4(1.0);
    rigid[i] = m[i] / length;
  }
  return std::abs(glm::determinant(dmat3(rigid))) > 1e-6 ? rigid : dmat4(1.0);
}

PlacedCamera place_camera(const Scene& scene, const std::vector<dmat4>& world,
                          const FrameOptions& options, double aspect) {
  const int node = camera_node(scene, options.camera);
  if (node < 0) return framing_camera(scene, world, aspect);
  const Node& n = scene.nodes[std::size_t(node)];
  return {scene.cameras[std::size_t(n.camera)], without_scale(world[std::size_t(node)])};
}

/// log2(z / n) / log2(f / n) is a depth of perspective cameras with a far plane only.
void check_depth(const Camera& camera, DepthMode depth) {
  if (depth != DepthMode::logarithmic || (!camera.orthographic && camera.far)) return;
  throw std::invalid_argument("depth is logarithmic, but camera '" + camera.name + "' " +
                              (camera.orthographic ? "is orthographic" : "has no far plane") +
                              "; must be a perspective one with a far plane");
}

Draw make_draw(const dmat4& world_from_object, const dmat4& clip_from_world) {
  Draw draw;
  draw.world_from_object = world_from_object;
  draw.clip_from_object = mat4(clip_from_world * world_from_object);
  const dmat3 linear{world_from_object};
  const double determinant = glm::determinant(linear);
  draw.mirrored = determinant < 0;
  // Cofactors point the way of the inverse transpose and exist for singular matrices too.
  const dmat3 cofactors{glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1])};
  draw.world_from_object_normal = determinant < 0 ? -cofactors : cofactors;
  return draw;
}

PlacedLight place_light(const Light& light, const dmat4& world_from_node) {
  const dvec3 along = -dvec3(world_from_node[2]);
  const double length = glm::length(along);
  return {light, dvec3(world_from_node[3]), length > 0 ? along / length : dvec3(0, 0, -1)};
}

/// A scene that brings no light gets a key light from the viewer's upper left, and a soft
/// environment; one that brings light gets none.
void add_default_light(Frame& frame, const dmat4& world_from_view) {
  Light key;
  key.name = "key";
  key.kind = LightKind::directional;
  key.intensity = 2.5f;
  const dvec3 toward = glm::normalize(dvec3(dmat3(world_from_view) * dvec3(-0.5, 0.8, 1.0)));
  frame.lights.push_back({key, dvec3(0.0), -toward});
  frame.ambient = vec3(0.35f);
}

}  // namespace

Frame make_frame(const Scene& scene, const FrameOptions& options) {
  check(options);
  Frame frame;
  frame.options = options;
  const double aspect = double(options.width) / options.height;
  const std::vector<dmat4> world = world_from_nodes(scene);
  const PlacedCamera placed = place_camera(scene, world, options, aspect);
  check_depth(placed.camera, options.depth);
  frame.view_from_world = glm::inverse(placed.world_from_view);
  frame.clip_from_view = clip_from_view(placed.camera, aspect, options.depth);
  frame.eye = dvec3(placed.world_from_view[3]);
  frame.backward = glm::normalize(dvec3(placed.world_from_view[2]));
  frame.orthographic = placed.camera.orthographic;
  frame.near = placed.camera.near;
  frame.far = placed.camera.far.value_or(0.0);
  const dmat4 clip_from_world = frame.clip_from_view * frame.view_from_world;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.light >= 0)
      frame.lights.push_back(place_light(scene.lights[std::size_t(node.light)], world[i]));
    if (node.mesh < 0) continue;
    Draw draw = make_draw(world[i], clip_from_world);
    draw.mesh = node.mesh;
    const auto& primitives = scene.meshes[std::size_t(node.mesh)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      draw.primitive = int(p);
      draw.material = primitives[p].material;
      frame.draws.push_back(draw);
    }
  }
  if (frame.lights.empty() && options.key_light) add_default_light(frame, placed.world_from_view);
  if (options.environment) frame.ambient = *options.environment;
  return frame;
}

dvec3 view_direction(const Frame& frame, dvec2 place) {
  if (frame.orthographic) return -frame.backward;
  const dvec2 clip = 2.0 * place / dvec2(frame.options.width, frame.options.height) - 1.0;
  const dmat4& p = frame.clip_from_view;
  const dvec3 in_view{(clip.x + p[2][0]) / p[0][0], (clip.y + p[2][1]) / p[1][1], -1};
  return glm::normalize(dmat3(glm::inverse(frame.view_from_world)) * in_view);
}

}  // namespace parity
