# Compiles one shader: adds the extensions that every shader uses, runs glslang (a warning is an
# error), the SPIR-V validator and optimiser, and writes the words as C++.
# After `#pragma no_contraction` no sum or product may be fused, reordered or simplified, so that
# what specialization constants leave out of a shader does not change how the rest of it rounds.
#   cmake -DIN= -DOUT= -DNAME= -DSYMBOL= -DROOT= -DGLSLANG= -DSPIRV_VAL= -DSPIRV_OPT= -DSPIRV_DIS=
#         -DSPIRV_AS= -P compile.cmake
file(STRINGS "${IN}" first LIMIT_COUNT 1)
if(NOT first STREQUAL "#version 460")
  message(FATAL_ERROR "${NAME}: the first line is '${first}', must be '#version 460'")
endif()
file(READ "${IN}" text)
string(REPLACE "#version 460\n" "" text "${text}")
string(FIND "${text}" "#pragma no_contraction\n" no_contraction)
string(REPLACE "#pragma no_contraction\n" "\n" text "${text}")
get_filename_component(extension "${IN}" LAST_EXT)
set(full "${OUT}.full${extension}")
file(WRITE "${full}" "#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_GOOGLE_cpp_style_line_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#line 2 \"${NAME}\"
${text}")
function(run_tool)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR output MATCHES "WARNING|warning")
    message(FATAL_ERROR "${NAME}:\n${output}")
  endif()
endfunction()
run_tool(${GLSLANG} -V --quiet --target-env vulkan1.3 -I${ROOT} "${full}" -o "${OUT}.raw.spv" --depfile "${OUT}.d")
if(NOT no_contraction EQUAL -1)
  execute_process(COMMAND ${SPIRV_DIS} --raw-id "${OUT}.raw.spv" OUTPUT_VARIABLE listing)
  string(REGEX MATCHALL "%[0-9]+ = Op(FAdd|FSub|FMul|FDiv|FNegate|Dot|VectorTimesScalar|MatrixTimesVector|VectorTimesMatrix|MatrixTimesScalar|MatrixTimesMatrix) " sums "${listing}")
  list(TRANSFORM sums REPLACE "(%[0-9]+) = .*" "OpDecorate \\1 NoContraction\n")
  list(JOIN sums "" sums)
  string(FIND "${listing}" "OpDecorate " first_decoration)
  string(SUBSTRING "${listing}" 0 ${first_decoration} before)
  string(SUBSTRING "${listing}" ${first_decoration} -1 after)
  file(WRITE "${OUT}.spvasm" "${before}${sums}${after}")
  run_tool(${SPIRV_AS} --target-env vulkan1.3 --preserve-numeric-ids "${OUT}.spvasm" -o "${OUT}.raw.spv")
endif()
run_tool(${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout "${OUT}.raw.spv")
run_tool(${SPIRV_OPT} --target-env=vulkan1.3 -O "${OUT}.raw.spv" -o "${OUT}.spv")
# The dependencies belong to the C++ file that is written here, and the shader itself is one.
file(READ "${OUT}.d" deps)
string(REGEX REPLACE "^[^:]*:" "${OUT}: ${IN}" deps "${deps}")
file(WRITE "${OUT}.d" "${deps}")
file(READ "${OUT}.spv" hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
file(WRITE "${OUT}" "#include \"shaders.h\"
namespace parity::gpu::shaders {
static constexpr std::uint32_t words[] = {${words}};
const ShaderCode ${SYMBOL}{\"${NAME}\", words};
}
")
