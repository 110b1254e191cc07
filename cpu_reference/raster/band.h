#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu_reference/raster/depth_test.h"
#include "cpu_reference/raster/elements.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/raster/surface.h"

namespace parity::cpu {

/// What all bands of a picture share; read only.
struct RenderJob {
  const Frame& frame;
  const RenderOptions& options;
  const Elements& elements;
  const SceneTextures& textures;
  ShadingScene lights;
  DepthTest depth;
  std::vector<dvec2> places;  ///< of the samples in a pixel, in pixels
};

/// The last surfaces that were asked for: neighbouring pixels mostly show the same ones.
class SurfaceCache {
 public:
  explicit SurfaceCache(const RenderJob& job) : job_(job), entries_(entry_count) {}
  const ElementSurface& of(std::uint32_t draw, std::uint32_t element);

 private:
  struct Entry {
    std::uint32_t element = 0xffffffff;
    ElementSurface surface;
  };
  static constexpr std::size_t entry_count = 128;
  const RenderJob& job_;
  std::vector<Entry> entries_;
};

/// Rows of the picture with all their samples. First opaque pieces, then `shade`, then blended
/// ones.
class Band {
 public:
  Band(const RenderJob& job, PixelBox box);

  void draw_opaque(const Piece& piece);
  void shade();
  void draw_blended(const Piece& piece);
  void store(Rendered& rendered) const;

 private:
  /// Who is in front of a sample.
  struct Front {
    float depth = 0;
    std::uint32_t element = no_element;
    std::uint32_t draw = 0;
    bool back = false;
  };
  static constexpr std::uint32_t no_element = 0xffffffff;

  std::size_t first_sample(int x, int y) const {
    return (std::size_t(y - box_.top) * std::size_t(box_.right) + std::size_t(x)) *
           job_.places.size();
  }
  std::uint32_t visible(const ElementDepth& depth, int x, int y, std::uint32_t mask) const;
  void shade_pixel(int x, int y);

  const RenderJob& job_;
  PixelBox box_;
  SurfaceCache surfaces_;
  std::vector<Front> front_;  ///< one a sample
  std::vector<dvec4> color_;  ///< one a sample, premultiplied
};

}  // namespace parity::cpu
