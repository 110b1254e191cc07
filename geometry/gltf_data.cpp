#include "geometry/gltf_data.h"

#include <algorithm>
#include <cstring>

#include "geometry/gltf_compression.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

constexpr std::uint64_t largest_buffer = std::uint64_t(1) << 32;
constexpr std::uint64_t largest_input = std::uint64_t(1) << 33;
constexpr std::uint64_t base_decoded = std::uint64_t(128) << 20;
constexpr std::uint64_t decoded_per_byte = 64;
constexpr std::uint64_t base_sparse_count = std::uint64_t(1) << 24;
constexpr std::uint64_t largest_zero_fill = std::uint64_t(16) << 20;

std::string at(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

int rows_of(const Accessor& matrix) {
  return matrix.components == 4 ? 2 : matrix.components == 9 ? 3 : 4;
}

/// Bytes at the end of an element that the last one may lack.
std::uint64_t padding_of(const Accessor& accessor) {
  if (!accessor.matrix) return 0;
  const int column = rows_of(accessor) * component_size(accessor.component);
  return std::uint64_t((column + 3) / 4 * 4 - column);
}

/// The divisor of a normalised integer; 0: not one.
float normalizing_divisor(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
      return 127.0f;
    case ComponentType::uint8:
      return 255.0f;
    case ComponentType::int16:
      return 32767.0f;
    case ComponentType::uint16:
      return 65535.0f;
    default:
      return 0.0f;
  }
}

}  // namespace

int element_size(const Accessor& accessor) {
  const int component = component_size(accessor.component);
  if (!accessor.matrix) return component * accessor.components;
  const int rows = rows_of(accessor);
  return rows * ((rows * component + 3) / 4 * 4);
}

Data::Data(const Document& document, std::optional<std::span<const std::byte>> binary,
           const Origin& origin)
    : document_(document), name_(origin.name) {
  load_buffers(binary, origin);
  views_.resize(document.views.size());
  for (std::size_t i = 0; i < document.views.size(); ++i) make_view(i);
  for (std::size_t i = 0; i < document.accessors.size(); ++i) check_accessor(i);
}

void Data::load_buffers(std::optional<std::span<const std::byte>> binary, const Origin& origin) {
  for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
    const Buffer& buffer = document_.buffers[i];
    const std::string place = at("buffers", i);
    if (buffer.length > largest_buffer)
      throw InputError(name_, place + ".byteLength is " + std::to_string(buffer.length) +
                                  ", at most " + std::to_string(largest_buffer) + " are read");
    buffers_.emplace_back();
    if (buffer.fallback) continue;
    std::uint64_t size = 0;
    if (buffer.has_uri) {
      owned_.push_back(read_uri(buffer.uri, origin, place + ".uri", buffer.length));
      buffers_.back() = owned_.back();
      size = buffers_.back().size();
    } else if (i == 0 && binary) {
      buffers_.back() = *binary;
      size = binary->size();
    } else {
      continue;  // a placeholder for what is compressed, or never read
    }
    if (size < buffer.length)
      throw InputError(name_, place + ".byteLength is " + std::to_string(buffer.length) +
                                  ", but there are only " + std::to_string(size) + " bytes");
    buffers_.back() = buffers_.back().first(std::size_t(buffer.length));
    input_size_ += buffer.length;
    if (input_size_ > largest_input)
      throw InputError(name_, place + ": the buffers together have more than 8 GiB");
  }
}

std::span<const std::byte> Data::cut(int buffer, std::uint64_t offset, std::uint64_t length,
                                     const std::string& place) const {
  const std::span<const std::byte> bytes = buffers_[std::size_t(buffer)];
  const std::uint64_t declared = document_.buffers[std::size_t(buffer)].length;
  if (offset > declared || length > declared - offset)
    throw InputError(name_, place + ": byteOffset " + std::to_string(offset) + " + byteLength " +
                                std::to_string(length) + " is past the end of buffers[" +
                                std::to_string(buffer) + "], which has " +
                                std::to_string(declared) + " bytes");
  return bytes.empty() ? bytes : bytes.subspan(std::size_t(offset), std::size_t(length));
}

