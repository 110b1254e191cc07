#include "cpu_reference/raster/surface_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::cpu {
namespace {

constexpr double half_ulp = 0x1p-24;
using Inputs = std::array<double, shading_input::count>;

/// Component `c` of values at three vertices.
template <class T>
std::array<double, 3> component(const std::array<T, 3>& values, int c) {
  return {values[0][c], values[1][c], values[2][c]};
}

/// Vertices are transformed in float: an entry of the matrix is rounded, a product, three sums.
double transform_error(const dmat3& linear, const dvec3& offset, const std::vector<vec3>& points,
                       const std::array<std::uint32_t, 3>& vertices, int row) {
  double largest = 0;
  for (const std::uint32_t v : vertices) {
    double sum = std::abs(offset[row]);
    for (int c = 0; c < 3; ++c) sum += std::abs(linear[c][row] * double(points[v][c]));
    largest = std::max(largest, sum);
  }
  return 5 * half_ulp * largest;
}

/// Deviations of the interpolated inputs. Devices keep positions relative to the eye.
Inputs varying_errors(const PlacedDraw& placed, std::uint32_t element, const ElementSurface& s,
                      const ElementError& error, const dvec3& eye, int x, int y) {
  Inputs e{};
  const Primitive& p = *placed.primitive;
  const auto vertices = element_vertices(placed, element);
  const dmat4& world = placed.draw->world_from_object;
  const bool lit = !s.material->unlit;
  const std::array<dvec3, 3> relative{s.position[0] - eye, s.position[1] - eye,
                                      s.position[2] - eye};
  for (int c = 0; c < 3 && lit; ++c) {
    const std::size_t i = std::size_t(c);
    e[shading_input::position + i] =
        error.varying(component(relative, c), x, y) +
        transform_error(dmat3(world), dvec3(world[3]) - eye, p.positions, vertices, c);
    if (!p.normals.empty())
      e[shading_input::normal + i] = error.varying(component(s.normal, c), x, y) +
                                     transform_error(placed.draw->world_from_object_normal,
                                                     dvec3(0.0), p.normals, vertices, c);
    if (!p.tangents.empty() && needs_tangents(*s.material)) {
      double longest = 0;
      for (const dvec3& t : s.tangent) longest = std::max(longest, glm::length(t));
      e[shading_input::tangent + i] =
          error.varying(component(s.tangent, c), x, y) + 5 * half_ulp * longest;
    }
  }
  if (lit && !p.tangents.empty() && needs_tangents(*s.material))
    e[shading_input::handedness] = error.varying(s.handedness, x, y);
  if (!p.colors.empty())
    for (int c = 0; c < 4; ++c)
      e[shading_input::color + std::size_t(c)] = error.varying(component(s.color, c), x, y);
  return e;
}

/// Where a texture may be read instead.
struct TextureDoubt {
  TexturePlace place;
  dvec2 uv_error{0.0};
  dvec2 dx_error{0.0};
  dvec2 dy_error{0.0};
  double lambda_low = 0;
  double lambda_high = 0;
};

/// The vertices' own coordinates, before the texture transform.
std::array<dvec2, 3> raw_uvs(const PlacedDraw& placed, std::uint32_t element,
                             const TextureUse& use) {
  std::array<dvec2, 3> uv{};
  const auto& sets = placed.primitive->uvs;
  const std::size_t set = std::size_t(use.uv_set);
  if (set >= sets.size() || sets[set].empty()) return uv;
  const auto vertices = element_vertices(placed, element);
  for (std::size_t i = 0; i < 3; ++i) uv[i] = dvec2(sets[set][vertices[i]]);
  return uv;
}

/// |M| e: how errors of u and v spread through the texture transform.
dvec2 spread(const mat3& m, dvec2 e) {
  return {std::abs(double(m[0][0])) * e.x + std::abs(double(m[1][0])) * e.y,
          std::abs(double(m[0][1])) * e.x + std::abs(double(m[1][1])) * e.y};
}

/// Interval of the level of detail from the errors of the derivatives.
void bound_lambda(TextureDoubt& doubt, dvec2 size, const DeviceLimits& limits) {
  const double across = glm::length(doubt.place.uv_dx * size);
  const double down = glm::length(doubt.place.uv_dy * size);
  const double across_error = glm::length(doubt.dx_error * size);
  const double down_error = glm::length(doubt.dy_error * size);
  const double least = std::max({across - across_error, down - down_error, 0.0});
  const double most = std::max(across + across_error, down + down_error);
  const double rounding = 0x1p-21 + 6 * half_ulp * std::abs(doubt.place.lambda);
  const auto finite = [](double v, double otherwise) { return std::isnan(v) ? otherwise : v; };
  const double low = limits.sampler ? limits.sampler->lod_low : 0.0;
  const double high = limits.sampler ? limits.sampler->lod_high : 0.0;
  doubt.lambda_low =
      finite(std::log2(least) + low - rounding, -std::numeric_limits<double>::infinity());
  doubt.lambda_high =
      finite(std::log2(most) + high + rounding, std::numeric_limits<double>::infinity());
}

TextureDoubt texture_doubt(const PlacedDraw& placed, std::uint32_t element, const ElementSurface& s,
                           const ElementError& error, std::size_t slot, const QuadBarycentrics& b,
                           const DeviceLimits& limits, ivec2 pixel) {
  TextureDoubt doubt;
  doubt.place = texture_place(s, slot, b);
  const TextureUse& use = texture_use(*s.material, slot);
  const std::array<dvec2, 3> raw = raw_uvs(placed, element, use);
  const dvec2 raw_here = interpolate(raw, b.here);
  const dvec2 magnitude =
      spread(use.texture_from_uv, glm::abs(raw_here)) + glm::abs(dvec2(use.texture_from_uv[2]));
  dvec2 here, dx, dy;
  for (int c = 0; c < 2; ++c) {
    const auto values = component(raw, c);
    here[c] = error.varying(values, pixel.x, pixel.y);
    dx[c] = error.difference(values, pixel.x, pixel.y, {int(b.right), 0});
    dy[c] = error.difference(values, pixel.x, pixel.y, {0, int(b.down)});
  }
  // Two products and two sums in the transform; times the size and minus a half in the sampler.
  doubt.uv_error = spread(use.texture_from_uv, here) + magnitude * (8 * half_ulp);
  const Grid<u8vec4>& image = (*s.textures)[slot].levels[0];
  const dvec2 size{double(image.width()), double(image.height())};
  const dvec2 twice = magnitude * (8 * half_ulp);
  doubt.dx_error = spread(use.texture_from_uv, dx) + twice;
  doubt.dy_error = spread(use.texture_from_uv, dy) + twice;
  bound_lambda(doubt, size, limits);
  return doubt;
}

/// A decoded texel's error, seen through the filter. In a shader it is that of
/// x^2.4 = exp2(2.4 log2 x) on [0.04, 1]: 2.4 ln 2 (3 ulp of 4.6 + 2^-21) and 3 + 2 * 11 ulp of the
/// result, less than 2^-16 of it in all. In a sampler it is an error of the code; the slope of the
/// sRGB curve is concave in the linear value, so at the filtered value it is at least the mean of
/// the texels' slopes.
double decode_error(double linear, const DeviceLimits& limits) {
  const double v = std::clamp(linear, 0.0, 1.0);
  if (!limits.sampler) return v * 0x1p-16;
  const double slope = std::max(1 / 12.92, 2.4 / 1.055 * std::pow(v, 1.4 / 2.4));
  return slope * limits.sampler->srgb_decode_codes / 255.0;
}

struct BoundedLookup {
  dvec4 value{0.0};
  dvec4 bound{0.0};
  bool in_doubt = false;
};

/// Size of a texel of the coarsest level that is read, in texture lengths.
dvec2 texel_size(const MippedTexture& t, double lambda) {
  double level = 0;
  if (t.sampler.mip && lambda > 0)
    level = std::clamp(std::floor(lambda) + 1, 0.0, double(t.levels.size()) - 1);
  const Grid<u8vec4>& image = t.levels[std::size_t(level)];
  return {1.0 / image.width(), 1.0 / image.height()};
}

/// What the anisotropic filter of shaders may answer: continuous in place and derivatives, whose
/// own errors are joined by that of float arithmetic on the ellipse, as if each derivative were off
/// by 2^-19 of the longer one.
BoundedLookup average_over_ellipse(const ElementSurface& surface, std::size_t slot,
                                   const TextureDoubt& doubt) {
  const MippedTexture& texture = (*surface.textures)[slot];
  const Footprint here = doubt.place.footprint();
  BoundedLookup result;
  result.value = sample(texture, here).value;
  const dvec2 size{double(texture.levels[0].width()), double(texture.levels[0].height())};
  const dvec2 rounding =
      0x1p-19 * std::max(glm::length(here.dx * size), glm::length(here.dy * size)) / size;
  const auto move = [&](dvec2 Footprint::*part, dvec2 error) {
    for (int axis = 0; axis < 2; ++axis) {
      Footprint up = here, down = here;
      (up.*part)[axis] += error[axis];
      (down.*part)[axis] -= error[axis];
      result.bound += glm::max(glm::abs(sample(texture, up).value - result.value),
                               glm::abs(sample(texture, down).value - result.value));
    }
  };
  move(&Footprint::uv, doubt.uv_error);
  move(&Footprint::dx, doubt.dx_error + rounding);
  move(&Footprint::dy, doubt.dy_error + rounding);
  for (const MaterialTextures* rounded : {surface.textures_less, surface.textures_more})
    result.bound += glm::abs(sample((*rounded)[slot], here).value - result.value);
  // Two running sums over the texels, each product of a weight and a decoded texel; the quotient.
  const int texels = texels_read(texture, here, anisotropic_level_bias);
  result.bound += glm::abs(result.value) * ((2 * texels + 16) * half_ulp);
  return result;
}

BoundedLookup lookup(const ElementSurface& surface, std::size_t slot, const TextureDoubt& doubt,
                     const DeviceLimits& limits) {
  const MippedTexture& texture = (*surface.textures)[slot];
  const dvec2 uv = doubt.place.uv;
  const double lambda = doubt.place.lambda;
  if (is_anisotropic(texture.sampler)) {
    BoundedLookup result = average_over_ellipse(surface, slot, doubt);
    for (int c = 0; c < 3 && texture.srgb; ++c)
      result.bound[c] += decode_error(result.value[c], limits);
    return result;
  }
  const TextureLookup center = sample(texture, uv, lambda);
  BoundedLookup result;
  result.value = center.value;
  const auto move = [&](dvec2 to, double level) {
    const TextureLookup moved = sample(texture, to, level);
    if (moved.choices != center.choices && moved.value != center.value) result.in_doubt = true;
    return glm::abs(moved.value - center.value);
  };
  const bool filters =
      texture.sampler.mag == Filter::linear || texture.sampler.min == Filter::linear;
  const dvec2 weight_step =
      limits.sampler ? texel_size(texture, lambda) * std::exp2(-limits.sampler->sub_texel_bits)
                     : dvec2(0.0);
  for (int axis = 0; axis < 2; ++axis) {
    // A sampler's weights are coarse; where texels are chosen, not mixed, only coordinates count.
    dvec2 step{0.0};
    step[axis] = doubt.uv_error[axis];
    dvec4 change = glm::max(move(uv + step, lambda), move(uv - step, lambda));
    if (limits.sampler && filters && center.choices == 0) {
      step[axis] += weight_step[axis];
      change = glm::max(change, glm::max(move(uv + step, lambda), move(uv - step, lambda)));
    }
    result.bound += change;
  }
  result.bound += glm::max(move(uv, doubt.lambda_low), move(uv, doubt.lambda_high));
  // Texels of mip levels that a device may round otherwise.
  for (const MaterialTextures* rounded : {surface.textures_less, surface.textures_more})
    result.bound += glm::abs(sample((*rounded)[slot], uv, lambda).value - center.value);
  // Seven products and sums a level, two levels; decoding.
  result.bound += glm::abs(result.value) * (16 * half_ulp);
  if (texture.srgb)
    for (int c = 0; c < 3; ++c) result.bound[c] += decode_error(result.value[c], limits);
  return result;
}

/// All inputs of the shading with their errors.
struct BoundedPoint {
  ShadingPoint<double> point;
  Inputs error{};
  std::array<Interval, most_shadows> visible;
  bool in_doubt = false;
};

BoundedPoint bounded_point(const PlacedDraw& placed, std::uint32_t element, const ElementSurface& s,
                           const ElementError& error, const DeviceLimits& limits, const dvec3& eye,
                           ivec2 pixel, bool back) {
  BoundedPoint p;
  p.point = shading_point(s, pixel.x, pixel.y, back);
  p.error = varying_errors(placed, element, s, error, eye, pixel.x, pixel.y);
  const QuadBarycentrics b = quad_barycentrics(s.planes, pixel.x, pixel.y);
  for (std::size_t slot = 0; slot < slot_count; ++slot) {
    const MippedTexture& texture = (*s.textures)[slot];
    if (texture.levels.empty() || (s.material->unlit && slot != slot_base_color)) continue;
    const TextureDoubt doubt = texture_doubt(placed, element, s, error, slot, b, limits, pixel);
    const BoundedLookup read = lookup(s, slot, doubt, limits);
    set_texture_inputs(p.error, slot, read.bound);
    p.in_doubt |= read.in_doubt;
  }
  return p;
}

/// What maps hide, and what they may hide where the point is not quite there.
void bound_shadows(BoundedPoint& p, const ShadingScene& scene) {
  p.visible.fill(Interval(1.0));
  for (std::size_t i = 0; scene.shadows != nullptr && i < scene.shadows->size(); ++i) {
    const LightShadow& shadow = (*scene.shadows)[i];
    ShadowQuery query = shadow_query(p.point, scene);
    double normal = 0, normal_error = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      query.position_error[int(c)] = p.error[shading_input::position + c];
      normal = std::hypot(normal, p.point.inputs[shading_input::normal + c]);
      normal_error = std::hypot(normal_error, p.error[shading_input::normal + c]);
    }
    query.normal_error = normal > normal_error ? 2 * normal_error / normal + 8 * half_ulp : 2;
    const Visibility seen = visibility(shadow, query);
    p.point.visible[i] = seen.value;
    // The sum of the filter's weighted texels in float, over their number.
    const double sum = (2.0 * shadow.radius + 2) * (2 * shadow.radius + 2) + 4;
    p.visible[i] = {std::max(seen.low - sum * half_ulp, 0.0), seen.high + sum * half_ulp};
  }
}

