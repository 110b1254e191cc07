#include "gpu/raster/bare_draw.h"

#include <array>

#include "geometry/albedo_table.h"
#include "gpu/raster/half.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

RasterOptions raster_options() {
  RasterOptions options;
  options.colors = {Format::rgba16_float};
  options.depth = Format::d32_float;
  options.depth_compare = Compare::greater;
  options.culling = Culling::back;
  return options;
}

}  // namespace

BareDraw::BareDraw(Context& context, const parity::Primitive& primitive, int width, int height)
    : context_(context),
      pipeline_(context, shaders::raster_bare_vert, shaders::raster_bare_frag, raster_options()),
      color_(context, {.width = width, .height = height, .format = Format::rgba16_float}),
      depth_(context, {.width = width, .height = height, .format = Format::d32_float}),
      positions_(context, primitive.positions),
      normals_(context, primitive.normals),
      indices_(context, primitive.indices),
      albedo_table_(context, parity::albedo_table().values()),
      material_(context, 1),
      color_words_(context, 2 * std::size_t(width) * std::size_t(height)),
      depth_values_(context, std::size_t(width) * std::size_t(height)) {}

Timing BareDraw::draw(const Frame& frame, const Material& material) {
  const PlacedLight& light = frame.lights.at(0);
  material_.write(
      std::vector<BareMaterial>{{.base_color = vec3(material.base_color),
                                 .ambient = frame.ambient,
                                 .irradiance = light.light.color * light.light.intensity}});
  const BareArgs args{.clip_from_object = frame.draws.at(0).clip_from_object,
                      .positions = positions_,
                      .normals = normals_,
                      .material = material_,
                      .albedo_table = albedo_table_,
                      .eye = vec3(frame.eye),
                      .roughness = material.roughness,
                      .to_light = vec3(-light.direction),
                      .padding = 0};
  const IndexedDraw all{.index_count = std::uint32_t(indices_.count())};
  return context_.run([&](Commands& commands) {
    commands.pass("draw");
    commands.render({.colors = {{.image = &color_, .clear = std::array<float, 4>{}}},
                     .depth = DepthTarget{.image = &depth_, .clear = 0.0f}},
                    [&](RenderPass& pass) {
                      pass.draw_indexed(pipeline_, args, indices_, {&all, 1});
                    });
    commands.pass("readback");
    commands.copy(color_, color_words_);
    commands.copy(depth_, depth_values_);
  });
}

Grid<vec4> BareDraw::picture() const {
  Grid<vec4> result(color_.options().width, color_.options().height);
  result.values() = vec4_from_halves(color_words_.read());
  return result;
}

}  // namespace parity::gpu
