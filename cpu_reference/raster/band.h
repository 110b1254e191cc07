#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cpu_reference/raster/band_doubt.h"
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

/// An element and where it belongs.
struct ElementName {
  std::uint32_t draw = 0;
  std::uint32_t element = 0;
};

/// The last surfaces that were asked for: neighbouring pixels mostly show the same ones.
class SurfaceCache {
 public:
  explicit SurfaceCache(const RenderJob& job) : job_(job), entries_(entry_count) {}

  /// The reference holds until another element is asked for.
  const ElementSurface& of(ElementName name) { return entry(name).surface; }
  const ElementError& error_of(ElementName name);

 private:
  struct Entry {
    std::uint32_t element = 0xffffffff;
    ElementSurface surface;
    std::optional<ElementError> error;
  };
  static constexpr std::size_t entry_count = 128;

  Entry& entry(ElementName name);

  const RenderJob& job_;
  std::vector<Entry> entries_;
};

/// Rows of the picture with all their samples: first the opaque pieces, then `shade`, then the
/// blended ones. Borders in doubt are told after the pieces of their kind.
class Band {
 public:
  Band(const RenderJob& job, PixelBox box);

  void draw_opaque(const Piece& piece);
  void shade();
  void draw_blended(const Piece& piece);
  void doubt_border(ElementName name, bool blended);
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

  std::size_t pixel_index(int x, int y) const {
    return std::size_t(y - box_.top) * std::size_t(box_.right) + std::size_t(x);
  }
  std::size_t first_sample(int x, int y) const { return pixel_index(x, y) * job_.places.size(); }
  DepthRange depth_range(ElementName name, const ElementDepth& depth, int x, int y,
                         std::size_t sample);
  std::uint32_t visible(const ElementDepth& depth, int x, int y, std::uint32_t mask) const;
  bool passes_mask(ElementName name, int x, int y);
  void contend(ElementName name, const ElementDepth& depth, int x, int y, std::uint32_t mask);
  BoundedColor shaded(ElementName name, int x, int y, bool back);
  void shade_pixel(int x, int y);

  const RenderJob& job_;
  PixelBox box_;
  SurfaceCache surfaces_;
  std::vector<Front> front_;        ///< one a sample
  std::vector<dvec4> color_;        ///< one a sample, premultiplied
  std::optional<BandDoubt> doubt_;  ///< if bounds are asked for
};

}  // namespace parity::cpu