dvec4 as_vector(const Shaded<double>& s) { return {s.rgb[0], s.rgb[1], s.rgb[2], s.alpha}; }

/// Which way each input moves each channel.
using Slopes = std::array<dvec4, shading_input::count>;

/// Sum over the inputs of the larger change when one is moved up or down by its error.
dvec4 moved_inputs(const BoundedPoint& p, const Material& material, const ShadingScene& scene,
                   const dvec4& value, Slopes& slopes) {
  dvec4 sum{0.0};
  ShadingPoint<double> moved = p.point;
  for (std::size_t i = 0; i < shading_input::count; ++i) {
    if (p.error[i] == 0) continue;
    moved.inputs[i] = p.point.inputs[i] + p.error[i];
    const dvec4 up = as_vector(shade(material, scene, moved)) - value;
    moved.inputs[i] = p.point.inputs[i] - p.error[i];
    const dvec4 down = as_vector(shade(material, scene, moved)) - value;
    moved.inputs[i] = p.point.inputs[i];
    slopes[i] = up - down;
    for (int c = 0; c < 4; ++c) {
      const double change = std::max(std::abs(up[c]), std::abs(down[c]));
      sum[c] += std::isnan(change) ? std::numeric_limits<double>::infinity() : change;
    }
  }
  return sum;
}

