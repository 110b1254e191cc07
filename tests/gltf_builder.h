#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace parity {

/// Puts small glTF files together for tests: a JSON object and one binary buffer.
class GltfBuilder {
 public:
  nlohmann::json root = {{"asset", {{"version", "2.0"}}}};

  /// A buffer view of these values. Returns its number.
  template <typename T>
  int view(const std::vector<T>& values) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    const std::size_t offset = binary_.size(), size = values.size() * sizeof(T);
    binary_.resize(offset + size);
    std::memcpy(binary_.data() + offset, values.data(), size);
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    return int(root["bufferViews"].size()) - 1;
  }

  /// An accessor over its own buffer view. Returns its number.
  template <typename T>
  int accessor(const std::vector<T>& values, const std::string& type,
               const nlohmann::json& more = nlohmann::json::object()) {
    const std::size_t components = type == "SCALAR" ? 1
                                   : type == "MAT4" ? 16
                                                    : std::size_t(type.back() - '0');
    nlohmann::json entry = {{"bufferView", view(values)},
                            {"componentType", component_type<T>()},
                            {"count", values.size() / components},
                            {"type", type}};
    entry.update(more);
    root["accessors"].push_back(entry);
    return int(root["accessors"].size()) - 1;
  }

  /// A mesh of one primitive, and a node that places it, as the whole scene.
  void show(const nlohmann::json& primitive) {
    root["meshes"] = {{{"primitives", nlohmann::json::array({primitive})}}};
    root["nodes"] = {{{"mesh", 0}}};
    root["scenes"] = {{{"nodes", {0}}}};
    root["scene"] = 0;
  }

  /// A GLB file.
  std::vector<std::byte> glb() const {
    nlohmann::json json = root;
    if (!binary_.empty()) json["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> binary = binary_;
    binary.resize((binary.size() + 3) / 4 * 4);
    std::vector<std::byte> out;
    const auto word = [&](std::size_t value) {
      for (int i = 0; i < 4; ++i) out.push_back(std::byte((value >> (8 * i)) & 255));
    };
    const auto text_bytes = std::as_bytes(std::span(text));
    out.reserve(28 + text.size() + binary.size());
    word(0x46546C67);
    word(2);
    word(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    word(text.size());
    word(0x4E4F534A);
    out.insert(out.end(), text_bytes.begin(), text_bytes.end());
    if (binary.empty()) return out;
    word(binary.size());
    word(0x004E4942);
    out.insert(out.end(), binary.begin(), binary.end());
    return out;
  }

 private:
  template <typename T>
  static int component_type() {
    if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
    if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
    if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
    if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
    if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
    return 5126;
  }

  std::vector<std::byte> binary_;
};

}  // namespace parity
