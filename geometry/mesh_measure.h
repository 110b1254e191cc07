#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace parity {

/// What a mesh is. "Edge": a pair of different vertices that follow each other in some face.
/// Vertices count only where a face uses them, unless it says otherwise.
struct MeshReport {
  std::size_t vertices = 0;  ///< all, used or not
  std::size_t unused_vertices = 0;
  std::size_t duplicate_vertices = 0;  ///< used, and at the place of an earlier one
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;  ///< faces of three corners
  std::size_t quads = 0;
  std::size_t polygons = 0;            ///< faces of five corners or more
  std::size_t triangles_when_cut = 0;  ///< that triangulate gives
  std::size_t degenerate_triangles =
      0;                            ///< of the fans from each face's first corner: area 0 in double
  std::size_t pinched_faces = 0;    ///< that visit a vertex twice
  std::size_t duplicate_faces = 0;  ///< with the vertices of an earlier one, in any order
  std::size_t components = 0;       ///< of faces that share vertices

  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  std::size_t nonmanifold_edges = 0;  ///< with more than two faces
  std::size_t most_faces_at_edge = 0;
  std::array<std::uint32_t, 2> crowded_edge{};  ///< the first edge with that many; from 0
  std::size_t nonmanifold_vertices = 0;  ///< whose faces fall apart into several fans (bow ties)
  std::optional<std::uint32_t> first_nonmanifold_vertex;  ///< from 0
  bool manifold = false;  ///< no such edges, no such vertices, no pinched faces

  std::size_t misoriented_edges = 0;  ///< of two faces that both go the same way along it
  bool oriented = false;              ///< no misoriented edge
  bool orientable = false;            ///< faces can be turned so that none is left
  bool closed = false;                ///< faces, and no boundary edge

  std::int64_t euler_characteristic = 0;  ///< vertices - edges + faces
  std::optional<std::int64_t> genus;      ///< of all components together: manifold and orientable
  /// Of all components together, if manifold and not orientable; a handle counts twice.
  std::optional<std::int64_t> nonorientable_genus;

  dvec3 min{0.0}, max{0.0};      ///< m, of the used vertices
  double area = 0.0;             ///< m^2, of the triangles
  std::optional<double> volume;  ///< m^3, if closed, manifold and oriented; negative: inside out
};

/// Measures a mesh.
///
/// @param mesh  as load_mesh gives it: corners are vertices, coordinates finite.
///
/// Source: notes 4.1; genus from V - E + F = 2 C - 2 g - B, or 2 C - k - B if not orientable.
MeshReport measure(const Mesh& mesh);

/// Refuses a mesh with an edge at which more than four faces meet. Real files hold edges of three
/// faces (a wall that stands on a floor) and of four (two solids that touch along an edge): they
/// are measured, shown and called non-manifold. More sheets on one edge are a book, the side of no
/// solid and of no surface: nothing that works on surfaces can mean it, so it is refused before the
/// work.
///
/// @param name  of the file, for the message.
/// @throws InputError  with the edge and its number of faces.
void refuse_crowded_edges(const MeshReport& report, const std::string& name);

}  // namespace parity