/// What float arithmetic on exact inputs may make of the shading.
dvec4 arithmetic(const ShadingPoint<double>& point,
                 const std::array<Interval, most_shadows>& visible, const Material& material,
                 const ShadingScene& scene, const dvec4& value) {
  ShadingPoint<Interval> exact;
  exact.visible = visible;
  for (std::size_t i = 0; i < shading_input::count; ++i) exact.inputs[i] = point.inputs[i];
  exact.back = point.back;
  exact.openness = point.openness;
  exact.scale = point.scale;
  const Shaded<Interval> range = shade(material, scene, exact);
  return {deviation(range.rgb[0], value.x), deviation(range.rgb[1], value.y),
          deviation(range.rgb[2], value.z), deviation(range.alpha, value.w)};
}

/// How far arithmetic on all inputs together is from the value, each moved by its error to the side
/// that raises (or lowers) a channel: where slopes grow, or a table's cells meet, that is more than
/// one by one.
dvec4 moved_together(const BoundedPoint& p, const Material& material, const ShadingScene& scene,
                     const dvec4& value, const Slopes& slopes) {
  dvec4 largest{0.0};
  for (int c = 0; c < 3; ++c)
    for (const double side : {1.0, -1.0}) {
      ShadingPoint<double> moved = p.point;
      for (std::size_t i = 0; i < shading_input::count; ++i)
        moved.inputs[i] += slopes[i][c] < 0 ? -side * p.error[i] : side * p.error[i];
      largest[c] = std::max(largest[c], arithmetic(moved, p.visible, material, scene, value)[c]);
    }
  return largest;
}

