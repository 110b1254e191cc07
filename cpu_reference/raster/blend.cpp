#include "cpu_reference/raster/blend.h"

#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

dvec4 blend_one(dvec4 source, dvec4 destination, BlendMode mode) {
  const double alpha = source.w;
  switch (mode) {
    case BlendMode::over:
      return dvec4(dvec3(source) * alpha, alpha) + (1.0 - alpha) * destination;
    case BlendMode::over_premultiplied:
      return source + (1.0 - alpha) * destination;
    case BlendMode::add:
      break;
  }
  return source + destination;
}

/// The float value that a target stores exactly.
dvec4 as_it_is(dvec4 value) { return value; }

dvec4 to_unorm8(dvec4 value) {
  return glm::floor(glm::clamp(value, 0.0, 1.0) * 255.0 + 0.5) / 255.0;
}

Grid<dvec4> blend_all(const std::vector<Grid<vec4>>& layers, BlendMode mode,
                      dvec4 (*store)(dvec4)) {
  if (layers.empty()) throw std::invalid_argument("cpu::blend: there is no layer");
  Grid<dvec4> target{layers[0].width(), layers[0].height(), dvec4(0.0)};
  for (const Grid<vec4>& layer : layers) {
    if (layer.width() != target.width() || layer.height() != target.height())
      throw std::invalid_argument("cpu::blend: a layer is " + std::to_string(layer.width()) + "x" +
                                  std::to_string(layer.height()) + ", must be " +
                                  std::to_string(target.width()) + "x" +
                                  std::to_string(target.height()) + " as the first");
    for (std::size_t i = 0; i < target.size(); ++i)
      target.values()[i] = store(blend_one(dvec4(layer.values()[i]), target.values()[i], mode));
  }
  return target;
}

}  // namespace

Grid<dvec4> blend(const std::vector<Grid<vec4>>& layers, BlendMode mode) {
  return blend_all(layers, mode, as_it_is);
}

Grid<dvec4> blend_unorm8(const std::vector<Grid<vec4>>& layers, BlendMode mode) {
  return blend_all(layers, mode, to_unorm8);
}

}  // namespace parity::cpu
