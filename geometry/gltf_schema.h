#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/gltf_document.h"

namespace parity::gltf {

/// A glTF file's JSON after the check against the schema.
struct CheckedJson {
  std::string json;  ///< only the properties that Parity reads, without `buffers` and `images`
  int placeholder_view = -1;  ///< a last buffer view, added for accessors that name none
  std::vector<Buffer> buffers;
  std::vector<Image> images;
  std::vector<std::string> notes;
};

/// Checks types, ranges, required properties and references of everything that Parity reads, and
/// drops the rest (extras, unknown properties, extensions that are optional and not supported).
///
/// @param text  has passed check_json_text.
/// @throws InputError  naming the JSON path, e.g. `accessors[3].bufferView`; or the required
///                     extension that is not supported.
///
/// Source: the JSON schema of glTF 2.0 and of its extensions.
CheckedJson check_schema(std::string_view text, const std::string& name);

/// What a property of the schema may hold.
struct Field {
  enum class Kind { boolean, integer, number, text, object, reference_map, integer_map };

  std::string name;
  Kind kind = Kind::object;
  bool array = false;
  bool is_required = false;
  bool is_distinct = false;  ///< array items must differ
  std::size_t least = 0;     ///< array items
  std::size_t most = std::numeric_limits<std::size_t>::max();
  double low = -std::numeric_limits<float>::max();
  double high = std::numeric_limits<float>::max();
  bool low_is_open = false;
  std::string target;                         ///< array of the root that an integer counts in
  std::vector<int> numbers;                   ///< if any, the only values
  std::vector<std::string> words;             ///< if any, the only values
  const std::vector<Field>* shape = nullptr;  ///< of objects

  Field required() const;
  Field list(std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  Field distinct() const;
  Field at_least(double value) const;
  Field at_most(double value) const;
  Field above(double value) const;
};

/// Properties of the root object.
const std::vector<Field>& root_shape();

/// Extensions that a file may require.
bool is_supported_extension(std::string_view name);

}  // namespace parity::gltf
