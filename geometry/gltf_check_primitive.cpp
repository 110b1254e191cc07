#include <array>

#include "geometry/gltf_primitive.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

std::string shape_of(const Accessor& a) {
  if (a.matrix) return "a matrix";
  return a.components == 1 ? "SCALAR" : "VEC" + std::to_string(a.components);
}

bool is_float(const Accessor& a) { return a.component == ComponentType::float32; }
bool is_wide(const Accessor& a) { return a.component == ComponentType::uint32; }
bool is_signed(const Accessor& a) {
  return a.component == ComponentType::int8 || a.component == ComponentType::int16;
}

/// What is wrong with an accessor in the role of an attribute; empty: nothing.
std::string fault_of(const std::string& semantic, const Accessor& a) {
  const auto has = [&](int components) { return !a.matrix && a.components == components; };
  const bool vector3 = semantic == "POSITION" || semantic == "NORMAL";
  if (vector3 && !has(3)) return "must be VEC3";
  if ((semantic == "TANGENT" || semantic.starts_with("JOINTS_") ||
       semantic.starts_with("WEIGHTS_")) &&
      !has(4))
    return "must be VEC4";
  if (semantic.starts_with("TEXCOORD_") && !has(2)) return "must be VEC2";
  if (semantic.starts_with("COLOR_") && !has(3) && !has(4)) return "must be VEC3 or VEC4";
  if (semantic.starts_with("_")) return "";
  if (is_wide(a)) return "must not be of 32-bit integers";
  if (semantic.starts_with("JOINTS_") && (is_float(a) || is_signed(a) || a.normalized))
    return "must be of unsigned integers";
  if ((semantic == "NORMAL" || semantic == "TANGENT") && !is_float(a) && !is_signed(a))
    return "must be of floats or signed integers";
  if ((semantic.starts_with("COLOR_") || semantic.starts_with("WEIGHTS_")) && is_signed(a))
    return "must be of floats or unsigned integers";
  return "";
}

class PrimitiveChecker {
 public:
  PrimitiveChecker(const Document& document, const Primitive& primitive, const std::string& name,
                   const std::string& place)
      : document_(document), primitive_(primitive), name_(name), place_(place) {}

  void check() const {
    const auto position = primitive_.attributes.find("POSITION");
    if (position == primitive_.attributes.end()) return;
    const std::uint64_t count = accessor(position->second).count;
    for (const auto& [semantic, index] : primitive_.attributes)
      check_attribute(place_ + ".attributes." + semantic, semantic, index, count);
    for (std::size_t t = 0; t < primitive_.targets.size(); ++t)
      for (const auto& [semantic, index] : primitive_.targets[t])
        check_target(place_ + ".targets[" + std::to_string(t) + "]." + semantic, semantic, index,
                     count);
    if (primitive_.indices >= 0) check_indices();
    if (primitive_.draco && primitive_.mode != 4 && primitive_.mode != 5)
      throw InputError(name_, place_ + ".mode is " + std::to_string(primitive_.mode) +
                                  ", must be 4 or 5 with KHR_draco_mesh_compression");
  }

 private:
  const Accessor& accessor(int index) const { return document_.accessors[std::size_t(index)]; }

  [[noreturn]] void fail(const std::string& place, int index, const std::string& what) const {
    throw InputError(name_, place + " is accessors[" + std::to_string(index) + "], " +
                                shape_of(accessor(index)) + " of componentType " +
                                std::to_string(int(accessor(index).component)) + ", " + what);
  }

  void check_attribute(const std::string& place, const std::string& semantic, int index,
                       std::uint64_t count) const {
    const std::string fault = fault_of(semantic, accessor(index));
    if (!fault.empty()) fail(place, index, fault);
    check_count(place, index, count);
  }

  void check_target(const std::string& place, const std::string& semantic, int index,
                    std::uint64_t count) const {
    const bool known = semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT";
    if (known && (accessor(index).matrix || accessor(index).components != 3))
      fail(place, index, "must be VEC3");
    if (known && is_wide(accessor(index))) fail(place, index, "must not be of 32-bit integers");
    check_count(place, index, count);
  }

  void check_count(const std::string& place, int index, std::uint64_t count) const {
    if (accessor(index).count != count)
      throw InputError(name_, place + ": accessors[" + std::to_string(index) + "] has " +
                                  std::to_string(accessor(index).count) +
                                  " elements, POSITION has " + std::to_string(count));
  }

  void check_indices() const {
    const Accessor& a = accessor(primitive_.indices);
    if (a.matrix || a.components != 1 || is_float(a) || is_signed(a) || a.normalized)
      fail(place_ + ".indices", primitive_.indices, "must be SCALAR of unsigned integers");
  }

  const Document& document_;
  const Primitive& primitive_;
  const std::string& name_;
  const std::string& place_;
};

}  // namespace

void check_indices(const Document& document, const Data& data, const Primitive& primitive,
                   const std::string& name, const std::string& place) {
  const auto position = primitive.attributes.find("POSITION");
  if (primitive.indices < 0 || primitive.draco || position == primitive.attributes.end()) return;
  const std::uint64_t count = document.accessors[std::size_t(position->second)].count;
  const std::vector<std::uint32_t> indices = data.read_unsigned(primitive.indices);
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= count)
      throw InputError(name, place + ".indices: element " + std::to_string(i) + " is " +
                                 std::to_string(indices[i]) + ", but there are " +
                                 std::to_string(count) + " vertices");
}

void check_primitive(const Document& document, const Primitive& primitive, const std::string& name,
                     const std::string& place) {
  PrimitiveChecker(document, primitive, name, place).check();
}

}  // namespace parity::gltf
