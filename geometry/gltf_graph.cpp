#include "geometry/gltf_convert.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

std::string at(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void find_parents(Document& document, const std::string& name) {
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    for (const int child : document.nodes[i].children) {
      Node& node = document.nodes[std::size_t(child)];
      if (std::size_t(child) == i) throw InputError(name, at("nodes", i) + " is its own child");
      if (node.parent >= 0)
        throw InputError(name, at("nodes", std::size_t(child)) + " has two parents, nodes[" +
                                   std::to_string(node.parent) + "] and " + at("nodes", i));
      node.parent = int(i);
    }
}

/// With one parent at most each, what cannot be reached from a root goes round in a circle.
void refuse_cycles(const Document& document, const std::string& name) {
  std::vector<int> open;
  std::vector<bool> reached(document.nodes.size());
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    if (document.nodes[i].parent < 0) open.push_back(int(i));
  while (!open.empty()) {
    const std::size_t node = std::size_t(open.back());
    open.pop_back();
    reached[node] = true;
    open.insert(open.end(), document.nodes[node].children.begin(),
                document.nodes[node].children.end());
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (!reached[i]) throw InputError(name, at("nodes", i) + " is its own ancestor");
}

void check_scenes(const Document& document, const std::string& name) {
  for (std::size_t i = 0; i < document.scenes.size(); ++i)
    for (const int root : document.scenes[i])
      if (document.nodes[std::size_t(root)].parent >= 0)
        throw InputError(name, at("scenes", i) + ".nodes lists nodes[" + std::to_string(root) +
                                   "], which is a child of nodes[" +
                                   std::to_string(document.nodes[std::size_t(root)].parent) + "]");
}

}  // namespace

void link_nodes(Document& document, const std::string& name) {
  find_parents(document, name);
  refuse_cycles(document, name);
  check_scenes(document, name);
}

}  // namespace parity::gltf
