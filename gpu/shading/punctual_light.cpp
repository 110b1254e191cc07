#include "gpu/shading/punctual_light.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/raster/light_layout.h"

namespace parity::gpu {

SceneLight scene_light(const PlacedLight& placed, const dvec3& origin) {
  const Light& light = placed.light;
  SceneLight result{};
  result.position = vec3(placed.position - origin);
  result.kind = light.kind == LightKind::directional
                    ? light_directional
                    : (light.kind == LightKind::point ? light_point : light_spot);
  result.direction = vec3(placed.direction);
  result.inverse_range = light.range > 0 && std::isfinite(light.range) ? 1.0f / light.range : 0.0f;
  result.intensity = light.color * light.intensity;
  const double inner = std::cos(double(light.inner_cone_angle));
  const double outer = std::cos(double(light.outer_cone_angle));
  const double scale = 1.0 / std::max(0.001, inner - outer);
  result.angle_scale = float(scale);
  result.angle_offset = float(-outer * scale);
  return result;
}

std::vector<vec4> punctual_light(Context& context, std::span<const PlacedLight> lights,
                                 std::span<const vec3> points) {
  if (lights.size() != points.size())
    throw std::invalid_argument("gpu::punctual_light: " + std::to_string(points.size()) +
                                " points for " + std::to_string(lights.size()) + " lights");
  std::vector<SceneLight> placed;
  for (const PlacedLight& light : lights) placed.push_back(scene_light(light, dvec3(0.0)));
  const Buffer<SceneLight> in(context, placed);
  const Buffer<vec3> places(context, points);
  const Buffer<vec4> out(context, points.size());
  const Kernel<PunctualLightArgs> kernel(context, shaders::shading_punctual_light_comp);
  const auto count = std::uint32_t(points.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, PunctualLightArgs{in, places, out, count, 0});
  });
  return out.read();
}

}  // namespace parity::gpu
