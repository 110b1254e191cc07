#pragma once

#include <vector>

#include "geometry/scene.h"

namespace parity {

struct PlacedCamera {
  Camera camera;
  dmat4 world_from_view{1.0};
};

/// A perspective camera that shows the whole scene, from the front right above. If only backs of
/// single-sided triangles are seen from there: from the side from which most front-facing area is.
///
/// @param world_from_nodes  of the scene, one a node.
PlacedCamera framing_camera(const Scene& scene, const std::vector<dmat4>& world_from_nodes,
                            double aspect);

}  // namespace parity
