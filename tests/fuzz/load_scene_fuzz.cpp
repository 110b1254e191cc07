#include <cmath>
#include <cstdlib>

#include "geometry/input_error.h"
#include "geometry/scene_io.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// What renderers rely on without looking.
void check(const parity::Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const parity::Node& node = scene.nodes[i];
    require(node.parent < int(i) && node.mesh < int(scene.meshes.size()));
    require(node.camera < int(scene.cameras.size()) && node.light < int(scene.lights.size()));
  }
  for (const parity::SceneMesh& mesh : scene.meshes)
    for (const parity::Primitive& primitive : mesh.primitives) {
      const std::size_t count = primitive.positions.size();
      for (const std::uint32_t index : primitive.indices) require(index < count);
      for (const parity::vec3& p : primitive.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      for (const parity::vec3& n : primitive.normals) require(std::abs(glm::length(n) - 1) < 1e-5f);
      for (const auto& uvs : primitive.uvs) require(uvs.empty() || uvs.size() == count);
      require(primitive.tangents.empty() || primitive.tangents.size() == count);
      require(primitive.colors.empty() || primitive.colors.size() == count);
      require(primitive.material < int(scene.materials.size()));
    }
  for (const parity::Texture& texture : scene.textures)
    require(texture.image >= 0 && texture.image < int(scene.images.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check(parity::load_scene_from_memory(std::as_bytes(std::span(data, size)), "fuzz"));
  } catch (const parity::InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos);
  }
  return 0;
}