BoundedColor line_or_point(const PlacedDraw&, std::uint32_t, const ElementSurface& s,
                           const ElementError& error, int x, int y) {
  BoundedColor color;
  const dvec4 base{s.material->base_color};
  color.value = interpolate(s.color, barycentric(s.planes, x + 0.5, y + 0.5)) * base;
  for (int c = 0; c < 4; ++c)
    color.bound[c] = error.varying(component(s.color, c), x, y) * std::abs(base[c]) +
                     2 * half_ulp * std::abs(color.value[c]);
  return color;
}

}  // namespace

BoundedColor shade_with_bound(const PlacedDraw& draw, std::uint32_t element,
                              const ElementSurface& s, const ElementError& error,
                              const ShadingScene& scene, const DeviceLimits& limits, int x, int y,
                              bool back) {
  if (s.topology != Topology::triangles) return line_or_point(draw, element, s, error, x, y);
  BoundedPoint p = bounded_point(draw, element, s, error, limits, scene.eye, {x, y}, back);
  if (!s.material->unlit) bound_shadows(p, scene);
  p.point.openness = openness_at(scene, *s.material, x, y);
  BoundedColor color;
  color.value = as_vector(shade(*s.material, scene, p.point));
  Slopes slopes{};
  color.bound = moved_inputs(p, *s.material, scene, color.value, slopes) +
                arithmetic(p.point, p.visible, *s.material, scene, color.value);
  if (!s.material->unlit)
    color.bound = glm::max(color.bound, moved_together(p, *s.material, scene, color.value, slopes));
  color.in_doubt = p.in_doubt;
  return color;
}

BoundedColor alpha_with_bound(const PlacedDraw& draw, std::uint32_t element,
                              const ElementSurface& s, const ElementError& error,
                              const DeviceLimits& limits, int x, int y) {
  const double factor = s.material->base_color.w;
  const QuadBarycentrics b = quad_barycentrics(s.planes, x, y);
  const double vertex = interpolate(s.color, b.here).w;
  const double vertex_error =
      draw.primitive->colors.empty() ? 0.0 : error.varying(component(s.color, 3), x, y);
  BoundedColor alpha;
  double texel = 1, texel_error = 0;
  const MippedTexture& texture = (*s.textures)[slot_base_color];
  if (!texture.levels.empty()) {
    const BoundedLookup read =
        lookup(s, slot_base_color,
               texture_doubt(draw, element, s, error, slot_base_color, b, limits, {x, y}), limits);
    texel = read.value.w;
    texel_error = read.bound.w;
    alpha.in_doubt = read.in_doubt;
  }
  alpha.value.w = factor * vertex * texel;
  alpha.bound.w =
      factor * (vertex_error * texel + (std::abs(vertex) + vertex_error) * texel_error) +
      3 * half_ulp * std::abs(alpha.value.w);
  return alpha;
}

}  // namespace parity::cpu
