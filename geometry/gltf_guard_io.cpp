#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "geometry/gltf_guard.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

constexpr std::size_t deepest_nesting = 512;
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;

std::uint32_t read_uint32(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t(bytes[offset + i]) << (8 * i);
  return value;
}

bool is_glb(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container open_glb(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < 12)
    throw InputError(name, "GLB header is cut off: the file has " + std::to_string(bytes.size()) +
                               " bytes, needs at least 12");
  const std::uint32_t version = read_uint32(bytes, 4);
  const std::uint32_t length = read_uint32(bytes, 8);
  if (version != 2)
    throw InputError(name, "GLB container version is " + std::to_string(version) + ", must be 2");
  if (length > bytes.size() || length < 12)
    throw InputError(name, "GLB header says " + std::to_string(length) + " bytes, the file has " +
                               std::to_string(bytes.size()));
  Container container;
  container.trailing = bytes.size() - length;
  bytes = bytes.first(length);
  std::size_t offset = 12;
  for (int chunk = 0; offset < bytes.size(); ++chunk) {
    const std::string place =
        "GLB chunk " + std::to_string(chunk) + " at byte " + std::to_string(offset);
    if (bytes.size() - offset < 8) throw InputError(name, place + ": its header is cut off");
    const std::uint32_t size = read_uint32(bytes, offset);
    const std::uint32_t type = read_uint32(bytes, offset + 4);
    offset += 8;
    if (size > bytes.size() - offset)
      throw InputError(name, place + ": length is " + std::to_string(size) + ", only " +
                                 std::to_string(bytes.size() - offset) + " bytes are left");
    const std::span<const std::byte> data = bytes.subspan(offset, size);
    if ((chunk == 0) != (type == json_chunk))
      throw InputError(name, place + (chunk == 0 ? ": must be JSON" : ": a second JSON chunk"));
    if (type == json_chunk) container.json = text_of(data);
    if (type == binary_chunk) {
      if (chunk != 1) throw InputError(name, place + ": BIN must be the second chunk");
      container.binary = data;
    }
    offset += size;
  }
  if (container.json.empty()) throw InputError(name, "GLB has no JSON chunk");
  return container;
}

/// Receives the parser's events and keeps only the keys of the objects that are open.
class Inspector : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::string fault;  ///< empty: none

  bool null() override { return scalar(); }
  bool boolean(bool) override { return scalar(); }
  bool number_integer(number_integer_t) override { return scalar(); }
  bool number_unsigned(number_unsigned_t) override { return scalar(); }
  bool number_float(number_float_t, const string_t&) override { return scalar(); }
  bool string(string_t&) override { return scalar(); }
  bool binary(binary_t&) override { return scalar(); }
  bool start_array(std::size_t) override {
    return open_.empty() ? fail("the root is an array, must be an object") : open();
  }
  bool start_object(std::size_t) override { return open(); }
  bool end_array() override { return close(); }
  bool end_object() override { return close(); }
  bool key(string_t& key) override {
    return open_.back().insert(key).second ||
           fail("key \"" + key + "\" stands twice in one object");
  }
  bool parse_error(std::size_t byte, const std::string&,
                   const nlohmann::json::exception& error) override {
    const std::string text = error.what();
    const std::size_t from = text.find("] ");
    return fail("byte " + std::to_string(byte) + ": " +
                (from == std::string::npos ? text : text.substr(from + 2)));
  }

 private:
  bool fail(const std::string& what) {
    fault = what;
    return false;
  }
  bool scalar() { return !open_.empty() || fail("the root is a value, must be an object"); }
  bool open() {
    open_.emplace_back();
    return open_.size() <= deepest_nesting ||
           fail("nested deeper than " + std::to_string(deepest_nesting));
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> open_;
};

/// One line, printable, of bearable length.
std::string tidy(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  if (text.size() > 300) text = text.substr(0, 300) + "...";
  return text;
}

}  // namespace

Container open_container(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) throw InputError(name, "the file is empty");
  if (is_glb(bytes)) return open_glb(bytes, name);
  std::string_view text = text_of(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return {.json = text};
}

void check_json_text(std::string_view text, const std::string& name) {
  Inspector inspector;
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &inspector))
    throw InputError(name, "JSON: " + tidy(inspector.fault));
}

}  // namespace parity::gltf