std::span<const std::byte> Data::view(int view) const {
  const std::span<const std::byte> bytes = views_[std::size_t(view)];
  if (!bytes.empty()) return bytes;
  const int buffer = document_.views[std::size_t(view)].buffer;
  throw InputError(name_, "buffers[" + std::to_string(buffer) + "] has no uri" +
                              (buffer == 0 ? " and the file has no BIN chunk" : "") +
                              ", but bufferViews[" + std::to_string(view) + "] is read");
}

void Data::make_view(std::size_t index) {
  const View& view = document_.views[index];
  const std::string place = at("bufferViews", index);
  if (!view.meshopt) {
    views_[index] = cut(view.buffer, view.offset, view.length, place);
    return;
  }
  const CompressedView& from = *view.meshopt;
  const std::string extension = place + ".extensions.EXT_meshopt_compression";
  if (from.stride * from.count != view.length)
    throw InputError(name_, extension + ": byteStride " + std::to_string(from.stride) +
                                " x count " + std::to_string(from.count) +
                                " is not the view's byteLength " + std::to_string(view.length));
  const std::span<const std::byte> bytes = cut(from.buffer, from.offset, from.length, extension);
  if (bytes.empty())
    throw InputError(
        name_, extension + ".buffer is " + std::to_string(from.buffer) + ", which has no bytes");
  decoded_size_ += view.length;
  if (decoded_size_ > base_decoded + decoded_per_byte * input_size_)
    throw InputError(name_, extension +
                                ": the compressed views expand to more memory than a file " +
                                "of this size may take");
  owned_.push_back(decode_meshopt(from, bytes, name_, extension));
  views_[index] = owned_.back();
}

std::uint64_t Data::stride_of(const Accessor& accessor) const {
  const std::uint64_t stride = document_.views[std::size_t(accessor.view)].stride;
  return stride == 0 ? std::uint64_t(element_size(accessor)) : stride;
}

// All four are below 2^53 (stride and size below 2^9), so that nothing here wraps.
void Data::check_fits(int view, std::uint64_t offset, std::uint64_t stride, std::uint64_t count,
                      std::uint64_t size, const std::string& place) const {
  const std::uint64_t have = document_.views[std::size_t(view)].length;
  const std::uint64_t most = have < offset + size ? 0 : (have - offset - size) / stride + 1;
  if (count > most)
    throw InputError(name_, place + ": " + std::to_string(count) +
                                " elements do not fit: from byte " + std::to_string(offset) +
                                " of bufferViews[" + std::to_string(view) + "] there are " +
                                std::to_string(most));
}

void Data::check_accessor(std::size_t index) {
  const Accessor& a = document_.accessors[index];
  const std::string place = at("accessors", index);
  const std::uint64_t size = std::uint64_t(element_size(a));
  if (a.count > 0xFFFFFFFFu)
    throw InputError(
        name_, place + ".count is " + std::to_string(a.count) + ", must be at most 4294967295");
  if (a.view < 0 && a.count * size > largest_zero_fill)
    throw InputError(name_, place + ".count is " + std::to_string(a.count) +
                                " without a bufferView: more than 16 MiB of zeros");
  if (a.view >= 0) {
    const std::uint64_t stride = stride_of(a);
    if (stride < size)
      throw InputError(name_, "bufferViews[" + std::to_string(a.view) + "].byteStride is " +
                                  std::to_string(stride) + ", but an element of " + place +
                                  " has " + std::to_string(size) + " bytes");
    check_fits(a.view, a.offset, stride, a.count, size - padding_of(a), place);
  }
  if (a.sparse) check_sparse(index);
}

void Data::check_sparse(std::size_t index) {
  const Accessor& a = document_.accessors[index];
  const Sparse& sparse = *a.sparse;
  const std::string place = at("accessors", index) + ".sparse";
  if (sparse.count > a.count)
    throw InputError(name_, place + ".count is " + std::to_string(sparse.count) +
                                ", the accessor has " + std::to_string(a.count) + " elements");
  const std::uint64_t index_size = std::uint64_t(component_size(sparse.index_type));
  const std::uint64_t size = std::uint64_t(element_size(a));
  check_fits(sparse.index_view, sparse.index_offset, index_size, sparse.count, index_size,
             place + ".indices");
  check_fits(sparse.value_view, sparse.value_offset, size, sparse.count, size - padding_of(a),
             place + ".values");
  sparse_count_ += sparse.count;
  if (sparse_count_ > base_sparse_count + input_size_)
    throw InputError(name_, place + ".count: the file has more sparse elements than bytes");
  const std::vector<std::uint32_t> places = sparse_places(a);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= a.count)
      throw InputError(name_, place + ".indices: index " + std::to_string(places[i]) + " of " +
                                  std::to_string(a.count) + " elements");
    if (i > 0 && places[i] <= places[i - 1])
      throw InputError(name_, place + ".indices must strictly increase, but " +
                                  std::to_string(places[i]) + " follows " +
                                  std::to_string(places[i - 1]));
  }
}

