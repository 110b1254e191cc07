#include "tools/sim_checkpoint.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "geometry/input_error.h"
#include "tools/sim_bytes.h"

namespace parity::tools {
namespace {

constexpr std::string_view magic = "PARITYSC";
constexpr std::uint32_t version = 1;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t header_bytes = 8 + 4 + 4 + 8 + 8;
constexpr std::size_t max_bytes = std::size_t(1) << 34;

Checkpoint decode_contents(std::string_view bytes) {
  ByteReader reader(bytes);
  Checkpoint c;
  c.physics = reader.text();
  c.backend = reader.text();
  c.steps = reader.value<std::uint64_t>();
  c.frames = reader.value<std::uint32_t>();
  c.seconds = reader.value<double>();
  c.history = reader.text();
  c.state = reader.text();
  if (!reader.is_at_end()) throw std::runtime_error("goes on after its end");
  if (!(c.seconds >= 0 && c.seconds < 1e12)) throw std::runtime_error("has a wrong duration");
  const nlohmann::json history = nlohmann::json::parse(c.history, nullptr, false);
  if (!history.is_array() || history.size() != c.frames)
    throw std::runtime_error("does not hold one entry for each of its " + std::to_string(c.frames) +
                             " frames");
  return c;
}

/// The first key under which two texts of physics differ.
std::string difference(const std::string& stored, const std::string& asked) {
  const nlohmann::json a = nlohmann::json::parse(stored, nullptr, false);
  const nlohmann::json b = nlohmann::json::parse(asked);
  for (const auto& item : b.items())
    if (!a.is_object() || !a.contains(item.key()) || a[item.key()] != item.value())
      return item.key();
  return "a key";
}

}  // namespace

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ std::uint8_t(c)) * 0x100000001b3ULL;
  return hash;
}

std::string encode_checkpoint(const Checkpoint& c) {
  ByteWriter contents;
  contents.text(c.physics);
  contents.text(c.backend);
  contents.value(c.steps);
  contents.value(c.frames);
  contents.value(c.seconds);
  contents.text(c.history);
  contents.text(c.state);
  const std::string bytes = contents.take();
  ByteWriter file;
  for (const char letter : magic) file.value(letter);
  file.value(version);
  file.value(byte_order);
  file.value(std::uint64_t(bytes.size()));
  file.value(checksum(bytes));
  return file.take() + bytes;
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(magic)) throw InputError(name, "is no checkpoint of parity sim");
  if (bytes.size() < header_bytes) throw InputError(name, "is cut short");
  ByteReader reader(bytes.substr(magic.size()));
  if (const auto found = reader.value<std::uint32_t>(); found != version)
    throw InputError(
        name, "has version " + std::to_string(found) + ", must be " + std::to_string(version));
  if (reader.value<std::uint32_t>() != byte_order)
    throw InputError(name, "was written on a machine of another byte order");
  const auto length = reader.value<std::uint64_t>();
  const auto sum = reader.value<std::uint64_t>();
  const std::string_view contents = bytes.substr(header_bytes);
  if (length != contents.size())
    throw InputError(name, "has " + std::to_string(contents.size()) +
                               " bytes of contents, must have " + std::to_string(length));
  if (checksum(contents) != sum) throw InputError(name, "is damaged: its checksum is wrong");
  try {
    return decode_contents(contents);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(name, error.what());
  }
}

void save_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  write_file_atomically(path, encode_checkpoint(checkpoint));
}

Checkpoint load_checkpoint(const std::filesystem::path& path, const std::string& physics,
                           const std::string& backend) {
  const std::vector<std::byte> bytes = read_file(path, max_bytes);
  Checkpoint c =
      decode_checkpoint({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
  if (c.physics != physics)
    throw InputError(path.string(),
                     "was made by another scene: " + difference(c.physics, physics) + " differs");
  if (c.backend != backend)
    throw InputError(path.string(), "was made with another backend than " + backend);
  return c;
}

}  // namespace parity::tools
