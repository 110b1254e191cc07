#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gpu/core/context.h"
#include "gpu/core/image.h"
#include "gpu/core/shader.h"

namespace parity::gpu {

enum class Compare {
  never,
  less,
  equal,
  less_or_equal,
  greater,
  not_equal,
  greater_or_equal,
  always
};
enum class Blend { replace, source_over, premultiplied_over, add };
enum class Culling { none, back, front };  ///< counter-clockwise seen with y up is front
enum class Primitive { points, lines, triangles };
/// Which pixels a line covers: as the device likes, or those of Bresenham, where it can.
enum class LineRule { any, bresenham };

struct RasterOptions {
  std::vector<Format> colors;
  std::vector<Blend> blends;  ///< one a colour; empty: replace everywhere
  std::optional<Format> depth;
  Compare depth_compare = Compare::less;
  bool depth_write = true;
  bool depth_clamp = false;
  Culling culling = Culling::none;
  Primitive primitive = Primitive::triangles;
  LineRule line_rule = LineRule::any;
  int samples = 1;
  std::vector<Specialization> specializations;  ///< for both stages
  bool operator==(const RasterOptions&) const = default;
};

/// A vertex + fragment pipeline. Use RasterPipeline<Args>. Built once in a context: a second one of
/// the same shaders and options shares it. Throws Error{missing_feature} for samples, depth_clamp
/// or a line_rule that the device lacks.
class RawRasterPipeline {
 public:
  RawRasterPipeline(Context& context, const ShaderCode& vertex, const ShaderCode& fragment,
                    std::size_t args_bytes, const RasterOptions& options);

  struct State;  // for gpu/core only
  const State* state() const { return state_.get(); }

 private:
  std::shared_ptr<const State> state_;
};

/// Vertices are pulled through buffer references by gl_VertexIndex; `Args` are the push constants
/// of both stages. Front faces are counter-clockwise with y up; clip space has y down, as
/// clip_from_view makes it.
template <typename Args>
class RasterPipeline {
 public:
  RasterPipeline(Context& context, const ShaderCode& vertex, const ShaderCode& fragment,
                 const RasterOptions& options)
      : raw_(context, vertex, fragment, sizeof(Args), options) {}
  const RawRasterPipeline& raw() const { return raw_; }

 private:
  RawRasterPipeline raw_;
};

}  // namespace parity::gpu
