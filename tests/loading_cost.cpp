#include "tests/loading_cost.h"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>

#include "geometry/scene_io.h"
#include "tests/gltf_builder.h"

namespace parity {
namespace {

/// A line "name:   value kB" of /proc/self/status, in bytes.
std::size_t memory_status(const std::string& name) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return std::stoul(line.substr(name.size() + 1)) * 1024;
  return 0;
}

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const SceneMesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return count;
}

}  // namespace

std::vector<std::byte> waved_square(std::uint32_t side) {
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const float u = float(x) / float(side), v = float(y) / float(side);
      positions.insert(positions.end(), {u, 0.1f * std::sin(20 * u), v});
      normals.insert(normals.end(), {0, 1, 0});
      uvs.insert(uvs.end(), {u, v});
      if (x == side || y == side) continue;
      const std::uint32_t a = y * (side + 1) + x, b = a + side + 1;
      indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  GltfBuilder builder;
  const int position = builder.accessor(positions, "VEC3");
  const int normal = builder.accessor(normals, "VEC3");
  const int uv = builder.accessor(uvs, "VEC2");
  const int index = builder.accessor(indices, "SCALAR");
  builder.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
                {"indices", index}});
  return builder.glb();
}

LoadingCost cost_of_loading(const std::filesystem::path& file) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) try {
      ::malloc_trim(0);  // what the parent has freed must not serve the load
      const std::size_t before = memory_status("VmRSS");
      const auto start = std::chrono::steady_clock::now();
      const Scene scene = load_scene(file);
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
      rusage usage{};
      ::getrusage(RUSAGE_SELF, &usage);
      const LoadingCost cost{double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                                 1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
                             wall.count(), memory_status("VmHWM") - before, triangle_count(scene)};
      const bool sent = ::write(ends[1], &cost, sizeof cost) == ssize_t(sizeof cost);
      ::_exit(sent ? 0 : 1);
    } catch (...) {
      ::_exit(1);
    }
  ::close(ends[1]);
  LoadingCost cost;
  if (::read(ends[0], &cost, sizeof cost) != ssize_t(sizeof cost)) cost = {};
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return cost;
}

}  // namespace parity
