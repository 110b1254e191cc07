#include "gpu/core/raster_pipeline.h"

#include <algorithm>
#include <array>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

VkCompareOp compare_op(Compare compare) {
  switch (compare) {
    case Compare::never:
      return VK_COMPARE_OP_NEVER;
    case Compare::less:
      return VK_COMPARE_OP_LESS;
    case Compare::equal:
      return VK_COMPARE_OP_EQUAL;
    case Compare::less_or_equal:
      return VK_COMPARE_OP_LESS_OR_EQUAL;
    case Compare::greater:
      return VK_COMPARE_OP_GREATER;
    case Compare::not_equal:
      return VK_COMPARE_OP_NOT_EQUAL;
    case Compare::greater_or_equal:
      return VK_COMPARE_OP_GREATER_OR_EQUAL;
    case Compare::always:
      return VK_COMPARE_OP_ALWAYS;
  }
  throw std::invalid_argument("RasterPipeline: unknown comparison");
}

VkPrimitiveTopology topology(Primitive primitive) {
  switch (primitive) {
    case Primitive::points:
      return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case Primitive::lines:
      return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case Primitive::triangles:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  }
  throw std::invalid_argument("RasterPipeline: unknown primitive");
}

/// Colour and alpha blend alike: `source` * new + `target` * old.
VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  if (blend == Blend::replace) return state;
  state.blendEnable = VK_TRUE;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  const VkBlendFactor kept =
      blend == Blend::add ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.srcColorBlendFactor =
      blend == Blend::source_over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = kept;
  state.dstAlphaBlendFactor = kept;
  return state;
}

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, const OwnedShader& shader,
                                           const SpecializationData& constants) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = shader.get();
  info.pName = "main";
  info.pSpecializationInfo = &constants.info;
  return info;
}

void check_options(const ContextState& context, const RasterOptions& options) {
  if (!options.blends.empty() && options.blends.size() != options.colors.size())
    throw std::invalid_argument("RasterPipeline: " + std::to_string(options.blends.size()) +
                                " blends for " + std::to_string(options.colors.size()) +
                                " colours");
  const std::vector<int>& counts = context.info.sample_counts;
  if (std::find(counts.begin(), counts.end(), options.samples) == counts.end())
    throw Error(ErrorKind::missing_feature, "device " + context.info.name + " does not offer " +
                                                std::to_string(options.samples) + " samples");
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(context.physical, &features);
  if (options.depth_clamp && features.depthClamp == VK_FALSE)
    throw Error(ErrorKind::missing_feature, "device " + context.info.name + " lacks depthClamp");
  if (options.line_rule == LineRule::bresenham && !context.device->bresenham_lines)
    throw Error(ErrorKind::missing_feature,
                "device " + context.info.name + " lacks bresenhamLines");
}

OwnedPipelineLayout make_layout(const ContextState& context,
                                const RawRasterPipeline::State& state) {
  const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                  state.args_bytes};
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

