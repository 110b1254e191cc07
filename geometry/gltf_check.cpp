#include <algorithm>
#include <cmath>

#include "geometry/gltf_convert.h"
#include "geometry/gltf_primitive.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

std::string at(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

const Accessor& accessor(const Document& document, int index) {
  return document.accessors[std::size_t(index)];
}

void check_meshes(const Document& document, const std::string& name) {
  for (std::size_t m = 0; m < document.meshes.size(); ++m) {
    const Mesh& mesh = document.meshes[m];
    const std::size_t targets = mesh.primitives[0].targets.size();
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::string place = at("meshes", m) + "." + at("primitives", p);
      check_primitive(document, mesh.primitives[p], name, place);
      if (mesh.primitives[p].targets.size() != targets)
        throw InputError(name, place + " has " + std::to_string(mesh.primitives[p].targets.size()) +
                                   " morph targets, the first primitive has " +
                                   std::to_string(targets));
    }
    if (!mesh.weights.empty() && mesh.weights.size() != targets)
      throw InputError(name, at("meshes", m) + ".weights has " +
                                 std::to_string(mesh.weights.size()) + " items, must have " +
                                 std::to_string(targets) + ", one a morph target");
  }
}

/// 0 stands for an infinite index; between 0 and 1 there is none.
void check_materials(const Document& document, const std::string& name) {
  for (std::size_t m = 0; m < document.materials.size(); ++m)
    if (const float ior = document.materials[m].ior; ior > 0 && ior < 1)
      throw InputError(name, at("materials", m) + ".extensions.KHR_materials_ior.ior is " +
                                 std::to_string(ior) + ", must be 0 or at least 1");
}

void check_skins(const Document& document, const std::string& name) {
  for (std::size_t s = 0; s < document.skins.size(); ++s) {
    const Skin& skin = document.skins[s];
    if (skin.inverse_bind_matrices < 0) continue;
    const Accessor& a = accessor(document, skin.inverse_bind_matrices);
    const std::string place = at("skins", s) + ".inverseBindMatrices";
    if (!a.matrix || a.components != 16 || a.component != ComponentType::float32)
      throw InputError(name, place + " is accessors[" + std::to_string(skin.inverse_bind_matrices) +
                                 "], must be MAT4 of floats");
    if (a.count < skin.joints.size())
      throw InputError(name, place + " has " + std::to_string(a.count) + " matrices for " +
                                 std::to_string(skin.joints.size()) + " joints");
  }
}

void check_instances(const Document& document, const std::string& name) {
  for (std::size_t n = 0; n < document.nodes.size(); ++n) {
    const Node& node = document.nodes[n];
    const std::string place = at("nodes", n);
    if (node.skin >= 0 && node.mesh < 0)
      throw InputError(
          name, place + ".skin is " + std::to_string(node.skin) + ", but the node has no mesh");
    if (!node.weights.empty() &&
        (node.mesh < 0 || document.meshes[std::size_t(node.mesh)].primitives[0].targets.size() !=
                              node.weights.size()))
      throw InputError(name, place + ".weights has " + std::to_string(node.weights.size()) +
                                 " items, must have one a morph target of its mesh");
    for (const auto& [semantic, index] : node.instances) {
      const int components = semantic == "ROTATION"                             ? 4
                             : semantic == "TRANSLATION" || semantic == "SCALE" ? 3
                                                                                : 0;
      const Accessor& a = accessor(document, index);
      const std::string what = place + ".extensions.EXT_mesh_gpu_instancing.attributes." + semantic;
      if (components > 0 && (a.matrix || a.components != components))
        throw InputError(name, what + " must be VEC" + std::to_string(components));
      if (a.count != accessor(document, node.instances.begin()->second).count)
        throw InputError(name, what + " has another count than the attributes beside it");
    }
  }
}

/// What the output of a channel must be: components of an element; 0: not checked.
int output_components(const std::string& path) {
  if (path == "translation" || path == "scale") return 3;
  if (path == "rotation") return 4;
  return path == "weights" ? 1 : 0;
}

void check_channel(const Document& document, const Animation& animation, const Channel& channel,
                   const std::string& name, const std::string& place) {
  const int components = output_components(channel.path);
  if (components == 0 || channel.node < 0) return;
  const AnimationSampler& sampler = animation.samplers[std::size_t(channel.sampler)];
  const Accessor& output = accessor(document, sampler.output);
  if (output.matrix || output.components != components)
    throw InputError(name, place + ": the sampler's output accessors[" +
                               std::to_string(sampler.output) + "] does not fit path " +
                               channel.path);
  std::uint64_t wanted = accessor(document, sampler.input).count * (sampler.cubic ? 3 : 1);
  if (channel.path == "weights") {
    const int mesh = document.nodes[std::size_t(channel.node)].mesh;
    const std::size_t targets =
        mesh < 0 ? 0 : document.meshes[std::size_t(mesh)].primitives[0].targets.size();
    if (targets == 0) throw InputError(name, place + ": weights of a node without morph targets");
    wanted *= targets;
  }
  if (output.count != wanted)
    throw InputError(name, place + ": the sampler's output accessors[" +
                               std::to_string(sampler.output) + "] has " +
                               std::to_string(output.count) + " elements, must have " +
                               std::to_string(wanted));
}

void check_times(const Document& document, const Data& data, int input, const std::string& name,
                 const std::string& place) {
  const Accessor& a = accessor(document, input);
  const std::string what = place + ".input is accessors[" + std::to_string(input) + "], ";
  if (a.matrix || a.components != 1 || a.component != ComponentType::float32)
    throw InputError(name, what + "must be SCALAR of floats");
  if (a.view < 0) return;
  const std::vector<glm::vec1> times = data.read<glm::vec1>(input);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i].x) || times[i].x < 0)
      throw InputError(name, what + "time " + std::to_string(i) + " is " +
                                 std::to_string(times[i].x) + ", must be >= 0");
    if (i > 0 && !(times[i].x > times[i - 1].x))
      throw InputError(name, what + "times must increase, but " + std::to_string(times[i].x) +
                                 " follows " + std::to_string(times[i - 1].x));
  }
}

}  // namespace

void check_document(const Document& document, const std::string& name) {
  check_materials(document, name);
  check_meshes(document, name);
  check_skins(document, name);
  check_instances(document, name);
}

void check_animations(const Document& document, const Data& data, const std::string& name) {
  std::vector<bool> is_checked(document.accessors.size());
  for (std::size_t i = 0; i < document.animations.size(); ++i) {
    const Animation& animation = document.animations[i];
    const std::string place = at("animations", i);
    for (std::size_t s = 0; s < animation.samplers.size(); ++s) {
      const int input = animation.samplers[s].input;
      if (is_checked[std::size_t(input)]) continue;
      check_times(document, data, input, name, place + "." + at("samplers", s));
      is_checked[std::size_t(input)] = true;
    }
    for (std::size_t c = 0; c < animation.channels.size(); ++c)
      check_channel(document, animation, animation.channels[c], name,
                    place + "." + at("channels", c));
  }
}

}  // namespace parity::gltf
