#include "gpu/core/kernel.h"

#include <algorithm>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

std::uint32_t local_size(const ShaderReflection& reflection, int axis,
                         const std::vector<Specialization>& specializations) {
  const int constant = reflection.local_size_constant[axis];
  std::uint32_t size = reflection.local_size[axis];
  for (const Specialization& each : specializations)
    if (constant >= 0 && each.id == static_cast<std::uint32_t>(constant)) size = each.value;
  return size;
}

void check_workgroup(const ContextState& context, const RawKernel::State& state) {
  const VkPhysicalDeviceLimits& limits = context.properties.limits;
  std::uint64_t invocations = 1;
  bool fits = true;
  for (int axis = 0; axis < 3; ++axis) {
    invocations *= state.local_size[axis];
    fits = fits && state.local_size[axis] >= 1 &&
           state.local_size[axis] <= limits.maxComputeWorkGroupSize[axis] &&
           invocations <= limits.maxComputeWorkGroupInvocations;
  }
  if (!fits)
    throw Error(ErrorKind::missing_feature,
                state.name + ": a workgroup of " + std::to_string(state.local_size[0]) + "x" +
                    std::to_string(state.local_size[1]) + "x" +
                    std::to_string(state.local_size[2]) + " does not fit device " +
                    context.info.name + ", which takes " +
                    std::to_string(limits.maxComputeWorkGroupInvocations) + " invocations");
}

OwnedPipelineLayout make_layout(const ContextState& context, const RawKernel::State& state) {
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, state.args_bytes};
  const VkDescriptorSetLayout set = state.set_layout.get();
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = state.set_layout ? 1 : 0;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = state.args_bytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  return create<OwnedPipelineLayout>(context.link(), vkCreatePipelineLayout, info,
                                     "vkCreatePipelineLayout");
}

}  // namespace

OwnedShader make_shader(ContextState& context, const ShaderCode& code) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.words.size_bytes();
  info.pCode = code.words.data();
  return create<OwnedShader>(context.link(), vkCreateShaderModule, info, "vkCreateShaderModule");
}

OwnedSetLayout make_set_layout(const ContextState& context, const ShaderImages& images,
                               VkShaderStageFlags stage) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const ShaderReflection::Descriptor& each : images.descriptors) {
    if (each.set != 0)
      throw Error(
          ErrorKind::invalid_shader,
          images.name + ": images must be in set 0, one is in set " + std::to_string(each.set));
    VkDescriptorSetLayoutBinding binding{};
    binding.binding = static_cast<std::uint32_t>(each.binding);
    binding.descriptorType = each.kind == ShaderReflection::Descriptor::Kind::sampled_image
                                 ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                 : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    binding.descriptorCount = 1;
    binding.stageFlags = stage;
    bindings.push_back(binding);
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  return create<OwnedSetLayout>(context.link(), vkCreateDescriptorSetLayout, info,
                                "vkCreateDescriptorSetLayout");
}

SpecializationData::SpecializationData(const std::vector<Specialization>& specializations) {
  for (const Specialization& each : specializations) {
    entries.push_back({each.id, static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)),
                       sizeof(std::uint32_t)});
    values.push_back(each.value);
  }
  info.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  info.pMapEntries = entries.data();
  info.dataSize = values.size() * sizeof(std::uint32_t);
  info.pData = values.data();
}

void check_args(const ContextState& context, const char* name, std::uint32_t shader_bytes,
                std::size_t args_bytes) {
  // An empty struct has size 1 in C++ and stands for no push constants.
  const bool both_empty = shader_bytes == 0 && args_bytes <= 1;
  if (!both_empty && shader_bytes != args_bytes)
    throw Error(ErrorKind::invalid_shader,
                std::string(name) + ": Args has " + std::to_string(args_bytes) +
                    " bytes, the shader's push constants " + std::to_string(shader_bytes));
  if (shader_bytes > context.properties.limits.maxPushConstantsSize)
    throw Error(ErrorKind::missing_feature,
                std::string(name) + ": " + std::to_string(shader_bytes) +
                    " bytes of push constants, the device takes " +
                    std::to_string(context.properties.limits.maxPushConstantsSize));
}

namespace {

std::shared_ptr<const RawKernel::State> build(ContextState& shared, const ShaderCode& code,
                                              std::size_t args_bytes,
                                              const std::vector<Specialization>& specializations) {
  const auto built = std::make_shared<RawKernel::State>();
  RawKernel::State& state = *built;
  state.name = code.name;
  state.reflection = reflect(code);
  state.args_bytes = state.reflection.push_constant_bytes;
  check_args(shared, code.name, state.args_bytes, args_bytes);
  for (int axis = 0; axis < 3; ++axis)
    state.local_size[axis] = local_size(state.reflection, axis, specializations);
  check_workgroup(shared, state);
  if (!state.reflection.descriptors.empty())
    state.set_layout = make_set_layout(shared, {state.name, state.reflection.descriptors},
                                       VK_SHADER_STAGE_COMPUTE_BIT);
  state.layout = make_layout(shared, state);

  const OwnedShader shader = make_shader(shared, code);
  const SpecializationData constants(specializations);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &constants.info;
  info.layout = state.layout.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(
      vkCreateComputePipelines(shared.link().device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
      "vkCreateComputePipelines");
  state.pipeline = OwnedPipeline(shared.link(), pipeline);
  return built;
}

}  // namespace

RawKernel::RawKernel(Context& context, const ShaderCode& code, std::size_t args_bytes,
                     const std::vector<Specialization>& specializations) {
  RasterOptions options;
  options.specializations = specializations;
  state_ = context.state().kernels.find({{&code, 1}, args_bytes, std::move(options)}, [&] {
    return build(context.state(), code, args_bytes, specializations);
  });
}

}  // namespace parity::gpu
