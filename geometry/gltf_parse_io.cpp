#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/gltf_guard.h"
#include "geometry/gltf_parse.h"
#include "geometry/gltf_schema.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

using Extensions = tinygltf::ExtensionMap;

const tinygltf::Value* find(const Extensions& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

std::uint64_t size_value(const tinygltf::Value& object, const std::string& key) {
  return object.Has(key) ? std::uint64_t(object.Get(key).GetNumberAsDouble()) : 0;
}

std::string text_value(const tinygltf::Value& object, const std::string& key) {
  return object.Has(key) ? object.Get(key).Get<std::string>() : std::string();
}

Attributes map_value(const tinygltf::Value& object, const std::string& key) {
  Attributes attributes;
  if (!object.Has(key)) return attributes;
  for (const auto& [name, value] : object.Get(key).Get<tinygltf::Value::Object>())
    attributes[name] = value.GetNumberAsInt();
  return attributes;
}

CompressedView compressed_view(const tinygltf::Value& from) {
  CompressedView view;
  view.buffer = int(size_value(from, "buffer"));
  view.offset = size_value(from, "byteOffset");
  view.length = size_value(from, "byteLength");
  view.stride = size_value(from, "byteStride");
  view.count = size_value(from, "count");
  const std::string mode = text_value(from, "mode");
  if (mode == "TRIANGLES") view.mode = MeshoptMode::triangles;
  if (mode == "INDICES") view.mode = MeshoptMode::indices;
  const std::string filter = text_value(from, "filter");
  if (filter == "OCTAHEDRAL") view.filter = MeshoptFilter::octahedral;
  if (filter == "QUATERNION") view.filter = MeshoptFilter::quaternion;
  if (filter == "EXPONENTIAL") view.filter = MeshoptFilter::exponential;
  return view;
}

View convert_view(const tinygltf::BufferView& from) {
  View view{.buffer = from.buffer,
            .offset = from.byteOffset,
            .length = from.byteLength,
            .stride = from.byteStride,
            .meshopt = std::nullopt};
  if (const tinygltf::Value* meshopt = find(from.extensions, "EXT_meshopt_compression"))
    view.meshopt = compressed_view(*meshopt);
  return view;
}

Accessor convert_accessor(const tinygltf::Accessor& from) {
  Accessor accessor;
  accessor.view = from.bufferView;
  accessor.offset = from.byteOffset;
  accessor.component = ComponentType(from.componentType);
  accessor.normalized = from.normalized;
  accessor.count = from.count;
  accessor.components = tinygltf::GetNumComponentsInType(std::uint32_t(from.type));
  accessor.matrix = from.type == TINYGLTF_TYPE_MAT2 || from.type == TINYGLTF_TYPE_MAT3 ||
                    from.type == TINYGLTF_TYPE_MAT4;
  accessor.min = from.minValues;
  accessor.max = from.maxValues;
  if (from.sparse.isSparse)
    accessor.sparse = Sparse{.count = std::uint64_t(from.sparse.count),
                             .index_view = from.sparse.indices.bufferView,
                             .index_offset = std::uint64_t(from.sparse.indices.byteOffset),
                             .index_type = ComponentType(from.sparse.indices.componentType),
                             .value_view = from.sparse.values.bufferView,
                             .value_offset = std::uint64_t(from.sparse.values.byteOffset)};
  return accessor;
}

Mesh convert_mesh(const tinygltf::Mesh& from) {
  Mesh mesh{.name = from.name, .primitives = {}, .weights = from.weights};
  for (const tinygltf::Primitive& p : from.primitives) {
    Primitive primitive;
    primitive.attributes = p.attributes;
    primitive.indices = p.indices;
    primitive.material = p.material;
    primitive.mode = p.mode < 0 ? 4 : p.mode;
    primitive.targets = p.targets;
    if (const tinygltf::Value* draco = find(p.extensions, "KHR_draco_mesh_compression"))
      primitive.draco =
          Draco{int(size_value(*draco, "bufferView")), map_value(*draco, "attributes")};
    mesh.primitives.push_back(std::move(primitive));
  }
  return mesh;
}

dmat4 compose(const dvec3& translation, const dquat& rotation, const dvec3& scale) {
  dmat4 matrix{glm::mat3_cast(rotation)};
  for (int i = 0; i < 3; ++i) matrix[i] *= scale[i];
  matrix[3] = dvec4(translation, 1);
  return matrix;
}

dmat4 local_matrix(const tinygltf::Node& from, const std::string& place, const std::string& name,
                   std::set<std::string>& notes) {
  if (!from.matrix.empty()) {
    dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = from.matrix[std::size_t(i)];
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
      throw InputError(name, place + ".matrix: its last row must be 0 0 0 1");
    return matrix;
  }
  dvec3 translation{0.0}, scale{1.0};
  dquat rotation{1.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    if (!from.translation.empty()) translation[i] = from.translation[std::size_t(i)];
    if (!from.scale.empty()) scale[i] = from.scale[std::size_t(i)];
  }
  if (!from.rotation.empty()) {
    const std::vector<double>& r = from.rotation;
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 1e-12) || !std::isfinite(length))
      throw InputError(name, place + ".rotation has length " + std::to_string(length) +
                                 ", must be a unit quaternion");
    if (std::abs(length - 1) > 1e-3) notes.insert("rotations that were not unit: normalised");
    rotation = dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length);
  }
  return compose(translation, rotation, scale);
}

