#include "geometry/texture_footprint.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/raster.h"

namespace parity {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double snapped = 1.0 / 256;  ///< px: devices place vertices on such a grid
constexpr double beside = 0.5;      ///< px from a shaded place to a covered sample, in x and in y
constexpr double most_pixels = 64;  ///< that are looked at one by one, a triangle

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

double greatest_singular_value(const dmat2& m) {
  const double sum = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]);
  const double determinant = glm::determinant(m);
  return std::sqrt((sum + std::sqrt(std::max(sum * sum - 4 * determinant * determinant, 0.0))) / 2);
}

/// Keeps what is on the inner side of a plane.
void cut(std::vector<dvec3>& polygon, const dvec3& plane, double offset) {
  std::vector<dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(plane, a) - offset, db = glm::dot(plane, b) - offset;
    if (!(da < 0)) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  polygon = std::move(kept);
}

/// The pixels in which a convex polygon may cover a sample; none: too many to look at.
std::optional<std::vector<dvec2>> pixels_of(const ShadingView& view,
                                            const std::vector<dvec2>& polygon, double way_round) {
  constexpr double near = 0.75 * snapped;
  dvec2 low{infinity}, high{-infinity};
  for (const dvec2& p : polygon) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const dvec2 first = glm::max(glm::floor(low - near), dvec2(0.0));
  const dvec2 last = glm::min(glm::floor(high + near), view.size - 1.0);
  const dvec2 count = glm::max(last - first + 1.0, dvec2(0.0));
  if (!(count.x * count.y <= most_pixels)) return std::nullopt;
  const auto touches = [&](const dvec2& p) {
    if (glm::any(glm::lessThan(p, low - near)) || glm::any(glm::greaterThan(p, high + near)))
      return false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const dvec2 &a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
      if (cross(edge, p - a) * way_round < -near * glm::length(edge)) return false;
    }
    return true;
  };
  std::vector<dvec2> centers;
  for (double y = first.y; y <= last.y; ++y)
    for (double x = first.x; x <= last.x; ++x)
      if (std::ranges::any_of(view.samples,
                              [&](const dvec2& sample) { return touches(dvec2(x, y) + sample); }))
        centers.emplace_back(x + 0.5, y + 0.5);
  return centers;
}

/// Fills what follows from the corners and what of the triangle is within the view.
void measure(const ShadingView& view, ShadedPlaces& piece, const std::vector<dvec3>& outline) {
  const dmat3& c = piece.corners;
  std::vector<dvec2> polygon;
  for (const dvec3& p : outline) polygon.push_back(dvec2(p) / p.z);
  double twice_area = 0, length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec2& next = polygon[(i + 1) % polygon.size()];
    twice_area += cross(polygon[i] - polygon[0], next - polygon[0]);
    length += glm::length(next - polygon[i]);
  }
  piece.determinant = glm::determinant(c);
  piece.slack = 2 * snapped * length / std::abs(twice_area);
  const double grow = 1 / (1 - std::min(piece.slack, 0.5));
  // 1 / w is linear in the window.
  const dvec3 inverse = (glm::cross(c[1], c[2]) + glm::cross(c[2], c[0]) + glm::cross(c[0], c[1])) /
                        piece.determinant;
  const dvec2 gradient = grow * glm::abs(dvec2(inverse));
  piece.step = std::max(gradient.x, gradient.y);
  piece.reach = view.samples.size() > 1 ? beside + snapped : snapped;
  double least = infinity, most = 0;
  for (const dvec3& p : outline) {
    least = std::min(least, 1 / p.z);
    most = std::max(most, 1 / p.z);
  }
  if (!view.moves)
    if (auto pixels = pixels_of(view, polygon, twice_area < 0 ? -1 : 1)) {
      polygon = std::move(*pixels);
      piece.reach = snapped;
      if (view.samples.size() > 1) {
        least = infinity, most = 0;
        for (const dvec2& p : polygon) {
          const double here = glm::dot(inverse, dvec3(p, 1));
          least = std::min(least, here);
          most = std::max(most, std::abs(here));
        }
      }
    }
  piece.least = least - piece.reach * (gradient.x + gradient.y);
  piece.most = most + piece.reach * (gradient.x + gradient.y);
  piece.places = std::move(polygon);
}

/// Least change of a texture over a metre of a triangle.
double least_density(const ShadedPlaces& piece, const std::array<dvec2, 3>& uv) {
  const dvec3 e1 = piece.world[1] - piece.world[0], e2 = piece.world[2] - piece.world[0];
  const double length = glm::length(e1);
  const dvec3 along = e1 / length;
  const double x = glm::dot(e2, along), y = glm::length(e2 - x * along);
  const dvec2 u = (uv[1] - uv[0]) / length;
  const dvec2 v = (uv[2] - uv[0] - x * u) / y;
  const double density = std::abs(cross(u, v)) / greatest_singular_value({u, v});
  return y > 1e-9 * length ? density : 0;
}

/// How a triangle lies in a texture. A way in it is a sum c of its edges from corner 0.
class Ways {
 public:
  Ways(const ShadingView& view, const ShadedPlaces& piece, const std::array<dvec2, 3>& uv)
      : piece_(piece),
        shortest_(least_density(piece, uv) * view.apart / piece.most),
        texels_(uv[1] - uv[0], uv[2] - uv[0]),
        shift_(dvec2(piece.corners[1] - piece.corners[0]),
               dvec2(piece.corners[2] - piece.corners[0])),
        w_(piece.corners[1].z - piece.corners[0].z, piece.corners[2].z - piece.corners[0].z),
        far_(std::max({std::abs(piece.corners[0].z), std::abs(piece.corners[1].z),
                       std::abs(piece.corners[2].z)})) {}

