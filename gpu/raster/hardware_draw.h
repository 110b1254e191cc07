#pragma once

#include "geometry/raster.h"
#include "gpu/core/commands.h"
#include "gpu/raster/triangle_buffers.h"

/// What the stages that use the fixed-function pipeline share.
namespace parity::gpu {

Culling culling_of(Cull cull);

/// A target that is cleared to zeros.
ColorTarget cleared(const Image& image);

/// Draws all triangles; the pipeline uses raster/draw.vert.
void draw_triangles(RenderPass& pass, const RasterPipeline<DrawArgs>& pipeline,
                    const TriangleBuffers& triangles, const DrawArgs& args);

/// The arguments of raster/draw.vert for a list without varyings.
DrawArgs draw_args(const TriangleBuffers& triangles);

}  // namespace parity::gpu