Node convert_node(const tinygltf::Node& from, const std::string& place, const std::string& name,
                  std::set<std::string>& notes) {
  Node node;
  node.name = from.name;
  node.children = from.children;
  node.parent_from_node = local_matrix(from, place, name, notes);
  node.mesh = from.mesh;
  node.camera = from.camera;
  node.skin = from.skin;
  node.weights = from.weights;
  if (const tinygltf::Value* light = find(from.extensions, "KHR_lights_punctual"))
    node.light = int(size_value(*light, "light"));
  if (const tinygltf::Value* instancing = find(from.extensions, "EXT_mesh_gpu_instancing"))
    node.instances = map_value(*instancing, "attributes");
  return node;
}

Animation convert_animation(const tinygltf::Animation& from, const std::string& place,
                            const std::string& name) {
  Animation animation;
  for (const tinygltf::AnimationSampler& s : from.samplers)
    animation.samplers.push_back({s.input, s.output, s.interpolation == "CUBICSPLINE"});
  for (const tinygltf::AnimationChannel& c : from.channels) {
    if (c.sampler < 0 || std::size_t(c.sampler) >= animation.samplers.size())
      throw InputError(name, place + ".channels[" + std::to_string(animation.channels.size()) +
                                 "].sampler is " + std::to_string(c.sampler) + ", but there are " +
                                 std::to_string(animation.samplers.size()) + " samplers");
    animation.channels.push_back({c.sampler, c.target_node, c.target_path});
  }
  return animation;
}

Texture convert_texture(const tinygltf::Texture& from, const std::vector<Image>& images) {
  const auto is_other = [&](int image) {
    const std::string& type = images[std::size_t(image)].mime_type;
    const std::string& uri = images[std::size_t(image)].uri;
    return type == "image/webp" || type == "image/ktx2" || uri.ends_with(".webp") ||
           uri.ends_with(".ktx2");
  };
  Texture texture{.sampler = from.sampler, .image = from.source};
  if (texture.image >= 0 && is_other(texture.image)) texture.image = -1;
  return texture;
}

