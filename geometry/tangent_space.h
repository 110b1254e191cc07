#pragma once

#include <vector>

#include "geometry/scene.h"

namespace parity {

/// A normal for every triangle: every corner becomes its own vertex.
///
/// @param primitive  triangles with area and finite positions.
void make_flat_normals(Primitive& primitive);

/// Tangents for normal maps. Vertices are split where the texture is mirrored or torn.
///
/// w is the sign with which bitangent = w cross(normal, tangent) points up in the picture, that is
/// towards smaller v.
///
/// @param primitive  triangles with area and unit normals.
/// @param uvs        texture coordinates, one a vertex of the primitive.
///
/// Source: Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, and the rules of
/// mikktspace.c that glTF 2.0 asks for: triangles that share a welded edge and an orientation form
/// a group; the tangents of a group are averaged, weighted by the angle at the corner.
void make_tangents(Primitive& primitive, const std::vector<vec2>& uvs);

}  // namespace parity
