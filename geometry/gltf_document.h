#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/scene.h"

/// What a glTF file says, as plain values and in its own numbering: the middle of the loader,
/// between the JSON (gltf_parse_io) and the Scene (gltf_convert). Every index is in range and every
/// number inside the range of the specification; nothing is known yet of the bytes in the buffers.
namespace parity::gltf {

enum class ComponentType {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126,
};

/// Bytes of one component.
int component_size(ComponentType type);

struct Buffer {
  std::string uri;  ///< empty: the BIN chunk of a GLB, or a placeholder of EXT_meshopt_compression
  bool has_uri = false;
  std::uint64_t length = 0;
  bool fallback = false;  ///< EXT_meshopt_compression: only for readers that cannot decode
};

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// EXT_meshopt_compression of a buffer view.
struct CompressedView {
  int buffer = -1;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
};

struct View {
  int buffer = -1;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< 0: packed
  std::optional<CompressedView> meshopt;
};

struct Sparse {
  std::uint64_t count = 0;
  int index_view = -1;
  std::uint64_t index_offset = 0;
  ComponentType index_type = ComponentType::uint16;
  int value_view = -1;
  std::uint64_t value_offset = 0;
};

struct Accessor {
  int view = -1;  ///< -1: zeros
  std::uint64_t offset = 0;
  ComponentType component = ComponentType::float32;
  bool normalized = false;
  std::uint64_t count = 0;
  int components = 1;  ///< 1 to 4, or 4, 9, 16 for matrices
  bool matrix = false;
  std::optional<Sparse> sparse;
  std::vector<double> min;
  std::vector<double> max;
};

using Attributes = std::map<std::string, int>;  ///< semantic to accessor

struct Draco {
  int view = -1;
  Attributes attributes;  ///< semantic to unique id
};

struct Primitive {
  Attributes attributes;
  int indices = -1;
  int material = -1;
  int mode = 4;
  std::vector<Attributes> targets;
  std::optional<Draco> draco;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<double> weights;
};

struct Node {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  dmat4 parent_from_node{1.0};
  int mesh = -1;
  int camera = -1;
  int light = -1;
  int skin = -1;
  std::vector<double> weights;
  Attributes instances;  ///< EXT_mesh_gpu_instancing; empty: none
};

struct Skin {
  int inverse_bind_matrices = -1;
  int skeleton = -1;
  std::vector<int> joints;
};

struct Channel {
  int sampler = -1;
  int node = -1;
  std::string path;
};

struct AnimationSampler {
  int input = -1;
  int output = -1;
  bool cubic = false;
};

struct Animation {
  std::vector<Channel> channels;
  std::vector<AnimationSampler> samplers;
};

struct Image {
  std::string uri;
  bool has_uri = false;
  int view = -1;
  std::string mime_type;
};

struct Texture {
  int sampler = -1;
  int image = -1;  ///< -1: in a format that is not read
};

struct Document {
  std::vector<Buffer> buffers;
  std::vector<View> views;
  std::vector<Accessor> accessors;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<Image> images;
  std::vector<Texture> textures;
  std::vector<Sampler> samplers;
  std::vector<Material> materials;  ///< TextureUse::texture counts in `textures` above
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<std::vector<int>> scenes;
  int scene = -1;  ///< -1: the file has no scene
  std::vector<std::string> notes;
};

}  // namespace parity::gltf