/// The fixed-function state that `options` asks for; points into itself.
struct FixedState {
  explicit FixedState(const RasterOptions& options);
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  std::vector<VkFormat> formats;
  std::vector<VkPipelineColorBlendAttachmentState> attachments;
  std::array<VkDynamicState, 4> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                               VK_DYNAMIC_STATE_CULL_MODE,
                                               VK_DYNAMIC_STATE_FRONT_FACE};
  VkPipelineRenderingCreateInfo rendering{};
  VkPipelineVertexInputStateCreateInfo vertex_input{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationLineStateCreateInfoEXT lines{};
  VkPipelineRasterizationStateCreateInfo rasterization{};
  VkPipelineMultisampleStateCreateInfo multisample{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  VkPipelineColorBlendStateCreateInfo blend{};
  VkPipelineDynamicStateCreateInfo dynamic{};
};

FixedState::FixedState(const RasterOptions& options) {
  for (std::size_t i = 0; i < options.colors.size(); ++i) {
    formats.push_back(vulkan_format(options.colors[i]));
    attachments.push_back(blend_state(options.blends.empty() ? Blend::replace : options.blends[i]));
  }
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
  rendering.pColorAttachmentFormats = formats.data();
  if (options.depth) rendering.depthAttachmentFormat = vulkan_format(*options.depth);
  vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = topology(options.primitive);
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  rasterization.depthClampEnable = options.depth_clamp ? VK_TRUE : VK_FALSE;
  rasterization.polygonMode = VK_POLYGON_MODE_FILL;
  rasterization.lineWidth = 1;
  lines.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT;
  lines.lineRasterizationMode = VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT;
  if (options.line_rule == LineRule::bresenham) rasterization.pNext = &lines;
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(options.samples);
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = options.depth ? VK_TRUE : VK_FALSE;
  depth.depthWriteEnable = options.depth && options.depth_write ? VK_TRUE : VK_FALSE;
  depth.depthCompareOp = compare_op(options.depth_compare);
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  blend.pAttachments = attachments.data();
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
  dynamic.pDynamicStates = dynamic_states.data();
}

VkPipeline make_pipeline(const ContextState& context, const RasterOptions& options,
                         std::span<const VkPipelineShaderStageCreateInfo> stages,
                         VkPipelineLayout layout) {
  const FixedState fixed(options);
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &fixed.rendering;
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &fixed.vertex_input;
  info.pInputAssemblyState = &fixed.assembly;
  info.pViewportState = &fixed.viewport;
  info.pRasterizationState = &fixed.rasterization;
  info.pMultisampleState = &fixed.multisample;
  info.pDepthStencilState = &fixed.depth;
  info.pColorBlendState = &fixed.blend;
  info.pDynamicState = &fixed.dynamic;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(context.link().device, VK_NULL_HANDLE, 1, &info, nullptr,
                                  &pipeline),
        "vkCreateGraphicsPipelines");
  return pipeline;
}

std::shared_ptr<const RawRasterPipeline::State> build(ContextState& shared,
                                                      const ShaderCode& vertex,
                                                      const ShaderCode& fragment,
                                                      std::size_t args_bytes,
                                                      const RasterOptions& options) {
  const auto built = std::make_shared<RawRasterPipeline::State>();
  RawRasterPipeline::State& state = *built;
  state.name = std::string(vertex.name) + " + " + fragment.name;
  state.options = options;
  check_options(shared, options);
  for (const ShaderCode* code : {&vertex, &fragment}) {
    const ShaderReflection reflection = reflect(*code);
    if (!reflection.descriptors.empty() && code == &vertex)
      throw Error(ErrorKind::invalid_shader,
                  std::string(code->name) + ": vertex shaders have no images");
    state.descriptors = reflection.descriptors;
    // A stage may leave the arguments to the other.
    if (reflection.push_constant_bytes == 0) continue;
    check_args(shared, code->name, reflection.push_constant_bytes, args_bytes);
    state.args_bytes = reflection.push_constant_bytes;
  }
  if (state.args_bytes == 0) check_args(shared, state.name.c_str(), 0, args_bytes);
  if (!state.descriptors.empty())
    state.set_layout =
        make_set_layout(shared, {state.name, state.descriptors}, VK_SHADER_STAGE_FRAGMENT_BIT);
  state.layout = make_layout(shared, state);

  const OwnedShader vertex_shader = make_shader(shared, vertex);
  const OwnedShader fragment_shader = make_shader(shared, fragment);
  const SpecializationData constants(options.specializations);
  const VkPipelineShaderStageCreateInfo stages[] = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex_shader, constants),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_shader, constants)};
  state.pipeline =
      OwnedPipeline(shared.link(), make_pipeline(shared, options, stages, state.layout.get()));
  return built;
}

}  // namespace

RawRasterPipeline::RawRasterPipeline(Context& context, const ShaderCode& vertex,
                                     const ShaderCode& fragment, std::size_t args_bytes,
                                     const RasterOptions& options) {
  const ShaderCode both[] = {vertex, fragment};
  state_ = context.state().raster_pipelines.find({both, args_bytes, options}, [&] {
    return build(context.state(), vertex, fragment, args_bytes, options);
  });
}

}  // namespace parity::gpu
