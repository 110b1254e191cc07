#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "geometry/mesh.h"
#include "geometry/scene.h"

namespace parity {

/// A scene of one node that shows the mesh: a primitive for each material, faces cut into
/// triangles.
///
/// Where a corner has no normal it gets the mean, weighted by area, of the faces around its vertex
/// that turn by less than 60 degrees from its own. Materials are double-sided; Kd is the base
/// colour, alpha of the microfacet model is sqrt(2 / (Ns + 2)) unless Pr is given, map_Kd is read
/// if it is a PNG or JPEG in the folder. Faces without material are grey, of roughness 0.5.
///
/// @param mesh    as load_mesh gives it.
/// @param folder  where map_Kd is looked for; none: no file is opened.
///
/// Source: Walter et al. 2007 for the roughness of a Phong exponent.
Scene scene_from_mesh(const Mesh& mesh, const std::string& name,
                      const std::optional<std::filesystem::path>& folder);

}  // namespace parity
