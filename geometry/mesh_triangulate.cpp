#include "geometry/mesh_triangulate.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace parity {
namespace {

/// Twice the signed area of a, b, c; positive: counter-clockwise. Doubled coordinates of floats:
/// the differences are exact or rounded once, so a sign is wrong only for slivers.
double turn(dvec2 a, dvec2 b, dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The vector area of a polygon, doubled.
dvec3 newell_normal(std::span<const dvec3> p) {
  dvec3 normal{0.0};
  for (std::size_t i = 0; i < p.size(); ++i)
    normal += glm::cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
  return normal;
}

/// Cuts one polygon. Works on places along it; `next_` and `previous_` link what is left.
class EarClipper {
 public:
  EarClipper(const Mesh& mesh, std::uint32_t begin, std::uint32_t end, std::size_t& budget)
      : begin_(begin), count_(end - begin), budget_(budget) {
    std::vector<dvec3> p(count_);
    for (std::uint32_t i = 0; i < count_; ++i)
      p[i] = dvec3(mesh.positions[mesh.corners[begin + i]]);
    project(p);
  }

  void append_to(std::vector<CornerTriangle>& triangles) {
    if (is_convex())
      append_fan(triangles);
    else
      clip_ears(triangles);
  }

 private:
  /// Along the axis in which the polygon is widest seen; turned so that it runs counter-clockwise.
  void project(std::span<const dvec3> p) {
    const dvec3 normal = newell_normal(p);
    const dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const dvec3& point : p)
      points_.push_back(normal[axis] < 0.0 ? dvec2{point[v], point[u]} : dvec2{point[u], point[v]});
  }

  /// Never turns right, and turns once around.
  bool is_convex() const {
    int x_changes = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const dvec2 a = points_[i], b = points_[(i + 1) % count_], c = points_[(i + 2) % count_];
      if (turn(a, b, c) < 0.0) return false;
      if ((b.x < a.x) != (c.x < b.x)) ++x_changes;
    }
    return x_changes <= 2;
  }

  void append_fan(std::vector<CornerTriangle>& triangles) const {
    for (std::uint32_t i = 1; i + 1 < count_; ++i)
      triangles.push_back({begin_, begin_ + i, begin_ + i + 1});
  }

  void link() {
    next_.resize(count_);
    previous_.resize(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      next_[i] = (i + 1) % count_;
      previous_[i] = (i + count_ - 1) % count_;
    }
  }

  bool is_reflex(std::uint32_t i) const {
    return turn(points_[previous_[i]], points_[i], points_[next_[i]]) < 0.0;
  }

  /// A corner that turns left, with no reflex corner of the rest in its triangle. Corners at the
  /// same place as one of the triangle's (a slit that joins a hole) do not count.
  bool is_ear(std::uint32_t i) {
    const dvec2 a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
    if (turn(a, b, c) <= 0.0) return false;
    for (std::uint32_t j : reflex_) {
      if (budget_ > 0) --budget_;
      const dvec2 p = points_[j];
      if (is_cut_[j] || p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  void cut(std::uint32_t i, std::vector<CornerTriangle>& triangles) {
    triangles.push_back({begin_ + previous_[i], begin_ + i, begin_ + next_[i]});
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    is_cut_[i] = true;
  }

  void forget_corners_that_are_no_longer_reflex() {
    std::erase_if(reflex_, [&](std::uint32_t j) { return is_cut_[j] || !is_reflex(j); });
  }

  void clip_ears(std::vector<CornerTriangle>& triangles) {
    link();
    is_cut_.assign(count_, false);
    for (std::uint32_t i = 0; i < count_; ++i)
      if (is_reflex(i)) reflex_.push_back(i);
    std::uint32_t left = count_, place = 0, tried = 0;
    while (left > 3) {
      const bool gives_up = tried > left || budget_ == 0;
      if (gives_up || is_ear(place)) {
        cut(place, triangles);
        --left;
        tried = 0;
        if (!gives_up) forget_corners_that_are_no_longer_reflex();
      }
      ++tried;
      place = next_[place];
    }
    triangles.push_back({begin_ + previous_[place], begin_ + place, begin_ + next_[place]});
  }

  std::uint32_t begin_;
  std::uint32_t count_;
  std::size_t& budget_;
  std::vector<dvec2> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> reflex_;
  std::vector<bool> is_cut_;
};

}  // namespace

std::vector<CornerTriangle> triangulate(const Mesh& mesh) {
  std::vector<CornerTriangle> triangles;
  triangles.reserve(mesh.corners.size() - 2 * mesh.face_count());
  std::size_t budget = std::size_t(1) << 28;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    if (end - begin == 3)
      triangles.push_back({begin, begin + 1, begin + 2});
    else
      EarClipper(mesh, begin, end, budget).append_to(triangles);
  }
  return triangles;
}

}  // namespace parity
