#include "gpu/texture/environment.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {
namespace {

std::vector<vec4> run(Context& context, const Grid<vec4>& picture, std::span<const vec3> directions,
                      bool cube) {
  std::vector<vec4> inputs;
  for (const vec3& d : directions) inputs.emplace_back(d, 0.0f);
  const Buffer<vec4> texels(context, picture.values()), in(context, inputs),
      out(context, inputs.size());
  const Kernel<EnvironmentArgs> kernel(context, shaders::texture_environment_comp);
  const auto count = std::uint32_t(inputs.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      {texels, in, out, std::uint32_t(picture.width()),
                       std::uint32_t(picture.height()), count, cube ? 1u : 0u});
  });
  return out.read();
}

}  // namespace

std::vector<vec4> sample_equirectangular(Context& context, const Grid<vec4>& picture,
                                         std::span<const vec3> directions) {
  if (picture.empty())
    throw std::invalid_argument("gpu::sample_equirectangular: the picture is empty");
  return run(context, picture, directions, false);
}

std::vector<vec4> sample_cube_map(Context& context, const Grid<vec4>& faces,
                                  std::span<const vec3> directions) {
  if (faces.empty() || faces.height() != 6 * faces.width())
    throw std::invalid_argument("gpu::sample_cube_map: size is " + std::to_string(faces.width()) +
                                "x" + std::to_string(faces.height()) +
                                ", must be six squares, one below the other");
  return run(context, faces, directions, true);
}

}  // namespace parity::gpu
