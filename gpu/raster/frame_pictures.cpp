#include "gpu/raster/frame_pictures.h"

#include <algorithm>

namespace parity::gpu {
namespace {

Buffer<float> all_depths(Context& context, const LightShadow& shadow) {
  std::vector<float> depths;
  for (const ShadowCascade& cascade : shadow.cascades)
    depths.insert(depths.end(), cascade.depths.begin(), cascade.depths.end());
  return Buffer<float>(context, depths);
}

SceneEnvironment describe(const EnvironmentLight& light, BufferRef<vec4> mirrors,
                          BufferRef<vec4> irradiance) {
  SceneEnvironment result{};
  result.mirrors = mirrors;
  result.irradiance = irradiance;
  if (!light.irradiance.empty())
    result.irradiance_side = std::uint32_t(light.irradiance.width() - 2);
  std::copy(light.harmonics.begin(), light.harmonics.end(), result.harmonics);
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < light.mirrors.size(); ++i) {
    result.begins[i] = begin;
    result.sides[i] = std::uint32_t(light.mirrors[i].width() - 2);
    begin += std::uint32_t(light.mirrors[i].size());
  }
  return result;
}

std::vector<vec4> all_texels(const std::vector<Grid<vec4>>& levels) {
  std::vector<vec4> texels;
  for (const Grid<vec4>& level : levels) texels.insert(texels.end(), level.begin(), level.end());
  return texels;
}

}  // namespace

FramePictures::FramePictures(Context& context, const Frame& frame) {
  if (frame.environment) {
    mirrors_ = Buffer<vec4>(context, all_texels(frame.environment->mirrors));
    if (!frame.environment->irradiance.empty())
      irradiance_ = Buffer<vec4>(context, frame.environment->irradiance.values());
    environment_ = Buffer<SceneEnvironment>(
        context,
        std::vector<SceneEnvironment>{describe(*frame.environment, mirrors_, irradiance_)});
  }
  for (const LightShadow& shadow : frame.shadows)
    shadow_depths_.push_back(all_depths(context, shadow));
  if (!frame.openness.empty()) openness_ = Buffer<float>(context, frame.openness.values());
  if (frame.behind) behind_ = Buffer<vec4>(context, all_texels(frame.behind->levels));
}

}  // namespace parity::gpu