Sampler convert_sampler(const tinygltf::Sampler& from) {
  const auto wrap = [](int value) {
    if (value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    return value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
  };
  Sampler sampler;
  sampler.wrap_u = wrap(from.wrapS);
  sampler.wrap_v = wrap(from.wrapT);
  if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampler.mag = Filter::nearest;
  const int f = from.minFilter;
  if (f == TINYGLTF_TEXTURE_FILTER_NEAREST || f == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
      f == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR)
    sampler.min = Filter::nearest;
  if (f == TINYGLTF_TEXTURE_FILTER_NEAREST || f == TINYGLTF_TEXTURE_FILTER_LINEAR)
    sampler.mip = std::nullopt;
  if (f == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
      f == TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST)
    sampler.mip = Filter::nearest;
  return sampler;
}

Camera convert_camera(const tinygltf::Camera& from, const std::string& place,
                      const std::string& name) {
  Camera camera;
  camera.name = from.name;
  camera.orthographic = from.type == "orthographic";
  if (camera.orthographic) {
    camera.x_magnification = std::abs(from.orthographic.xmag);
    camera.y_magnification = std::abs(from.orthographic.ymag);
    camera.near = from.orthographic.znear;
    camera.far = from.orthographic.zfar;
    if (camera.x_magnification == 0 || camera.y_magnification == 0)
      throw InputError(name, place + ".orthographic: xmag and ymag must not be 0");
  } else {
    const tinygltf::PerspectiveCamera& p = from.perspective;
    camera.vertical_fov = p.yfov;
    camera.near = p.znear;
    if (p.zfar > 0) camera.far = p.zfar;
    if (p.aspectRatio > 0) camera.aspect = p.aspectRatio;
    if (!(p.yfov > 0)) throw InputError(name, place + ".perspective is missing");
  }
  if (camera.far && !(*camera.far > camera.near))
    throw InputError(name, place + ": zfar is " + std::to_string(*camera.far) +
                               ", must be > znear, which is " + std::to_string(camera.near));
  return camera;
}

std::optional<Light> convert_light(const tinygltf::Light& from, const std::string& place,
                                   const std::string& name) {
  Light light;
  light.name = from.name;
  if (from.type == "directional")
    light.kind = LightKind::directional;
  else if (from.type == "point")
    light.kind = LightKind::point;
  else if (from.type == "spot")
    light.kind = LightKind::spot;
  else
    return std::nullopt;
  for (int i = 0; i < 3 && from.color.size() == 3; ++i)
    light.color[i] = float(from.color[std::size_t(i)]);
  light.intensity = float(from.intensity);
  if (from.range > 0) light.range = float(from.range);
  light.inner_cone_angle = float(from.spot.innerConeAngle);
  light.outer_cone_angle = float(from.spot.outerConeAngle);
  if (light.kind == LightKind::spot && !(light.inner_cone_angle < light.outer_cone_angle))
    throw InputError(name, place + ".spot.innerConeAngle is " +
                               std::to_string(light.inner_cone_angle) +
                               ", must be less than outerConeAngle, which is " +
                               std::to_string(light.outer_cone_angle));
  return light;
}

/// Lights of a kind that is not known are left out, and taken from their nodes.
void convert_lights(const tinygltf::Model& model, const std::string& name, Document& document) {
  std::vector<int> renumbered;
  for (std::size_t i = 0; i < model.lights.size(); ++i) {
    const std::string place = "extensions.KHR_lights_punctual.lights[" + std::to_string(i) + "]";
    const std::optional<Light> light = convert_light(model.lights[i], place, name);
    renumbered.push_back(light ? int(document.lights.size()) : -1);
    if (light)
      document.lights.push_back(*light);
    else
      document.notes.push_back(place + ": type is not directional, point or spot: left out");
  }
  for (Node& node : document.nodes)
    if (node.light >= 0)
      node.light =
          std::size_t(node.light) < renumbered.size() ? renumbered[std::size_t(node.light)] : -1;
}

std::string at(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void convert_accessors(const tinygltf::Model& model, int placeholder_view, Document& document) {
  for (const tinygltf::BufferView& view : model.bufferViews)
    document.views.push_back(convert_view(view));
  document.views.resize(std::size_t(placeholder_view));
  for (const tinygltf::Accessor& accessor : model.accessors) {
    document.accessors.push_back(convert_accessor(accessor));
    if (accessor.bufferView == placeholder_view) document.accessors.back().view = -1;
  }
}

void convert_geometry(const tinygltf::Model& model, const std::string& name, Document& document) {
  for (const tinygltf::Mesh& mesh : model.meshes) document.meshes.push_back(convert_mesh(mesh));
  std::set<std::string> notes;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    document.nodes.push_back(convert_node(model.nodes[i], at("nodes", i), name, notes));
  document.notes.insert(document.notes.end(), notes.begin(), notes.end());
  for (const tinygltf::Skin& skin : model.skins)
    document.skins.push_back({skin.inverseBindMatrices, skin.skeleton, skin.joints});
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    document.animations.push_back(
        convert_animation(model.animations[i], at("animations", i), name));
  for (const tinygltf::Scene& scene : model.scenes) document.scenes.push_back(scene.nodes);
  document.scene = model.defaultScene;
}

void convert_appearance(const tinygltf::Model& model, const std::string& name, Document& document) {
  for (const tinygltf::Material& material : model.materials)
    document.materials.push_back(convert_material(material));
  for (const tinygltf::Texture& texture : model.textures)
    document.textures.push_back(convert_texture(texture, document.images));
  for (const tinygltf::Sampler& sampler : model.samplers)
    document.samplers.push_back(convert_sampler(sampler));
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    document.cameras.push_back(convert_camera(model.cameras[i], at("cameras", i), name));
  convert_lights(model, name, document);
}

/// The parser is given a file system on which nothing can be found.
tinygltf::Model parse(const std::string& json, const std::string& name) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks(
      {[](const std::string&, void*) { return false; },
       [](const std::string& path, void*) { return path; },
       [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; },
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
         return false;
       },
       nullptr});
  parser.RemoveImageLoader();
  tinygltf::Model model;
  std::string errors, warnings;
  if (json.size() > std::numeric_limits<unsigned int>::max())
    throw InputError(name, "JSON has more than 4 GiB");
  if (!parser.LoadASCIIFromString(&model, &errors, &warnings, json.data(),
                                  static_cast<unsigned int>(json.size()), ""))
    throw InputError(name, "JSON: " + errors.substr(0, errors.find('\n')));
  return model;
}

}  // namespace

int component_size(ComponentType type) {
  if (type == ComponentType::int8 || type == ComponentType::uint8) return 1;
  return type == ComponentType::int16 || type == ComponentType::uint16 ? 2 : 4;
}

Document parse_document(std::string_view json, const std::string& name) {
  check_json_text(json, name);
  CheckedJson checked = check_schema(json, name);
  const tinygltf::Model model = parse(checked.json, name);
  Document document;
  document.buffers = std::move(checked.buffers);
  document.images = std::move(checked.images);
  document.notes = std::move(checked.notes);
  convert_accessors(model, checked.placeholder_view, document);
  convert_geometry(model, name, document);
  convert_appearance(model, name, document);
  return document;
}

}  // namespace parity::gltf
