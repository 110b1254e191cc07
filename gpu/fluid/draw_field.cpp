#include "gpu/fluid/draw_field.h"

#include "gpu/core/commands.h"
#include "shaders.h"
#include "shaders/fluid/draw_layout.h"

namespace parity::gpu {

Grid<vec4> draw_field(Context& context, const DrawnField& field) {
  check_drawn_field(field);
  std::vector<vec2> values;
  for (std::size_t i = 0; i < field.value.size(); ++i)
    values.emplace_back(field.value[i], field.solid[i]);
  const Buffer<vec2> velocity(context, field.velocity), value_and_solid(context, values);
  const Buffer<vec3> color_map(context, field.color_map);
  const Buffer<float> noise(context, field.noise.values());
  Grid<vec4> result{field.width, field.height};
  const Buffer<vec4> picture(context, result.size());
  const Kernel<DrawFieldArgs> kernel(context, shaders::fluid_draw_field_comp);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {uint(field.width), uint(field.height)},
                      {.velocity = velocity,
                       .value_and_solid = value_and_solid,
                       .color_map = color_map,
                       .noise = noise,
                       .picture = picture,
                       .cells = field.cells,
                       .noise_size = {field.noise.width(), field.noise.height()},
                       .width = uint(field.width),
                       .height = uint(field.height),
                       .color_count = uint(field.color_map.size()),
                       .streak = field.streak,
                       .noise_scale = field.noise_scale,
                       .contrast = field.contrast,
                       .slowest = field.slowest,
                       .solid_color = field.solid_color});
  });
  result.values() = picture.read();
  return result;
}

}  // namespace parity::gpu
