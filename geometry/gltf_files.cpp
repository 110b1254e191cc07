#include "geometry/gltf_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <system_error>

#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

namespace fs = std::filesystem;

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

std::string system_message(int code) { return std::generic_category().message(code); }

/// Reads the first `most` bytes of a regular file. The open does not block, so that pipes and
/// devices are seen for what they are before anything is read from them.
Bytes read_start(const fs::path& file, std::uint64_t most, const std::string& name,
                 const std::string& place, bool refuse_longer) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (descriptor.value() < 0) throw InputError(name, place + system_message(errno));
  struct stat status {};
  if (::fstat(descriptor.value(), &status) != 0)
    throw InputError(name, place + system_message(errno));
  if (!S_ISREG(status.st_mode)) throw InputError(name, place + "must be a regular file");
  const std::uint64_t size = std::uint64_t(status.st_size);
  if (refuse_longer && size > most)
    throw InputError(name, place + "has " + std::to_string(size) + " bytes, at most " +
                               std::to_string(most) + " are read");
  Bytes bytes(std::size_t(std::min(size, most)));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(descriptor.value(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(name, place + system_message(errno));
    if (got == 0) break;
    filled += std::size_t(got);
  }
  bytes.resize(filled);
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = char(std::tolower(static_cast<unsigned char>(c)));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// %20 to a space; a stray % stands for itself.
std::string percent_decode(std::string_view uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                        hex_digit(uri[i + 2]) >= 0;
    decoded += escape ? char(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return decoded;
}

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  if (!std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
  for (char c : uri.substr(0, colon))
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.')
      return false;
  return true;
}

/// The start of a URI, printable, for messages.
std::string shown(std::string_view uri) {
  std::string text{uri.substr(0, 80)};
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return "\"" + text + (uri.size() > 80 ? "...\"" : "\"");
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  auto part = file.begin();
  for (const fs::path& step : folder) {
    if (step.empty()) continue;
    if (part == file.end() || *part != step) return false;
    ++part;
  }
  return part != file.end();
}

[[noreturn]] void refuse(const std::string& uri, const Origin& origin, const std::string& place,
                         const std::string& what) {
  throw InputError(origin.name, place + " is " + shown(uri) + ", " + what);
}

/// The path that a URI spells, which stays in the folder if there are no links.
std::string relative_path(const std::string& uri, const Origin& origin, const std::string& place) {
  if (uri.empty()) refuse(uri, origin, place, "must not be empty");
  const std::string decoded = percent_decode(uri);
  if (has_scheme(uri) || decoded.find('\0') != std::string::npos || decoded.front() == '/' ||
      decoded.front() == '\\')
    refuse(uri, origin, place, "must be a relative path or a data URI");
  if (!is_inside((fs::path("/root") / decoded).lexically_normal(), "/root"))
    refuse(uri, origin, place, "which leaves the asset's folder");
  return decoded;
}

/// Follows links and dots first, and only then asks whether the file lies in the folder.
fs::path resolve(const std::string& uri, const Origin& origin, const std::string& place) {
  const std::string decoded = relative_path(uri, origin, place);
  if (!origin.folder) refuse(uri, origin, place, "but no file may be opened here");
  std::error_code error;
  const fs::path folder = fs::canonical(origin.folder->empty() ? "." : *origin.folder, error);
  if (error) refuse(uri, origin, place, "the asset's folder cannot be read: " + error.message());
  const fs::path file = fs::canonical(folder / decoded, error);
  if (error) refuse(uri, origin, place, error.message());
  if (!is_inside(file, folder)) refuse(uri, origin, place, "which leaves the asset's folder");
  return file;
}

constexpr std::array<signed char, 256> make_base64_values() {
  std::array<signed char, 256> values{};
  for (signed char& value : values) value = -1;
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<signed char>(i);
  return values;
}

std::optional<Bytes> decode_base64(std::string_view text) {
  constexpr std::array<signed char, 256> values = make_base64_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = (bits << 6) | std::uint32_t(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(std::byte((bits >> held) & 255));
  }
  return bytes;
}

/// Source: RFC 2397.
Bytes read_data_uri(const std::string& uri, const Origin& origin, const std::string& place) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) refuse(uri, origin, place, "must hold data after a comma");
  const std::string_view text = std::string_view(uri).substr(comma + 1);
  if (!std::string_view(uri).substr(0, comma).ends_with(";base64")) {
    const std::string decoded = percent_decode(text);
    const auto bytes = std::as_bytes(std::span(decoded));
    return Bytes(bytes.begin(), bytes.end());
  }
  const std::optional<Bytes> bytes =
      text.find('%') == text.npos ? decode_base64(text) : decode_base64(percent_decode(text));
  if (!bytes) refuse(uri, origin, place, "which is not base64");
  return *bytes;
}

}  // namespace

Bytes read_file(const fs::path& file, std::uint64_t most) {
  return read_start(file, most, file.string(), "", true);
}

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

void check_uri(const std::string& uri, const Origin& origin, const std::string& place) {
  if (is_data_uri(uri))
    read_data_uri(uri, origin, place);
  else
    relative_path(uri, origin, place);
}

Bytes read_uri(const std::string& uri, const Origin& origin, const std::string& place,
               std::uint64_t most) {
  if (is_data_uri(uri)) return read_data_uri(uri, origin, place);
  const fs::path file = resolve(uri, origin, place);
  return read_start(file, most, origin.name, place + " is " + shown(uri) + ": ", false);
}

}  // namespace parity::gltf
