#pragma once

#include <cstdint>

#include "geometry/frame.h"
#include "gpu/core/commands.h"
#include "shaders/raster/bare_layout.h"

namespace parity::gpu {

/// One mesh drawn with nothing around it: one pipeline, one indexed draw into RGBA16F and D32F.
/// What the renderer's time is measured against.
class BareDraw {
 public:
  /// @param primitive  triangles with normals, counter-clockwise, seen from the front only.
  BareDraw(Context& context, const parity::Primitive& primitive, int width, int height);

  /// @param frame  perspective, reverse-Z, one sample, of a scene whose only draw is the mesh, in
  ///               the place where it was made, under one directional light and a uniform
  ///               environment.
  /// @param material  no metal, without emission and textures.
  /// @return       passes: `draw`, `readback`.
  Timing draw(const Frame& frame, const Material& material);

  /// What was drawn last.
  Grid<vec4> picture() const;

 private:
  Context& context_;
  RasterPipeline<BareArgs> pipeline_;
  Image color_;
  Image depth_;
  Buffer<vec3> positions_;
  Buffer<vec3> normals_;
  Buffer<std::uint32_t> indices_;
  Buffer<vec4> albedo_table_;
  Buffer<BareMaterial> material_;
  Buffer<std::uint32_t> color_words_;
  Buffer<float> depth_values_;
};

}  // namespace parity::gpu
