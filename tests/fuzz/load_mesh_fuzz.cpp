#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "geometry/input_error.h"
#include "geometry/mesh_io.h"
#include "geometry/mesh_measure.h"

namespace {

/// The format that the first bytes look like; what no file starts with is tried as OBJ.
const char* likely_name(std::span<const std::byte> bytes) {
  const auto starts_with = [&](std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()), magic.size()) == magic;
  };
  if (starts_with("ply")) return "fuzz.ply";
  if (starts_with("OFF") || starts_with("COFF") || starts_with("STCNOFF")) return "fuzz.off";
  if (starts_with("solid") || starts_with("    ")) return "fuzz.stl";
  return "fuzz.obj";
}

}  // namespace

/// Whatever the bytes, a mesh is refused by InputError or holds what its contract says, so that it
/// can be measured.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  try {
    const parity::Mesh mesh = parity::decode_mesh(bytes, likely_name(bytes));
    if (parity::measure(mesh).vertices != mesh.vertex_count()) std::abort();
  } catch (const parity::InputError&) {
  }
  return 0;
}
