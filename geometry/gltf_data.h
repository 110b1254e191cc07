#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/gltf_document.h"
#include "geometry/gltf_files.h"

namespace parity::gltf {

/// Bytes from one packed element of an accessor to the next; columns of a matrix begin at multiples
/// of 4.
int element_size(const Accessor& accessor);

/// The buffers of an asset, and typed reading from them. Everything that it hands out was checked
/// against the bytes that are really there.
class Data {
 public:
  /// Loads the buffers, decodes what is compressed, and checks all views and accessors.
  ///
  /// @param binary  the BIN chunk; must outlive this object.
  /// @throws InputError  naming buffers[i], bufferViews[i] or accessors[i].
  Data(const Document& document, std::optional<std::span<const std::byte>> binary,
       const Origin& origin);

  /// Bytes of the file and of all buffers.
  std::uint64_t input_size() const { return input_size_; }

  /// @throws InputError  its buffer has no bytes: no uri, and no BIN chunk.
  std::span<const std::byte> view(int view) const;

  /// Elements of an accessor as floats, normalised integers divided as the specification says,
  /// others converted. Row-major: element after element.
  ///
  /// @param which  sorted indices of the wanted elements; empty: all.
  /// @param force_normalized  integers are fractions whatever the accessor says.
  /// @return  count x components values; a matrix is column after column.
  template <typename Vector>
  std::vector<Vector> read(int accessor, std::span<const std::uint32_t> which = {},
                           bool force_normalized = false) const;

  /// Unsigned elements: vertex indices, joints.
  std::vector<std::uint32_t> read_unsigned(int accessor,
                                           std::span<const std::uint32_t> which = {}) const;

 private:
  void load_buffers(std::optional<std::span<const std::byte>> binary, const Origin& origin);
  void make_view(std::size_t index);
  void check_accessor(std::size_t index);
  void check_sparse(std::size_t index);
  void check_fits(int view, std::uint64_t offset, std::uint64_t stride, std::uint64_t count,
                  std::uint64_t size, const std::string& place) const;
  std::span<const std::byte> cut(int buffer, std::uint64_t offset, std::uint64_t length,
                                 const std::string& place) const;
  std::uint64_t stride_of(const Accessor& accessor) const;
  template <typename Component, typename Out>
  void gather(const Accessor& accessor, std::span<const std::uint32_t> which, Out* out) const;
  template <typename Out>
  void gather_any(const Accessor& accessor, std::span<const std::uint32_t> which, Out* out) const;
  std::vector<std::uint32_t> sparse_places(const Accessor& accessor) const;
  void read_floats(int accessor, std::span<const std::uint32_t> which, bool force_normalized,
                   float* out) const;

  const Document& document_;
  std::string name_;
  std::vector<Bytes> owned_;  ///< buffers and decoded views
  std::vector<std::span<const std::byte>> buffers_;
  std::vector<std::span<const std::byte>> views_;
  std::uint64_t input_size_ = 0;
  std::uint64_t decoded_size_ = 0;  ///< of compressed views
  std::uint64_t sparse_count_ = 0;
};

template <typename Vector>
std::vector<Vector> Data::read(int accessor, std::span<const std::uint32_t> which,
                               bool force_normalized) const {
  const Accessor& a = document_.accessors[std::size_t(accessor)];
  std::vector<Vector> values(which.empty() ? std::size_t(a.count) : which.size());
  read_floats(accessor, which, force_normalized, reinterpret_cast<float*>(values.data()));
  return values;
}

}  // namespace parity::gltf
