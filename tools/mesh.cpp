#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "geometry/mesh_io.h"
#include "geometry/mesh_measure.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct InfoOptions {
  std::string file;
  bool json = false;
};

const char* yes_or_no(bool value) { return value ? "yes" : "no"; }

std::vector<std::string> warnings(const Mesh& mesh, const MeshReport& report) {
  std::vector<std::string> list = mesh.notes;
  if (report.first_nonmanifold_vertex)
    list.push_back("not manifold: separate fans of faces meet at vertex " +
                   std::to_string(*report.first_nonmanifold_vertex) + " (from 0), and at " +
                   std::to_string(report.nonmanifold_vertices - 1) + " more.");
  if (report.nonmanifold_edges > 0)
    list.push_back("not manifold: " + std::to_string(report.nonmanifold_edges) +
                   " edges with more than two faces, up to " +
                   std::to_string(report.most_faces_at_edge) + ".");
  if (!report.orientable) list.push_back("not orientable: the surface has one side.");
  return list;
}

std::string genus_text(const MeshReport& report) {
  if (report.genus) return std::to_string(*report.genus);
  if (report.nonorientable_genus) return std::to_string(*report.nonorientable_genus) + " crosscaps";
  return "none, as it is not manifold";
}

void print(const MeshReport& r) {
  std::printf("vertices      %zu (%zu unused, %zu at the place of another)\n", r.vertices,
              r.unused_vertices, r.duplicate_vertices);
  std::printf("edges         %zu (%zu boundary, %zu with more than two faces)\n", r.edges,
              r.boundary_edges, r.nonmanifold_edges);
  std::printf("faces         %zu (%zu triangles, %zu quads, %zu with more corners; %zu repeated)\n",
              r.faces, r.triangles, r.quads, r.polygons, r.duplicate_faces);
  std::printf("triangles     %zu when cut; %zu of area 0\n", r.triangles_when_cut,
              r.degenerate_triangles);
  std::printf("components    %zu\n", r.components);
  std::printf("loops         %zu boundary\n", r.boundary_loops);
  std::printf("Euler number  %lld\n", static_cast<long long>(r.euler_characteristic));
  std::printf("genus         %s\n", genus_text(r).c_str());
  std::printf("manifold      %s\n", yes_or_no(r.manifold));
  std::printf("orientable    %s", yes_or_no(r.orientable));
  std::printf("; %zu edges go the same way in both faces\n", r.misoriented_edges);
  std::printf("closed        %s\n", yes_or_no(r.closed));
  std::printf("bounds        (%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g) m\n", r.min.x, r.min.y,
              r.min.z, r.max.x, r.max.y, r.max.z);
  std::printf("area          %.9g m^2\n", r.area);
  if (r.volume) std::printf("volume        %.9g m^3\n", *r.volume);
}

template <typename T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json to_json(const std::string& file, const MeshReport& r,
                       const std::vector<std::string>& notes) {
  return {{"version", 1},
          {"file", file},
          {"vertices", r.vertices},
          {"unused_vertices", r.unused_vertices},
          {"duplicate_vertices", r.duplicate_vertices},
          {"edges", r.edges},
          {"boundary_edges", r.boundary_edges},
          {"nonmanifold_edges", r.nonmanifold_edges},
          {"nonmanifold_vertices", r.nonmanifold_vertices},
          {"faces", r.faces},
          {"triangles", r.triangles},
          {"quads", r.quads},
          {"polygons", r.polygons},
          {"triangles_when_cut", r.triangles_when_cut},
          {"degenerate_triangles", r.degenerate_triangles},
          {"pinched_faces", r.pinched_faces},
          {"duplicate_faces", r.duplicate_faces},
          {"components", r.components},
          {"boundary_loops", r.boundary_loops},
          {"euler_characteristic", r.euler_characteristic},
          {"genus", or_null(r.genus)},
          {"nonorientable_genus", or_null(r.nonorientable_genus)},
          {"manifold", r.manifold},
          {"orientable", r.orientable},
          {"oriented", r.oriented},
          {"misoriented_edges", r.misoriented_edges},
          {"closed", r.closed},
          {"min_m", {r.min.x, r.min.y, r.min.z}},
          {"max_m", {r.max.x, r.max.y, r.max.z}},
          {"area_m2", r.area},
          {"volume_m3", or_null(r.volume)},
          {"notes", notes}};
}

void print_info(const InfoOptions& options) {
  const Mesh mesh = load_mesh(options.file);
  const MeshReport report = measure(mesh);
  refuse_crowded_edges(report, options.file);
  const std::vector<std::string> notes = warnings(mesh, report);
  for (const std::string& note : notes)
    std::fprintf(stderr, "parity: warning: %s: %s\n", options.file.c_str(), note.c_str());
  if (options.json)
    std::printf("%s\n", to_json(options.file, report, notes)
                            .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                            .c_str());
  else
    print(report);
}

}  // namespace

void add_mesh_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("mesh", "Work on polygon meshes (OBJ, PLY, STL, OFF)");
  verb->require_subcommand(1);
  CLI::App* info = verb->add_subcommand(
      "info", "Print what a mesh is: counts, components, loops, genus, manifold, orientable, size");
  const auto options = std::make_shared<InfoOptions>();
  info->add_option("FILE", options->file, "The mesh")->required();
  info->add_flag("--json", options->json, "Machine-readable output");
  info->footer(
      "A mesh with an edge at which more than four faces meet is refused.\n"
      "Examples:\n  parity mesh info bunny.obj\n  parity mesh info --json scan.ply");
  info->callback([options, &exit_code] {
    print_info(*options);
    exit_code = 0;
  });
}

}  // namespace parity::tools
