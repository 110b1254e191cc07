#pragma once

#include <optional>
#include <span>

#include "geometry/gltf_data.h"
#include "geometry/gltf_document.h"

namespace parity::gltf {

/// Checks the graph of nodes and fills Node::parent: no cycle, one parent at most, scenes list
/// roots.
///
/// @throws InputError  naming nodes[i] or scenes[i].
void link_nodes(Document& document, const std::string& name);

/// Checks what is used as what: primitives, skins, animations, instances.
///
/// @throws InputError
void check_document(const Document& document, const std::string& name);

/// Checks the values of skins and animations: times that increase, counts that match.
///
/// @throws InputError
void check_animations(const Document& document, const Data& data, const std::string& name);

/// The scene that the document shows, in its first pose.
///
/// @param document  linked and checked.
/// @throws InputError
Scene convert_document(const Document& document, const Data& data, const Origin& origin);

/// Decodes the images that the scene's materials use, and renumbers the materials' textures to
/// those that are kept. Images in other formats are left out with a note.
///
/// @throws InputError  an image is missing or damaged.
void convert_textures(const Document& document, const Data& data, const Origin& origin,
                      Scene& scene);

}  // namespace parity::gltf
