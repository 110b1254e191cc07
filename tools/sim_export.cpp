#include "tools/sim_export.h"

#include <fmt/format.h>

#include <span>

namespace parity::tools {
namespace {

template <typename T>
void append(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

/// The arrays of a VTK file and the bytes behind them.
class Arrays {
 public:
  /// The element that describes an array; its bytes are kept for the end of the file.
  template <typename T>
  std::string add(const char* name, const char* type, int components,
                  const std::vector<T>& values) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(T);
    append(bytes_, std::span(&size, 1));
    append(bytes_, std::span<const T>(values));
    return element;
  }
  std::string add(const char* name, const std::vector<float>& values) {
    return values.empty() ? "" : add(name, "Float32", 1, values);
  }
  std::string add(const char* name, const std::vector<vec3>& values) {
    return values.empty() ? "" : add(name, "Float32", 3, values);
  }
  /// The whole file of a data set.
  std::string file(const char* type, double time, const std::string& contents) const {
    return fmt::format(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
               "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n{}"
               "<AppendedData encoding=\"raw\">\n_",
               type, in_data_set(type, time, contents)) +
           bytes_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  static std::string in_data_set(const char* type, double time, const std::string& contents) {
    const std::size_t end = contents.find('\n') + 1;  // the first line opens the data set
    return contents.substr(0, end) +
           fmt::format(
               "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" "
               "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray></FieldData>\n",
               time) +
           contents.substr(end) + fmt::format("</{}>\n", type);
  }

  std::string bytes_;
};

}  // namespace

std::string encode_particles_ply(const SimContent& content) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment time_s {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float vx\nproperty float vy\nproperty float vz\n{}end_header\n",
      content.time, content.positions.size(),
      content.pressures.empty() ? "" : "property float pressure\n");
  for (std::size_t i = 0; i < content.positions.size(); ++i) {
    append(text, std::span(&content.positions[i].x, 3));
    append(text, std::span(&content.velocities[i].x, 3));
    if (!content.pressures.empty()) append(text, std::span(&content.pressures[i], 1));
  }
  return text;
}

std::string encode_vtp(const SimContent& content) {
  Arrays arrays;
  const std::size_t count = content.positions.size();
  std::vector<std::int64_t> connectivity(count), offsets(count);
  for (std::size_t i = 0; i < count; ++i) {
    connectivity[i] = std::int64_t(i);
    offsets[i] = std::int64_t(i) + 1;
  }
  std::string piece = "<PolyData>\n";
  piece += fmt::format(
      "<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
      count);
  piece += "<Points>\n" + arrays.add("Points", "Float32", 3, content.positions) + "</Points>\n";
  piece += "<Verts>\n" + arrays.add("connectivity", "Int64", 1, connectivity) +
           arrays.add("offsets", "Int64", 1, offsets) + "</Verts>\n";
  piece += "<PointData>\n" + arrays.add("velocity", content.velocities) +
           arrays.add("pressure", content.pressures) + "</PointData>\n</Piece>\n";
  return arrays.file("PolyData", content.time, piece);
}

std::string encode_vti(const SimContent& content) {
  Arrays arrays;
  const ivec3 n = content.cells;
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", n.x, n.y, n.z);
  std::string piece = fmt::format(
      "<ImageData WholeExtent=\"{0}\" Origin=\"0 0 0\" Spacing=\"{1} {1} {1}\">\n"
      "<Piece Extent=\"{0}\">\n<CellData>\n",
      extent, content.spacing);
  piece += arrays.add("velocity", content.flow) + arrays.add("pressure", content.pressure) +
           arrays.add("smoke", content.smoke) + arrays.add("temperature", content.temperature) +
           arrays.add("solid", content.solid) + "</CellData>\n</Piece>\n";
  return arrays.file("ImageData", content.time, piece);
}

}  // namespace parity::tools
