#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "gpu/core/error.h"
#include "gpu/core/shader.h"

// A reader of the few parts of SPIR-V that the host must know. Source: SPIR-V 1.6, sections 2.3, 3.
namespace parity::gpu {
namespace {

using Word = std::uint32_t;

constexpr Word magic = 0x07230203;
constexpr std::size_t header_words = 5;
constexpr std::uint64_t largest_size = std::uint64_t{1} << 31;

enum Op : Word {
  op_entry_point = 15,
  op_execution_mode = 16,
  op_type_void = 19,
  op_type_int = 21,
  op_type_float = 22,
  op_type_vector = 23,
  op_type_matrix = 24,
  op_type_image = 25,
  op_type_sampled_image = 27,
  op_type_array = 28,
  op_type_struct = 30,
  op_type_pointer = 32,
  op_type_forward_pointer = 39,
  op_constant = 43,
  op_constant_composite = 44,
  op_spec_constant_true = 48,
  op_spec_constant_false = 49,
  op_spec_constant = 50,
  op_spec_constant_composite = 51,
  op_variable = 59,
  op_decorate = 71,
  op_member_decorate = 72,
  op_execution_mode_id = 331,
};

constexpr Word mode_local_size = 17;
constexpr Word mode_local_size_id = 38;
constexpr Word decoration_spec_id = 1;
constexpr Word decoration_array_stride = 6;
constexpr Word decoration_built_in = 11;
constexpr Word decoration_binding = 33;
constexpr Word decoration_set = 34;
constexpr Word decoration_offset = 35;
constexpr Word built_in_workgroup_size = 25;
constexpr Word storage_uniform_constant = 0;
constexpr Word storage_uniform = 2;
constexpr Word storage_push_constant = 9;
constexpr Word storage_storage_buffer = 12;
constexpr Word image_is_storage = 2;

/// One instruction's operands.
class Operands {
 public:
  Operands(const char* name, std::span<const Word> words) : name_(name), words_(words) {}
  std::size_t size() const { return words_.size(); }
  Word operator[](std::size_t i) const {
    if (i >= words_.size())
      throw Error(ErrorKind::invalid_shader,
                  std::string(name_) + ": SPIR-V instruction without operand " + std::to_string(i));
    return words_[i];
  }

 private:
  const char* name_;
  std::span<const Word> words_;
};

struct Type {
  Op op = op_type_void;
  std::uint64_t size = 0;  ///< bytes under scalar layout; 0: not data
  std::uint64_t alignment = 1;
  Word storage = 0;  ///< pointers: storage class; images: sampled or storage
  Word element = 0;  ///< pointers, arrays, sampled images
};

struct Constant {
  Word value = 0;
};

class Reader {
 public:
  explicit Reader(const ShaderCode& code) : name_(code.name), words_(code.words) {}
  ShaderReflection read();

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::invalid_shader, std::string(name_) + ": " + what);
  }
  void instruction(Op op, const Operands& operands);
  void decorate(const Operands& operands);
  void execution_mode(const Operands& operands, bool ids);
  void define_type(Op op, const Operands& operands);
  Type data_type(Op op, const Operands& operands) const;
  Type array_type(const Operands& operands) const;
  Type struct_type(const Operands& operands) const;
  void define_constant(Op op, const Operands& operands);
  void define_variable(const Operands& operands);
  void add_descriptor(Word variable, const Type& type);
  void set_local_size(int axis, Word id);
  const Type& type(Word id) const;
  std::optional<Word> decoration(Word id, Word kind) const;

  const char* name_;
  std::span<const Word> words_;
  ShaderReflection reflection_;
  std::map<std::pair<Word, Word>, Word> decorations_;  ///< (id, kind)
  std::map<std::pair<Word, Word>, Word> offsets_;      ///< (struct, member)
  std::map<Word, Type> types_;
  std::map<Word, Constant> constants_;
  std::optional<std::array<Word, 3>> local_size_ids_;
  bool has_entry_ = false;
};

