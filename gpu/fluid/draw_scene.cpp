#include "gpu/fluid/draw_scene.h"

#include <utility>

#include "shaders.h"

namespace parity::gpu {
namespace {

std::vector<DrawSolid> solids_of(const DrawnScene& scene) {
  std::vector<DrawSolid> solids;
  for (const DrawnSolid& s : scene.solids)
    solids.push_back({s.is_box, s.casts_shadow, s.low, s.high, s.color});
  return solids;
}

/// What both kinds of kernels read, without addresses.
DrawScene constants_of(const DrawnScene& scene) {
  const DrawnView& view = scene.view;
  const DrawnLight& light = scene.light;
  const DrawnVolume& volume = scene.volume;
  DrawScene s{};
  s.width = uint(view.width * view.samples);
  s.height = uint(view.height * view.samples);
  s.is_orthographic = view.is_orthographic ? 1 : 0;
  s.eye = view.eye;
  s.right = view.right;
  s.up = view.up;
  s.forward = view.forward;
  s.particle_count = uint(scene.positions.size());
  s.radius = scene.radius;
  s.solid_count = uint(scene.solids.size());
  s.mode = uint(volume.mode);
  s.volume_size = volume.size;
  s.volume_origin = volume.origin;
  s.cell = volume.cell;
  s.sun = light.sun;
  s.sun_color = light.sun_color;
  s.sky_color = light.sky_color;
  s.ground_color = light.ground_color;
  s.horizon = light.horizon;
  s.zenith = light.zenith;
  s.floor_color = light.floor_color;
  s.floor_y = light.floor_y;
  s.fade = light.fade;
  s.has_floor = light.has_floor;
  s.medium = light.medium;
  s.forward_scatter = light.forward_scatter;
  return s;
}

}  // namespace

SceneDrawer::SceneDrawer(Context& context)
    : depth_(context, shaders::fluid_draw_depth_comp),
      nearest_(context, shaders::fluid_draw_nearest_comp),
      light_(context, shaders::fluid_draw_light_comp),
      picture_(context, shaders::fluid_draw_scene_comp) {}

Grid<vec4> SceneDrawer::draw(Context& context, const DrawnScene& scene) const {
  check_drawn_scene(scene);
  DrawScene constants = constants_of(scene);
  const bool has_volume = scene.volume.mode != VolumeMode::none;
  const std::size_t samples = std::size_t(constants.width) * constants.height;
  const std::size_t layer = has_volume ? std::size_t(scene.volume.size.x * scene.volume.size.z) : 0;
  const Buffer<vec3> positions(context, scene.positions), colors(context, scene.colors);
  const Buffer<float> values(context, has_volume ? scene.volume.values : std::vector<float>{});
  const Buffer<DrawCell> cells(context, values.count());
  const Buffer<DrawSolid> solids(context, solids_of(scene));
  const Buffer<std::uint32_t> depths(context, samples), nearest(context, samples);
  Buffer<float> above(context, 6 * layer), here(context, 6 * layer);
  const Buffer<vec4> picture(context,
                             std::size_t(scene.view.width) * std::size_t(scene.view.height));
  constants.positions = positions;
  constants.colors = colors;
  constants.values = values;
  constants.cells = cells;
  constants.solids = solids;
  constants.depths = depths;
  constants.nearest = nearest;
  const Buffer<DrawScene> shared(context, std::vector<DrawScene>{constants});
  context.run([&](Commands& commands) {
    commands.fill(depths, 0xffffffffu);
    commands.fill(nearest, 0xffffffffu);
    if (constants.particle_count > 0) {
      commands.dispatch(depth_, {constants.particle_count}, {shared});
      commands.dispatch(nearest_, {constants.particle_count}, {shared});
    }
    for (int row = has_volume ? scene.volume.size.y - 1 : -1; row >= 0; --row) {
      commands.dispatch(light_, {uint(layer)}, {shared, above, here, uint(row), 0});
      std::swap(above, here);
    }
    commands.dispatch(picture_, {uint(scene.view.width), uint(scene.view.height)},
                      {shared, picture, uint(scene.view.samples), 0});
  });
  Grid<vec4> result{scene.view.width, scene.view.height};
  result.values() = picture.read();
  return result;
}

Grid<vec4> draw_scene(Context& context, const DrawnScene& scene) {
  return SceneDrawer(context).draw(context, scene);
}

}  // namespace parity::gpu
