#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "geometry/gltf_schema.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

using Json = nlohmann::json;

/// A value as it stands in the file, short enough for a message.
std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  std::string text = value.dump(-1, ' ', true);
  return text.size() > 80 ? text.substr(0, 77) + "..." : text;
}

/// A name out of the file without quotes, on one line.
std::string printable(const std::string& name) {
  const std::string quoted = shown(Json(name));
  return quoted.substr(1, quoted.size() - 2);
}

std::string shown(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return std::to_string((long long)value);
  return std::to_string(value);
}

template <typename List, typename Show>
std::string joined(const List& list, Show show) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + show(item);
  return text;
}

class Checker {
 public:
  Checker(const std::string& name, Json& root) : name_(name), root_(root) {}

  std::set<std::string> ignored;  ///< extensions that were met and not read

  void check_root() {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      for (const Field& field : root_shape())
        if (field.name == list && root_.contains(list)) check(root_[list], field, list);
    check_required_extensions();
    check_object(root_, root_shape(), "");
    if (root_.contains("extensionsUsed"))
      for (const Json& extension : root_["extensionsUsed"])
        if (!is_supported_extension(extension.get<std::string>())) ignored.insert(extension);
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw InputError(name_, path + what);
  }

  void check_required_extensions() const {
    if (!root_.contains("extensionsRequired")) return;
    for (const Json& extension : root_["extensionsRequired"])
      if (!is_supported_extension(extension.get<std::string>()))
        fail("extensionsRequired", ": extension " + shown(extension) + " is not supported");
  }

  static std::string join(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  /// Number of items in an array of the root (or of lights, which an extension holds).
  std::size_t size_of(const std::string& target) const {
    if (target != "lights") return root_.contains(target) ? root_[target].size() : 0;
    const Json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    return root_.contains(lights) ? root_[lights].size() : 0;
  }

  void check_object(Json& value, const std::vector<Field>& shape, const std::string& path) {
    if (!value.is_object()) fail(path, " is " + shown(value) + ", must be an object");
    for (const Field& field : shape) {
      const auto found = value.find(field.name);
      if (found != value.end())
        check(*found, field, join(path, field.name));
      else if (field.is_required)
        fail(join(path, field.name), " is missing");
    }
    drop_unknown(value, shape, path);
  }

  void drop_unknown(Json& value, const std::vector<Field>& shape, const std::string& path) {
    const bool extensions = path == "extensions" || path.ends_with(".extensions");
    for (auto item = value.begin(); item != value.end();) {
      const bool known =
          std::ranges::any_of(shape, [&](const Field& field) { return field.name == item.key(); });
      if (!known && extensions && !is_supported_extension(item.key())) ignored.insert(item.key());
      if (!known && item.key() == "extensions" && item->is_object())
        for (const auto& extension : item->items())
          if (!is_supported_extension(extension.key())) ignored.insert(extension.key());
      item = known ? std::next(item) : value.erase(item);
    }
  }

  void check(Json& value, const Field& field, const std::string& path) {
    if (!field.array) return check_item(value, field, path);
    if (!value.is_array()) fail(path, " is " + shown(value) + ", must be an array");
    if (value.size() < field.least || value.size() > field.most)
      fail(path, " has " + std::to_string(value.size()) + " items, must have " +
                     (field.least == field.most ? "" : "at least ") + std::to_string(field.least) +
                     (field.most < 100 && field.least != field.most
                          ? ", at most " + std::to_string(field.most)
                          : ""));
    std::set<Json> seen;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string place = path + "[" + std::to_string(i) + "]";
      check_item(value[i], field, place);
      if (field.is_distinct && !seen.insert(value[i]).second)
        fail(place, " is " + shown(value[i]) + ", which stands there already");
    }
  }

  void check_item(Json& value, const Field& field, const std::string& path) {
    switch (field.kind) {
      case Field::Kind::boolean:
        if (!value.is_boolean()) fail(path, " is " + shown(value) + ", must be true or false");
        return;
      case Field::Kind::integer:
        return check_integer(value, field, path);
      case Field::Kind::number:
        if (!value.is_number()) fail(path, " is " + shown(value) + ", must be a number");
        return check_range(value, field, path);
      case Field::Kind::text:
        return check_text(value, field, path);
      case Field::Kind::object:
        return check_object(value, *field.shape, path);
      case Field::Kind::reference_map:
      case Field::Kind::integer_map:
        if (!value.is_object()) fail(path, " is " + shown(value) + ", must be an object");
        for (auto& item : value.items()) {
          if (std::ranges::any_of(item.key(), [](unsigned char c) { return c < 32; }))
            fail(path, " has the key " + shown(Json(item.key())) + ", must be printable");
          check_integer(item.value(), field, join(path, item.key()));
        }
    }
  }