std::uint64_t round_up(std::uint64_t value, std::uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

ShaderReflection Reader::read() {
  if (words_.size() < header_words || words_[0] != magic) fail("no SPIR-V module");
  for (std::size_t at = header_words; at < words_.size();) {
    const std::size_t length = words_[at] >> 16;
    if (length == 0 || length > words_.size() - at)
      fail("SPIR-V instruction of " + std::to_string(length) + " words at word " +
           std::to_string(at));
    instruction(static_cast<Op>(words_[at] & 0xFFFF),
                Operands(name_, words_.subspan(at + 1, length - 1)));
    at += length;
  }
  if (!has_entry_) fail("SPIR-V without an entry point");
  if (local_size_ids_)
    for (int axis = 0; axis < 3; ++axis)
      set_local_size(axis, (*local_size_ids_)[static_cast<std::size_t>(axis)]);
  std::sort(reflection_.specialization_ids.begin(), reflection_.specialization_ids.end());
  return reflection_;
}

void Reader::instruction(Op op, const Operands& operands) {
  switch (op) {
    case op_entry_point:
      has_entry_ = true;
      break;
    case op_execution_mode:
      execution_mode(operands, false);
      break;
    case op_execution_mode_id:
      execution_mode(operands, true);
      break;
    case op_decorate:
      decorate(operands);
      break;
    case op_member_decorate:
      if (operands[2] == decoration_offset) offsets_[{operands[0], operands[1]}] = operands[3];
      break;
    case op_constant:
    case op_constant_composite:
    case op_spec_constant_true:
    case op_spec_constant_false:
    case op_spec_constant:
    case op_spec_constant_composite:
      define_constant(op, operands);
      break;
    case op_variable:
      define_variable(operands);
      break;
    default:
      if (op >= op_type_void && op <= op_type_forward_pointer) define_type(op, operands);
  }
}

void Reader::decorate(const Operands& operands) {
  const Word id = operands[0];
  const Word kind = operands[1];
  const bool has_value = kind == decoration_spec_id || kind == decoration_array_stride ||
                         kind == decoration_built_in || kind == decoration_binding ||
                         kind == decoration_set;
  if (!has_value) return;
  decorations_[{id, kind}] = operands[2];
  if (kind == decoration_spec_id) reflection_.specialization_ids.push_back(operands[2]);
}

void Reader::execution_mode(const Operands& operands, bool ids) {
  const Word mode = operands[1];
  if (!ids && mode == mode_local_size)
    for (std::size_t axis = 0; axis < 3; ++axis) reflection_.local_size[axis] = operands[2 + axis];
  if (ids && mode == mode_local_size_id) local_size_ids_ = {operands[2], operands[3], operands[4]};
}

const Type& Reader::type(Word id) const {
  const auto found = types_.find(id);
  if (found == types_.end())
    fail("SPIR-V uses type " + std::to_string(id) + " before it is declared");
  return found->second;
}

std::optional<Word> Reader::decoration(Word id, Word kind) const {
  const auto found = decorations_.find({id, kind});
  if (found == decorations_.end()) return std::nullopt;
  return found->second;
}

void Reader::define_type(Op op, const Operands& operands) {
  Type made = data_type(op, operands);
  made.op = op == op_type_forward_pointer ? op_type_pointer : op;
  if (made.size > largest_size) fail("SPIR-V type of " + std::to_string(made.size) + " bytes");
  types_[operands[0]] = made;
}

Type Reader::data_type(Op op, const Operands& operands) const {
  switch (op) {
    case op_type_int:
    case op_type_float: {
      const std::uint64_t bytes = operands[1] / 8;
      if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8)
        fail("SPIR-V number of " + std::to_string(operands[1]) + " bits");
      return {.size = bytes, .alignment = bytes};
    }
    case op_type_vector:
    case op_type_matrix: {
      const Type& part = type(operands[1]);
      return {.size = part.size * operands[2], .alignment = part.alignment};
    }
    case op_type_array:
      return array_type(operands);
    case op_type_struct:
      return struct_type(operands);
    case op_type_pointer:
      return {.size = 8, .alignment = 8, .storage = operands[1], .element = operands[2]};
    case op_type_forward_pointer:
      return {.size = 8, .alignment = 8, .storage = operands[1]};
    case op_type_image:
      return {.storage = operands[6]};
    case op_type_sampled_image:
      return {.element = operands[1]};
    default:
      return {};
  }
}

