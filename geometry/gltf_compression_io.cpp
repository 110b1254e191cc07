#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include "geometry/gltf_compression.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

/// What the codec at least needs, so that memory is only taken for data that can be there: a block
/// of 256 vertices takes 4 bytes for each byte of the stride; a triangle or index at least one
/// byte.
bool can_hold(const CompressedView& view, std::uint64_t size) {
  if (view.mode == MeshoptMode::attributes) return view.count * view.stride / 64 <= size;
  if (view.mode == MeshoptMode::triangles) return view.count / 3 <= size;
  return view.count <= size;
}

/// What the specification says of stride and count in each mode; empty: nothing is wrong.
std::string fault_of(const CompressedView& view) {
  const bool wide = view.stride == 2 || view.stride == 4;
  if (view.mode == MeshoptMode::attributes && view.stride % 4 != 0)
    return "byteStride must be a multiple of 4";
  if (view.mode != MeshoptMode::attributes && !wide) return "byteStride must be 2 or 4";
  if (view.mode == MeshoptMode::triangles && view.count % 3 != 0)
    return "count must be a multiple of 3";
  if (view.mode != MeshoptMode::attributes && view.filter != MeshoptFilter::none)
    return "a filter needs mode ATTRIBUTES";
  if (view.filter == MeshoptFilter::octahedral && view.stride != 4 && view.stride != 8)
    return "byteStride must be 4 or 8 for OCTAHEDRAL";
  if (view.filter == MeshoptFilter::quaternion && view.stride != 8)
    return "byteStride must be 8 for QUATERNION";
  return "";
}

int run_decoder(const CompressedView& view, std::span<const std::byte> bytes, Bytes& out) {
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t count = std::size_t(view.count), stride = std::size_t(view.stride);
  if (view.mode == MeshoptMode::attributes)
    return meshopt_decodeVertexBuffer(out.data(), count, stride, from, bytes.size());
  if (view.mode == MeshoptMode::triangles)
    return meshopt_decodeIndexBuffer(out.data(), count, stride, from, bytes.size());
  return meshopt_decodeIndexSequence(out.data(), count, stride, from, bytes.size());
}

/// The filters work on blocks; a count that is not a multiple of 4 is padded for them.
void run_filter(const CompressedView& view, Bytes& out) {
  const std::size_t stride = std::size_t(view.stride);
  const std::size_t count = (std::size_t(view.count) + 3) / 4 * 4;
  const std::size_t size = out.size();
  out.resize(count * stride);
  if (view.filter == MeshoptFilter::octahedral) meshopt_decodeFilterOct(out.data(), count, stride);
  if (view.filter == MeshoptFilter::quaternion) meshopt_decodeFilterQuat(out.data(), count, stride);
  if (view.filter == MeshoptFilter::exponential) meshopt_decodeFilterExp(out.data(), count, stride);
  out.resize(size);
}

std::vector<float> draco_floats(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                int components) {
  std::vector<float> values(std::size_t(mesh.num_points()) * std::size_t(components));
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point)
    if (!attribute.ConvertValue<float>(
            attribute.mapped_index(draco::PointIndex(point)), static_cast<std::int8_t>(components),
            values.data() + std::size_t(point) * std::size_t(components)))
      return {};
  return values;
}

}  // namespace

Bytes decode_meshopt(const CompressedView& view, std::span<const std::byte> bytes,
                     const std::string& name, const std::string& place) {
  if (const std::string fault = fault_of(view); !fault.empty())
    throw InputError(name, place + ": byteStride is " + std::to_string(view.stride) + ", count " +
                               std::to_string(view.count) + "; " + fault);
  if (!can_hold(view, bytes.size()))
    throw InputError(name, place + ".count is " + std::to_string(view.count) + ", which " +
                               std::to_string(bytes.size()) + " bytes cannot hold");
  Bytes out(std::size_t(view.count * view.stride));
  if (run_decoder(view, bytes, out) != 0)
    throw InputError(name, place + ": the compressed data is damaged");
  if (view.filter != MeshoptFilter::none) run_filter(view, out);
  return out;
}

DracoMesh decode_draco(const Attributes& attributes, const std::map<std::string, int>& components,
                       std::span<const std::byte> bytes, const std::string& name,
                       const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    throw InputError(name, place + ": not a Draco mesh: " + decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  DracoMesh out;
  out.vertex_count = mesh->num_points();
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh->face(draco::FaceIndex(f))[std::size_t(c)].value();
      if (vertex >= out.vertex_count)
        throw InputError(name, place + ": index " + std::to_string(vertex) + " of " +
                                   std::to_string(out.vertex_count) + " vertices");
      out.indices.push_back(vertex);
    }
  for (const auto& [semantic, id] : attributes) {
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(std::uint32_t(id));
    const auto wanted = components.find(semantic);
    if (wanted == components.end()) continue;
    if (attribute) out.attributes[semantic] = draco_floats(*mesh, *attribute, wanted->second);
    if (!attribute || out.attributes[semantic].empty())
      throw InputError(name, place + ".attributes." + semantic + " is " + std::to_string(id) +
                                 ", which the Draco mesh does not hold");
  }
  return out;
}

}  // namespace parity::gltf