std::vector<std::uint32_t> Data::sparse_places(const Accessor& accessor) const {
  const Sparse& sparse = *accessor.sparse;
  const std::byte* from = view(sparse.index_view).data() + sparse.index_offset;
  std::vector<std::uint32_t> places(std::size_t(sparse.count));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (sparse.index_type == ComponentType::uint8) places[i] = std::uint32_t(from[i]);
    if (sparse.index_type == ComponentType::uint16) places[i] = load<std::uint16_t>(from + 2 * i);
    if (sparse.index_type == ComponentType::uint32) places[i] = load<std::uint32_t>(from + 4 * i);
  }
  return places;
}

template <typename Component, typename Out>
void Data::gather(const Accessor& accessor, std::span<const std::uint32_t> which, Out* out) const {
  const std::size_t components = std::size_t(accessor.components);
  const auto copy = [&](const std::byte* from, Out* to) {
    for (std::size_t c = 0; c < components; ++c)
      to[c] = Out(load<Component>(from + c * sizeof(Component)));
  };
  if (accessor.view >= 0) {
    const std::byte* from = view(accessor.view).data() + accessor.offset;
    const std::size_t stride = std::size_t(stride_of(accessor));
    const std::size_t count = which.empty() ? std::size_t(accessor.count) : which.size();
    for (std::size_t i = 0; i < count; ++i)
      copy(from + (which.empty() ? i : which[i]) * stride, out + i * components);
  }
  if (!accessor.sparse) return;
  const std::byte* from = view(accessor.sparse->value_view).data() + accessor.sparse->value_offset;
  const std::vector<std::uint32_t> places = sparse_places(accessor);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t to = places[i];
    if (!which.empty()) {
      const auto found = std::ranges::lower_bound(which, places[i]);
      if (found == which.end() || *found != places[i]) continue;
      to = std::size_t(found - which.begin());
    }
    copy(from + i * components * sizeof(Component), out + to * components);
  }
}

template <typename Out>
void Data::gather_any(const Accessor& accessor, std::span<const std::uint32_t> which,
                      Out* out) const {
  switch (accessor.component) {
    case ComponentType::int8:
      return gather<std::int8_t>(accessor, which, out);
    case ComponentType::uint8:
      return gather<std::uint8_t>(accessor, which, out);
    case ComponentType::int16:
      return gather<std::int16_t>(accessor, which, out);
    case ComponentType::uint16:
      return gather<std::uint16_t>(accessor, which, out);
    case ComponentType::uint32:
      return gather<std::uint32_t>(accessor, which, out);
    case ComponentType::float32:
      return gather<float>(accessor, which, out);
  }
}

void Data::read_floats(int accessor, std::span<const std::uint32_t> which, bool force_normalized,
                       float* out) const {
  const Accessor& a = document_.accessors[std::size_t(accessor)];
  gather_any(a, which, out);
  const float divisor = normalizing_divisor(a.component);
  if (divisor == 0 || !(a.normalized || force_normalized)) return;
  const std::size_t count =
      (which.empty() ? std::size_t(a.count) : which.size()) * std::size_t(a.components);
  for (std::size_t i = 0; i < count; ++i) out[i] = std::max(out[i] / divisor, -1.0f);
}

std::vector<std::uint32_t> Data::read_unsigned(int accessor,
                                               std::span<const std::uint32_t> which) const {
  const Accessor& a = document_.accessors[std::size_t(accessor)];
  const std::size_t count = which.empty() ? std::size_t(a.count) : which.size();
  std::vector<std::uint32_t> values(count * std::size_t(a.components));
  if (a.component == ComponentType::uint8) gather<std::uint8_t>(a, which, values.data());
  if (a.component == ComponentType::uint16) gather<std::uint16_t>(a, which, values.data());
  if (a.component == ComponentType::uint32) gather<std::uint32_t>(a, which, values.data());
  return values;
}

}  // namespace parity::gltf
