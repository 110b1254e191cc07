#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cpu_reference/raster/depth_test.h"
#include "cpu_reference/raster/elements.h"
#include "cpu_reference/raster/surface.h"

namespace parity::cpu {

/// What a device's samplers may do differently from exact arithmetic, on the drivers that Parity is
/// checked with. Source: conformance 1.3 ("bilinear", "LOD isotropic", "sRGB decode").
struct SamplerLimits {
  int sub_texel_bits = 8;
  double lod_low = -0.0431;  ///< piecewise-linear log2 of the fragment's scale factor
  double lod_high = 0.0;
  double srgb_decode_codes = 0.5;  ///< error of decoding a texel, in codes of 8 bits
};

/// What a device may do differently from exact arithmetic.
struct DeviceLimits {
  int sub_pixel_bits = 8;
  std::optional<SamplerLimits> sampler;  ///< none: shaders filter textures in single precision
  double mip_codes = 0.02;               ///< error of a mip level's value before it is rounded
  bool half_color = true;                ///< colour targets of 16-bit floats, else 32
  /// px; lavapipe (25.0.7, measured) takes depth and varyings of multisampled lines half a pixel to
  /// the right and half a pixel down of where they belong.
  double multisampled_line_shift = 0.7072;
};

/// How far a device may be from the reference in what varies over an element. A value a = n / d
/// with n and d affine in the window may be off by
///   |grad a| r                        r: snapping moves vertices by sqrt2 2^-(b+1) px, times the
///                                     sum of |screen barycentrics|, which is 1 inside
///   (e(n) + |a| e(d)) / (d - e(d))    float planes: e(n) = 8 2^-24 max(|n0| + |n_x| W + |n_y| H,
///                                     |n_i|) + 4 2^-24 max|n_i| L^2 / 2A
///   11 2^-23 |a|                      the quotient
/// Snapping moves n and d together, so it is counted once, on a. The new vertices of a clipped
/// element are off by k = 4 2^-24 c, where c is its largest clip coordinate. So what is seen at a
/// pixel is moved by k max(W, H) / w pixels more, a is off by k / w of its range, 2 max|a_i|, and
/// z / w by (1 + z / w) k / w; and L^2 / 2A is the largest of all triangles at the pixel that a
/// device may cut the clipped polygon into.
///
/// Source: conformance 1.3 ("varyings, z"), with the set-up term of interpolate_bound.
class ElementError {
 public:
  ElementError(const PlacedDraw& draw, std::uint32_t element, const Planes& planes,
               const Frame& frame, const DeviceLimits& limits);

  /// Largest deviation at the centre of pixel (x, y) of a varying with these values at the
  /// vertices.
  double varying(const std::array<double, 3>& values, int x, int y) const;

  /// The same of its change from the pixel to the one `step` away, in its 2x2 quad.
  double difference(const std::array<double, 3>& values, int x, int y, ivec2 step) const;

  /// Of the depth at a place in pixel (x, y).
  double depth(int x, int y, dvec2 place, const DepthTest& test) const;

  /// How far an edge may be from where it should be, seen at a point: px.
  double edge(double x, double y) const;

 private:
  /// How badly a triangle's planes are conditioned: L the longest edge in pixels, A its area.
  struct Slenderness {
    double ratio = 0;      ///< L^2 / 2A
    double per_pixel = 0;  ///< L / 2A
  };
  struct Part {
    std::array<dvec2, 3> corners{};
    Slenderness slenderness;
  };

  static Slenderness slenderness_of(const std::array<dvec2, 3>& corners);
  void add_parts(const std::array<vec4, 3>& clip);
  Slenderness slenderness(double x, double y) const;
  double moved(double x, double y) const;
  double over_window(const dvec3& plane) const;
  double rounding(const dvec3& plane, double largest, double slenderness) const;
  dvec3 plane_of(const std::array<double, 3>& values) const;
  double largest_over_w(const std::array<double, 3>& values) const;

  Planes planes_;
  std::array<double, 3> w_{};
  std::array<double, 3> z_{};
  double width_;
  double height_;
  double snap_;       ///< px
  double shift_ = 0;  ///< px, of multisampled lines
  double reach_;      ///< px that a covered sample may be from the place of shading
  Slenderness whole_;
  std::vector<Part> parts_;  ///< of a clipped element, the slender ones
  bool clipped_;
  double clip_error_ = 0;  ///< k, in clip space
};

/// A colour, how far a right device may be from it, and whether a choice of texel or mip level is
/// within its error. RGB is not multiplied by alpha.
struct BoundedColor {
  dvec4 value{0.0};
  dvec4 bound{0.0};
  bool in_doubt = false;
};

/// shade_at with its bound: every input of the shading (varyings, lookups at moved coordinates and
/// levels of detail) is moved by its error, up and down, and the absolute changes are added up; the
/// float arithmetic of the shading itself is enclosed by Interval.
BoundedColor shade_with_bound(const PlacedDraw& draw, std::uint32_t element,
                              const ElementSurface& surface, const ElementError& error,
                              const ShadingScene& scene, const DeviceLimits& limits, int x, int y,
                              bool back);

/// alpha_at with its bound, in the channel w.
BoundedColor alpha_with_bound(const PlacedDraw& draw, std::uint32_t element,
                              const ElementSurface& surface, const ElementError& error,
                              const DeviceLimits& limits, int x, int y);

}  // namespace parity::cpu
