#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "geometry/input_error.h"
#include "geometry/scene_io.h"
#include "tests/gltf_builder.h"

/// What the tests of the scene loader share.
namespace parity {

inline Scene load(const GltfBuilder& builder) {
  return load_scene_from_memory(builder.glb(), "test.glb");
}

/// The message with which a file is refused; empty: it was not.
inline std::string refusal(const GltfBuilder& builder) {
  try {
    load(builder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline const Primitive& first_primitive(const Scene& scene) {
  return scene.meshes.at(0).primitives.at(0);
}

//  3---2
//  | / |    in the plane z = 0
//  0---1
inline const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

inline GltfBuilder square_with_indices(const std::vector<std::uint16_t>& indices, int mode) {
  GltfBuilder builder;
  const int position = builder.accessor(square, "VEC3");
  const int index = builder.accessor(indices, "SCALAR");
  builder.show({{"attributes", {{"POSITION", position}}}, {"indices", index}, {"mode", mode}});
  return builder;
}

inline GltfBuilder plain_square() { return square_with_indices({0, 1, 2, 0, 2, 3}, 4); }

/// Corners in the order in which they are drawn.
inline std::vector<vec3> corners(const Primitive& primitive) {
  std::vector<vec3> list;
  for (std::uint32_t index : primitive.indices) list.push_back(primitive.positions[index]);
  return list;
}

inline const vec3 p0{0, 0, 0}, p1{1, 0, 0}, p2{1, 1, 0}, p3{0, 1, 0};

/// A 4 x 4 PNG, so that textures have something to show.
inline const char* const pixel_uri =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAIAAAAmkwkpAAAAM0lEQVR42mNgUPXKn7LzHrOGb"
    "9F0BjC55yGbdkDpLAYwuf8Jp15wxVwGMHnoOY9hWPUCANhzEwEv1og0AAAAAElFTkSuQmCC";

inline GltfBuilder square_with_material(const nlohmann::json& material) {
  GltfBuilder builder = plain_square();
  const int uv = builder.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
  const int half = builder.accessor(std::vector<float>{0, .5f, .5f, .5f, .5f, 0, 0, 0}, "VEC2");
  builder.root["meshes"][0]["primitives"][0]["attributes"].update(
      {{"TEXCOORD_0", uv}, {"TEXCOORD_1", half}});
  builder.root["meshes"][0]["primitives"][0]["material"] = 0;
  builder.root["images"] = {{{"uri", pixel_uri}}};
  builder.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"minFilter", 9728}}};
  builder.root["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
  builder.root["materials"] = nlohmann::json::array({material});
  return builder;
}

}  // namespace parity