  FootprintBounds bounds() const {
    FootprintBounds f;
    for (const dvec2& way : {dvec2(1, 0), dvec2(0, 1), dvec2(1, -1)})
      f.major = std::max(f.major, length_along(way));
    const dmat2 edges = inverse(texels_);
    if (std::isfinite(edges[0].x + edges[0].y + edges[1].x + edges[1].y)) {
      const dmat2 across = at(piece_.places[0]) * edges;
      const double turn =
          0.5 * std::atan2(2 * glm::dot(across[0], across[1]),
                           glm::dot(across[0], across[0]) - glm::dot(across[1], across[1]));
      f.major = std::max(f.major, length_along(edges * dvec2(-std::sin(turn), std::cos(turn))));
      f.minor = 1 / (longest_of(edges) * nearness());
      f.major = std::max(f.major, f.minor);
    }
    if (shortest_ > 0) f.shortest = shortest_;
    f.major = std::max(f.major, f.shortest);
    bound_above(f);
    return f;
  }

 private:
  dmat2 at(const dvec2& p) const { return shift_ - glm::outerProduct(p, w_); }
  double nearness() const { return piece_.most + piece_.step; }

  /// Of a difference of the texture, at least, somewhere in a pixel.
  double length_along(const dvec2& way) const {
    double window = 0;
    for (const dvec2& p : piece_.places) window = std::max(window, glm::length(at(p) * way));
    window += std::numbers::sqrt2 * piece_.reach * std::abs(glm::dot(w_, way)) +
              snapped * far_ * (std::abs(way.x) + std::abs(way.y) + std::abs(way.x + way.y));
    const double length = glm::length(texels_ * way) / (window * nearness());
    return length > 0 ? length : 0;
  }

  /// Of F times a matrix, at most.
  double longest_of(const dmat2& m) const {
    double window = 0;
    for (const dvec2& p : piece_.places)
      window = std::max(window, greatest_singular_value(at(p) * m));
    return window + std::numbers::sqrt2 * piece_.reach * glm::length(w_ * m) +
           2 * snapped * far_ * greatest_singular_value(m);
  }

  void bound_above(FootprintBounds& f) const {
    const double least = piece_.least - piece_.step;
    if (!(piece_.slack < 0.25) || !(least > 0.25 * piece_.most)) return;
    const double grow = 1 / (1 - piece_.slack);
    // F's inverse is its adjugate over the corners' determinant, times w.
    double longest = 0;
    for (const dvec2& p : piece_.places) {
      const dmat2 f_p = at(p);
      const dmat2 adjugate{f_p[1].y, -f_p[0].y, -f_p[1].x, f_p[0].x};
      longest = std::max(longest, greatest_singular_value(texels_ * adjugate));
    }
    longest +=
        std::numbers::sqrt2 * piece_.reach * glm::length(w_) * greatest_singular_value(texels_);
    const double volume = std::abs(piece_.determinant) * piece_.least * least / grow;
    f.longest = longest / volume;
    f.area = std::abs(glm::determinant(texels_)) * grow / (volume * least);
  }

  const ShadedPlaces& piece_;
  double shortest_;  ///< of a difference: rays a pixel apart meet the triangle that far apart
  dmat2 texels_;     ///< E
  dmat2 shift_;      ///< F at 0
  dvec2 w_;          ///< what F loses per px
  double far_ = 0;
};

}  // namespace

ShadingView::ShadingView(const Frame& of, bool may_move)
    : frame(of), moves(may_move), size(of.options.width, of.options.height) {
  for (const ivec2 place : standard_sample_places(of.options.samples))
    samples.push_back(dvec2(place) / 16.0);
  const dmat4& m = of.clip_from_view;
  const double x = 1 / std::abs(m[0][0]), y = 1 / std::abs(m[1][1]);
  apart = 1.98 * std::min(x / size.x, y / size.y);
  if (!of.orthographic) apart /= std::sqrt(1 + x * x + y * y);
}

ShadedPlaces shaded_places(const ShadingView& view, const Draw& draw, bool double_sided,
                           const std::vector<vec3>& positions, const std::uint32_t* vertices) {
  ShadedPlaces piece;
  std::vector<dvec3> outline;
  for (int i = 0; i < 3; ++i) {
    const dvec4 position{positions[vertices[i]], 1};
    const dvec4 p = dmat4(draw.clip_from_object) * position;
    piece.world[std::size_t(i)] = dvec3(draw.world_from_object * position);
    piece.corners[i] = {0.5 * view.size * (dvec2(p) + p.w), p.w};
    outline.push_back(piece.corners[i]);
  }
  const dmat3& c = piece.corners;
  if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return piece;
  constexpr double rim = 2;  // px
  if (!view.frame.orthographic) cut(outline, {0, 0, 1}, 0.99 * view.frame.near);
  cut(outline, {1, 0, rim}, 0);
  cut(outline, {-1, 0, view.size.x + rim}, 0);
  cut(outline, {0, 1, rim}, 0);
  cut(outline, {0, -1, view.size.y + rim}, 0);
  if (outline.empty()) return piece;
  measure(view, piece, outline);
  const bool is_back = (piece.determinant < 0) == draw.mirrored;
  if (is_back && !double_sided && piece.slack < 0.5) piece.places.clear();
  return piece;
}

FootprintBounds footprint_bounds(const ShadingView& view, const ShadedPlaces& triangle,
                                 const std::array<dvec2, 3>& uv) {
  return Ways(view, triangle, uv).bounds();
}

}  // namespace parity