  void check_integer(Json& value, const Field& field, const std::string& path) {
    if (value.is_number_float()) {  // 3.0 is an integer in JSON
      const double number = value.get<double>();
      if (number == std::floor(number) && std::abs(number) <= 9007199254740992.0)
        value = std::int64_t(number);
    }
    if (!value.is_number_integer()) fail(path, " is " + shown(value) + ", must be an integer");
    check_range(value, field, path);
    if (!field.numbers.empty() &&
        std::ranges::find(field.numbers, value.get<std::int64_t>()) == field.numbers.end())
      fail(path, " is " + shown(value) + ", must be one of " +
                     joined(field.numbers, [](int n) { return std::to_string(n); }));
    if (!field.target.empty() && value.get<std::uint64_t>() >= size_of(field.target))
      fail(path, " is " + shown(value) + ", but there are " +
                     std::to_string(size_of(field.target)) + " " + field.target);
  }

  void check_range(const Json& value, const Field& field, const std::string& path) const {
    const double number = value.get<double>();
    if (number > field.high || number < field.low || (field.low_is_open && number == field.low))
      fail(path, " is " + shown(value) + ", must be " + expected_range(field));
  }

  static std::string expected_range(const Field& field) {
    const double unbounded = std::numeric_limits<float>::max();
    const std::string low = (field.low_is_open ? "> " : ">= ") + shown(field.low);
    const std::string high = "<= " + shown(field.high);
    if (field.low == -unbounded && field.high == unbounded) return "a single-precision number";
    if (field.high == unbounded) return low;
    if (field.low == -unbounded) return high;
    return low + " and " + high;
  }

  void check_text(const Json& value, const Field& field, const std::string& path) const {
    if (!value.is_string()) fail(path, " is " + shown(value) + ", must be a string");
    if (!field.words.empty() &&
        std::ranges::find(field.words, value.get<std::string>()) == field.words.end())
      fail(path, " is " + shown(value) + ", must be one of " +
                     joined(field.words, [](const std::string& word) { return word; }));
  }

  const std::string& name_;
  Json& root_;
};

void check_transforms(const Json& root, const std::string& name) {
  if (!root.contains("nodes")) return;
  for (std::size_t i = 0; i < root["nodes"].size(); ++i)
    for (const char* part : {"translation", "rotation", "scale"})
      if (root["nodes"][i].contains("matrix") && root["nodes"][i].contains(part))
        throw InputError(name, "nodes[" + std::to_string(i) + "] has a matrix and a " + part +
                                   ", must have one or the other");
}

void check_version(const Json& root, const std::string& name) {
  const Json& asset = root["asset"];
  const std::string version = asset["version"];
  if (!version.starts_with("2."))
    throw InputError(name, "asset.version is \"" + version.substr(0, 40) + "\", must be 2.x");
  const std::string least = asset.value("minVersion", "2.0");
  if (least != "2.0")
    throw InputError(name, "asset.minVersion is \"" + least.substr(0, 40) + "\", supported is 2.0");
}

std::vector<Buffer> take_buffers(Json& root) {
  std::vector<Buffer> buffers;
  if (!root.contains("buffers")) return buffers;
  for (Json& item : root["buffers"]) {
    Buffer buffer;
    buffer.has_uri = item.contains("uri");
    if (buffer.has_uri) buffer.uri = std::move(item["uri"].get_ref<std::string&>());
    buffer.length = item["byteLength"].get<std::uint64_t>();
    const Json::json_pointer fallback("/extensions/EXT_meshopt_compression/fallback");
    buffer.fallback = item.contains(fallback) && item[fallback].get<bool>();
    buffers.push_back(std::move(buffer));
  }
  root.erase("buffers");
  return buffers;
}

std::vector<Image> take_images(Json& root, const std::string& name) {
  std::vector<Image> images;
  if (!root.contains("images")) return images;
  for (Json& item : root["images"]) {
    Image image;
    image.has_uri = item.contains("uri");
    if (image.has_uri == item.contains("bufferView"))
      throw InputError(name, "images[" + std::to_string(images.size()) +
                                 "] must have either a uri or a bufferView");
    if (image.has_uri) image.uri = std::move(item["uri"].get_ref<std::string&>());
    image.view = item.value("bufferView", -1);
    image.mime_type = item.value("mimeType", "");
    images.push_back(std::move(image));
  }
  root.erase("images");
  return images;
}

/// The parser takes no index accessor without a buffer view, though the specification (zeros) and
/// Draco (elsewhere) allow it.
int add_placeholder_view(Json& root) {
  Json& views = root["bufferViews"];
  if (views.is_null()) views = Json::array();
  const int placeholder = int(views.size());
  views.push_back({{"buffer", 0}, {"byteLength", 1}});
  if (root.contains("accessors"))
    for (Json& accessor : root["accessors"])
      if (!accessor.contains("bufferView")) accessor["bufferView"] = placeholder;
  return placeholder;
}

}  // namespace

CheckedJson check_schema(std::string_view text, const std::string& name) {
  Json root = Json::parse(text);
  Checker checker(name, root);
  checker.check_root();
  check_version(root, name);
  check_transforms(root, name);
  CheckedJson checked;
  for (const std::string& extension : checker.ignored)
    checked.notes.push_back("extension " + printable(extension) + " is not supported: ignored");
  checked.buffers = take_buffers(root);
  checked.images = take_images(root, name);
  checked.placeholder_view = add_placeholder_view(root);
  checked.json = root.dump();
  return checked;
}

}  // namespace parity::gltf
