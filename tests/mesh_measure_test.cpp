#include "geometry/mesh_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/input_error.h"
#include "geometry/mesh_io.h"
#include "geometry/mesh_triangulate.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

Mesh make_mesh(std::vector<vec3> positions, const std::vector<std::vector<std::uint32_t>>& faces) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_begin.push_back(std::uint32_t(mesh.corners.size()));
  }
  return mesh;
}

/// What another program (in Python, from the same files) measured.
struct Measured {
  const char* file;
  std::size_t vertices, faces, triangles_when_cut, quads, polygons, edges, boundary_edges;
  std::size_t nonmanifold_edges, misoriented, unused, components, loops, nonmanifold_vertices;
  std::int64_t euler_characteristic;
  double genus;  ///< halves for surfaces with one side; -1: not a manifold
  std::size_t duplicate_faces, degenerate_triangles, duplicate_vertices;
};

constexpr Measured measured[] = {
    {"mesh/spot_control.obj", 188, 180, 372, 160, 16, 366, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/spot.obj", 2930, 5856, 5856, 0, 0, 8784, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/spot_23k.obj", 11533, 23062, 23062, 0, 0, 34593, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/torus.obj", 2304, 4608, 4608, 0, 0, 6912, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
    {"mesh/bob_small.ply", 250, 500, 500, 0, 0, 750, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
    {"mesh/double-torus.obj", 3070, 6144, 6144, 0, 0, 9216, 0, 0, 0, 0, 1, 0, 0, -2, 2, 0, 0, 0},
    {"mesh/boot.obj", 19931, 39906, 39906, 0, 0, 59859, 0, 0, 0, 0, 1, 0, 0, -22, 12, 0, 0, 0},
    {"mesh/bunny_6k.obj", 3301, 6598, 6598, 0, 0, 9897, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/bunny_zipper_69k.ply", 35947, 69451, 69451, 0, 0, 104288, 223, 0, 0, 1113, 1, 5, 0, -3,
     0, 0, 0, 0},
    {"mesh/armadillo_29k.obj", 14587, 29170, 29170, 0, 0, 43755, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0,
     0},
    {"mesh/nefertiti_70k.obj", 35002, 70000, 70000, 0, 0, 105000, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0,
     0},
    {"mesh/mountain.obj", 25600, 50562, 50562, 0, 0, 76161, 636, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0},
    {"mesh/hemisphere.obj", 2051, 4000, 4000, 0, 0, 6050, 100, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0},
    {"mesh/face.obj", 17157, 34144, 34144, 0, 0, 51300, 168, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0},
    {"mesh/punctured-torus.obj", 4599, 9184, 9184, 0, 0, 13784, 16, 0, 0, 0, 1, 1, 0, -1, 1, 0, 0,
     0},
    {"mesh/plane_holes.obj", 8519, 16747, 16747, 0, 0, 25291, 341, 0, 0, 0, 1, 27, 0, -25, 0, 0, 0,
     0},
    {"mesh/maze.obj", 6120, 9174, 9174, 0, 0, 15293, 3064, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0},
    {"mesh/moebius.obj", 280, 224, 448, 224, 0, 504, 112, 0, 4, 0, 1, 1, 0, 0, 0.5, 0, 0, 0},
    {"mesh/hourglass_ico.obj", 23, 40, 40, 0, 0, 60, 0, 0, 0, 0, 1, 0, 1, 3, -1, 0, 0, 0},
    {"mesh/fan3.obj", 5, 3, 3, 0, 0, 7, 6, 1, 0, 0, 1, 1, 0, 1, -1, 0, 0, 0},
    {"mesh/triple_vierbein.obj", 75, 108, 108, 0, 0, 182, 60, 20, 3, 0, 1, 1, 0, 1, -1, 0, 0, 0},
    {"mesh/platonic_shelf.obj", 50, 50, 80, 6, 12, 90, 0, 0, 0, 0, 5, 0, 0, 10, 0, 0, 0, 0},
    {"mesh/fox.ply", 313, 622, 622, 0, 0, 933, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/inverted_triangles.obj", 12577, 24685, 24685, 0, 0, 37266, 477, 0, 23889, 0, 1, 6, 0, -4,
     0, 0, 0, 0},
    {"mesh/capsule.obj", 5252, 10200, 10200, 0, 0, 15451, 302, 0, 0, 0, 1, 1, 0, 1, 0, 0, 200, 250},
    {"mesh/joined_tetrahedra.obj", 5, 8, 8, 0, 0, 9, 0, 3, 0, 0, 1, 0, 0, 4, -1, 1, 0, 0},
    {"mesh/soup.stl", 300, 100, 100, 0, 0, 300, 300, 0, 0, 0, 100, 100, 0, 100, 0, 0, 0, 0},
    {"mesh/multibody.stl", 20, 32, 32, 0, 0, 48, 0, 0, 12, 0, 2, 0, 0, 4, 0, 0, 0, 0},
    {"mesh/icosahedron_ascii.stl", 12, 20, 20, 0, 0, 30, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/icosahedron_binary.stl", 12, 20, 20, 0, 0, 30, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/fandisk_quads.off", 766, 764, 1528, 764, 0, 1528, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"mesh/polygonfaces.obj", 5, 1, 3, 0, 1, 5, 5, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0},
    {"mesh/wallhole.obj", 92, 13, 66, 0, 13, 92, 92, 0, 0, 0, 13, 13, 0, 13, 0, 0, 11, 57},
    {"mesh/torus_sph.obj", 400, 800, 800, 0, 0, 1200, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
    {"mesh/unitbox_sph.obj", 8, 12, 12, 0, 0, 18, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0},
    {"cornell/cornell_box.obj", 76, 18, 36, 18, 0, 72, 72, 0, 0, 4, 18, 18, 0, 18, 0, 0, 0, 44},
    {"mesh/dragon_871k.ply", 437645, 871414, 871414, 0, 0, 1309256, 4270, 0, 0, 0, 151, 407, 0,
     -197, 46, 0, 108, 2100},
};

TEST(MeshMeasure, AgreesWithThePublishedMeasuresOfEveryMesh) {
  if (!shared_data("data/mesh")) GTEST_SKIP() << "skipped: no shared data";
  for (const Measured& want : measured) {
    SCOPED_TRACE(want.file);
    const MeshReport got = measure(load_mesh(*shared_data(std::string("data/") + want.file)));
    EXPECT_EQ(got.vertices, want.vertices);
    EXPECT_EQ(got.faces, want.faces);
    EXPECT_EQ(got.triangles_when_cut, want.triangles_when_cut);
    EXPECT_EQ(got.quads, want.quads);
    EXPECT_EQ(got.polygons, want.polygons);
    EXPECT_EQ(got.edges, want.edges);
    EXPECT_EQ(got.boundary_edges, want.boundary_edges);
    EXPECT_EQ(got.nonmanifold_edges, want.nonmanifold_edges);
    EXPECT_EQ(got.misoriented_edges, want.misoriented);
    EXPECT_EQ(got.unused_vertices, want.unused);
    EXPECT_EQ(got.components, want.components);
    EXPECT_EQ(got.boundary_loops, want.loops);
    EXPECT_EQ(got.nonmanifold_vertices, want.nonmanifold_vertices);
    EXPECT_EQ(got.euler_characteristic, want.euler_characteristic);
    const double genus = got.genus                 ? double(*got.genus)
                         : got.nonorientable_genus ? double(*got.nonorientable_genus) / 2.0
                                                   : -1.0;
    EXPECT_EQ(genus, want.genus);
    EXPECT_EQ(got.duplicate_faces, want.duplicate_faces);
    EXPECT_EQ(got.degenerate_triangles, want.degenerate_triangles);
    EXPECT_EQ(got.duplicate_vertices, want.duplicate_vertices);
  }
}

const std::vector<vec3> cube_corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<std::vector<std::uint32_t>> cube_faces = {
    {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

TEST(MeshMeasure, ACubeIsASolidOfVolumeOne) {
  const MeshReport cube = measure(make_mesh(cube_corners, cube_faces));
  EXPECT_TRUE(cube.closed && cube.manifold && cube.oriented && cube.orientable);
  EXPECT_EQ(cube.euler_characteristic, 2);
  EXPECT_EQ(cube.genus, 0);
  EXPECT_EQ(cube.area, 6.0);
  // Twelve sixths of 1/2: each product is exact, the sum of twelve is not.
  ASSERT_TRUE(cube.volume.has_value());
  EXPECT_NEAR(*cube.volume, 1.0, 12 * 0x1p-53);
  EXPECT_EQ(cube.min, dvec3(0.0));
  EXPECT_EQ(cube.max, dvec3(1.0));
}

TEST(MeshMeasure, AFaceTurnedOverIsFoundAndCanBeTurnedBack) {
  auto faces = cube_faces;
  std::reverse(faces[2].begin(), faces[2].end());
  const MeshReport cube = measure(make_mesh(cube_corners, faces));
  EXPECT_EQ(cube.misoriented_edges, 4u);
  EXPECT_TRUE(cube.orientable);
  EXPECT_FALSE(cube.oriented);
  EXPECT_FALSE(cube.volume.has_value());
}

TEST(MeshMeasure, ABodyInsideOutHasNegativeVolume) {
  auto faces = cube_faces;
  for (auto& face : faces) std::reverse(face.begin(), face.end());
  const MeshReport cube = measure(make_mesh(cube_corners, faces));
  ASSERT_TRUE(cube.volume.has_value());
  EXPECT_LT(*cube.volume, 0.0);
}

//  0---1---2   two squares side by side, and a third that joins the edge 2-5 to 3-0, half a turn
//  |   |   |   round: a band with one side
//  3---4---5
TEST(MeshMeasure, AMoebiusBandHasOneSideAndOneBoundary) {
  const std::vector<vec3> p = {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const MeshReport band = measure(make_mesh(p, {{0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 0, 3}}));
  EXPECT_FALSE(band.orientable);
  EXPECT_EQ(band.boundary_loops, 1u);
  EXPECT_EQ(band.euler_characteristic, 0);
  EXPECT_EQ(band.nonorientable_genus, 1);
  EXPECT_FALSE(band.genus.has_value());
}

//  0   3
//  |\ /|   two triangles that touch at vertex 2
//  | 2 |
//  |/ \|
//  1   4
TEST(MeshMeasure, ABowTieIsNamedAndHasTwoLoops) {
  const std::vector<vec3> p = {{0, 2, 0}, {0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {2, 0, 0}};
  const MeshReport tie = measure(make_mesh(p, {{0, 1, 2}, {2, 4, 3}}));
  EXPECT_FALSE(tie.manifold);
  EXPECT_EQ(tie.nonmanifold_vertices, 1u);
  EXPECT_EQ(tie.first_nonmanifold_vertex, 2u);
  EXPECT_EQ(tie.boundary_loops, 2u);
  EXPECT_EQ(tie.components, 1u);
}

TEST(MeshMeasure, AnEmptyMeshIsNothing) {
  const MeshReport nothing = measure(Mesh{});
  EXPECT_EQ(nothing.components, 0u);
  EXPECT_EQ(nothing.euler_characteristic, 0);
  EXPECT_FALSE(nothing.closed);
}

TEST(MeshMeasure, FacesThatRepeatCornersAreCountedNotTrusted) {
  const std::vector<vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const MeshReport report = measure(make_mesh(p, {{0, 0, 1}, {0, 1, 2}, {2, 0, 1}}));
  EXPECT_EQ(report.pinched_faces, 1u);
  EXPECT_EQ(report.duplicate_faces, 1u);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_FALSE(report.manifold);
}

TEST(MeshMeasure, RefusesABookButNotAWallOnAFloor) {
  std::vector<vec3> p = {{0, 0, 0}, {0, 0, 1}};
  std::vector<std::vector<std::uint32_t>> pages;
  for (std::uint32_t i = 0; i < 5; ++i) {
    p.push_back({std::cos(float(i)), std::sin(float(i)), 0.0f});
    pages.push_back({0, 1, i + 2});
    const MeshReport report = measure(make_mesh(p, pages));
    EXPECT_EQ(report.most_faces_at_edge, i + 1);
    if (i < 4)
      EXPECT_NO_THROW(refuse_crowded_edges(report, "book"));
    else
      EXPECT_THROW(refuse_crowded_edges(report, "book"), InputError);
  }
}

/// The sum of the triangles' areas, each taken positive, and their number.
void expect_cut_without_overlap(const std::vector<vec3>& polygon, double area) {
  std::vector<std::uint32_t> face(polygon.size());
  for (std::uint32_t i = 0; i < face.size(); ++i) face[i] = i;
  for (int turn = 0; turn < int(face.size()); ++turn) {  // from whichever corner it starts
    std::rotate(face.begin(), face.begin() + 1, face.end());
    const Mesh mesh = make_mesh(polygon, {face});
    EXPECT_EQ(triangulate(mesh).size(), polygon.size() - 2);
    EXPECT_NEAR(measure(mesh).area, area, 1e-12 * area);
  }
}

TEST(Triangulate, ConcavePolygonsAreNotOverlapped) {
  expect_cut_without_overlap({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}, 10.0);
  // An L and a comb, in planes that face each axis.
  expect_cut_without_overlap({{0, 0, 0}, {0, 2, 0}, {0, 2, 1}, {0, 1, 1}, {0, 1, 2}, {0, 0, 2}},
                             3.0);
  std::vector<vec3> comb = {{0, 5, 9}, {0, 5, 0}};
  for (int tooth = 0; tooth < 4; ++tooth) {
    comb.push_back({float(2 * tooth + 1), 5, 0});
    comb.push_back({float(2 * tooth + 1), 5, 8});
    comb.push_back({float(2 * tooth + 2), 5, 8});
    comb.push_back({float(2 * tooth + 2), 5, 0});
  }
  comb.push_back({9, 5, 0});
  comb.push_back({9, 5, 9});
  expect_cut_without_overlap(comb, 81.0 - 4 * 8.0);
}

TEST(Triangulate, ConvexPolygonsAreFans) {
  std::vector<vec3> polygon;
  std::vector<std::uint32_t> face;
  for (std::uint32_t i = 0; i < 7; ++i) {
    const float angle = 2.0f * std::numbers::pi_v<float> * float(i) / 7.0f;
    polygon.push_back({std::cos(angle), std::sin(angle), 0.0f});
    face.push_back(i);
  }
  const std::vector<CornerTriangle> triangles = triangulate(make_mesh(polygon, {face}));
  ASSERT_EQ(triangles.size(), 5u);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(triangles[i], (CornerTriangle{0, i + 1, i + 2}));
}

TEST(Triangulate, EndsOnPolygonsWithoutAnInside) {
  Mesh mesh = make_mesh({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 2}}, {{0, 1, 2, 3, 4}});
  EXPECT_EQ(triangulate(mesh).size(), 3u);
  mesh.positions.assign(5, vec3(1.0f));
  EXPECT_EQ(triangulate(mesh).size(), 3u);
}

}  // namespace
}  // namespace parity
