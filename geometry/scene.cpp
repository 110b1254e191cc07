#include "geometry/scene.h"

#include <algorithm>

namespace parity {

std::vector<dmat4> world_from_nodes(const Scene& scene) {
  std::vector<dmat4> world(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    world[i] = node.parent < 0 ? node.parent_from_node
                               : world[std::size_t(node.parent)] * node.parent_from_node;
  }
  return world;
}

Bounds world_bounds(const Scene& scene) {
  Bounds bounds;
  const std::vector<dmat4> world = world_from_nodes(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[std::size_t(scene.nodes[i].mesh)].primitives)
      for (const vec3& position : primitive.positions) {
        const dvec3 p = dvec3(world[i] * dvec4(dvec3(position), 1.0));
        bounds.min = bounds.empty ? p : glm::min(bounds.min, p);
        bounds.max = bounds.empty ? p : glm::max(bounds.max, p);
        bounds.empty = false;
      }
  }
  return bounds;
}

}  // namespace parity
