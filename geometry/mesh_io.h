#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "geometry/mesh.h"

/// Polygon meshes in files: OBJ (with MTL), PLY, STL and OFF; the name's ending says which.
namespace parity {

/// A mesh from a file's bytes, checked: at least one face in the file, every corner a vertex, every
/// number finite, every face three corners or more. What is left out or mended is in its notes.
///   OBJ  v (with colours), vt, vn, f with absolute and relative indices, usemtl, mtllib, lines
///        continued with a backslash; points, lines, curves and free forms are left out
///   PLY  ascii and binary of either byte order; all scalar types; normals, colours (whole numbers
///        are decoded from sRGB, real ones are linear) and texture coordinates of vertices; other
///        elements and properties are passed over
///   STL  ascii (any number of solids) and binary; equal corners become one vertex; a facet with a
///        coordinate that is not finite is left out
///   OFF  with colours (COFF), normals and texture coordinates
/// Faces with fewer than three corners are left out, with a note.
///
/// @param name  of the file, for its ending and for messages. An MTL file is not opened.
/// @throws InputError  another ending, malformed, cut short, without a face, or more is claimed
/// than
///                     the file can hold.
///
/// Source: Wavefront, "Object files (.obj)"; Turk, "The PLY polygon file format"; 3D Systems,
/// "StereoLithography interface specification"; Geomview manual, "OFF files".
Mesh decode_mesh(std::span<const std::byte> bytes, const std::string& name);

/// The same from a file, with the materials of an OBJ. A material file that is missing or not in
/// the folder of the mesh (or below it) is passed over with a note.
///
/// @throws InputError  missing, a folder, or as decode_mesh; a malformed number in an MTL file.
Mesh load_mesh(const std::filesystem::path& path);

/// Writes a mesh; the name's ending chooses the format. Materials are not written.
///   .obj  positions, colours, texture coordinates, normals
///   .ply  binary little-endian; positions and 8-bit sRGB colours
///   .stl  binary; triangles only (faces are cut by triangulate)
///   .off  ascii; positions
/// The file appears whole or not at all. Positions come back with the same bits.
///
/// @throws std::invalid_argument  another ending.
/// @throws OutputError  the file cannot be written.
void save_mesh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace parity