Type Reader::array_type(const Operands& operands) const {
  const Type& element = type(operands[1]);
  const auto length = constants_.find(operands[2]);
  const std::uint64_t count = length == constants_.end() ? 0 : length->second.value;
  const std::uint64_t stride = decoration(operands[0], decoration_array_stride).value_or(0);
  return {.size = stride * count, .alignment = element.alignment, .element = operands[1]};
}

Type Reader::struct_type(const Operands& operands) const {
  Type made;
  for (std::size_t member = 0; member + 1 < operands.size(); ++member) {
    const Type& part = type(operands[member + 1]);
    const auto offset = offsets_.find({operands[0], static_cast<Word>(member)});
    if (offset == offsets_.end()) continue;
    made.size = std::max(made.size, offset->second + part.size);
    made.alignment = std::max(made.alignment, part.alignment);
  }
  made.size = round_up(made.size, made.alignment);
  return made;
}

void Reader::define_constant(Op op, const Operands& operands) {
  const Word id = operands[1];
  const bool composite = op == op_constant_composite || op == op_spec_constant_composite;
  if (composite) {
    if (decoration(id, decoration_built_in) == built_in_workgroup_size)
      local_size_ids_ = {operands[2], operands[3], operands[4]};
    return;
  }
  const bool boolean = op == op_spec_constant_true || op == op_spec_constant_false;
  constants_[id] = {.value = boolean ? Word{op == op_spec_constant_true} : operands[2]};
}

void Reader::set_local_size(int axis, Word id) {
  const auto found = constants_.find(id);
  if (found == constants_.end()) fail("the size of the workgroup is no plain constant");
  reflection_.local_size[axis] = found->second.value;
  const std::optional<Word> constant = decoration(id, decoration_spec_id);
  reflection_.local_size_constant[axis] = constant ? static_cast<int>(*constant) : -1;
}

void Reader::define_variable(const Operands& operands) {
  const Word storage = operands[2];
  if (storage != storage_push_constant && storage != storage_uniform_constant &&
      storage != storage_uniform && storage != storage_storage_buffer)
    return;
  const Type& pointer = type(operands[0]);
  if (pointer.op != op_type_pointer) fail("SPIR-V variable whose type is no pointer");
  const Type& pointee = type(pointer.element);
  if (storage == storage_push_constant)
    reflection_.push_constant_bytes = static_cast<std::uint32_t>(pointee.size);
  else if (storage == storage_uniform_constant)
    add_descriptor(operands[1], pointee);
  else
    fail("a buffer that is no reference: only images may be descriptors");
}

void Reader::add_descriptor(Word variable, const Type& pointee) {
  using Kind = ShaderReflection::Descriptor::Kind;
  const bool storage = pointee.op == op_type_image && pointee.storage == image_is_storage;
  if (!storage && pointee.op != op_type_sampled_image)
    fail("a descriptor that is neither a combined image sampler nor a storage image");
  const Word set = decoration(variable, decoration_set).value_or(0);
  const Word binding = decoration(variable, decoration_binding).value_or(0);
  if (set > 31 || binding > 1023)
    fail("image at set " + std::to_string(set) + ", binding " + std::to_string(binding));
  reflection_.descriptors.push_back({.set = static_cast<int>(set),
                                     .binding = static_cast<int>(binding),
                                     .kind = storage ? Kind::storage_image : Kind::sampled_image});
}

}  // namespace

ShaderReflection reflect(const ShaderCode& code) { return Reader(code).read(); }

}  // namespace parity::gpu
