#include "cpu_reference/texture/projection.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace parity::cpu {
namespace {

constexpr double pi = std::numbers::pi;

/// What grows to the right and downwards on a face, and what points out of it.
struct FaceAxes {
  dvec3 right, down, out;
};

const std::array<FaceAxes, 6> faces{{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                     {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                     {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                     {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                     {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                     {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

/// The face whose axis is nearest; of equal ones z before y before x.
int face_of(dvec3 d) {
  int best = 4;
  for (const int face : {4, 5, 2, 3, 0, 1})
    if (glm::dot(faces[std::size_t(face)].out, d) > glm::dot(faces[std::size_t(best)].out, d))
      best = face;
  return best;
}

double turn(dvec3 p) { return 0.5 + std::atan2(p.x, -p.z) / (2 * pi); }

}  // namespace

TexturePoint project(Projection projection, dvec3 p) {
  switch (projection) {
    case Projection::planar:
      return {{(1 + p.x) / 2, (1 - p.y) / 2}, 0};
    case Projection::cylindrical:
      return {{turn(p), (1 - p.y) / 2}, 0};
    case Projection::spherical:
      return {{turn(p), std::acos(p.y / glm::length(p)) / pi}, 0};
    case Projection::cubic: {
      const int face = face_of(p);
      const FaceAxes& axes = faces[std::size_t(face)];
      const double depth = glm::dot(axes.out, p);
      return {{(1 + glm::dot(axes.right, p) / depth) / 2, (1 + glm::dot(axes.down, p) / depth) / 2},
              face};
    }
  }
  throw std::invalid_argument("cpu::project: unknown projection");
}

dvec3 direction_of(Projection projection, TexturePoint place) {
  if (projection == Projection::spherical) {
    const double around = (place.uv.x - 0.5) * 2 * pi, down = place.uv.y * pi;
    return {std::sin(down) * std::sin(around), std::cos(down), -std::sin(down) * std::cos(around)};
  }
  if (projection != Projection::cubic)
    throw std::invalid_argument("cpu::direction_of: the projection is not one of directions");
  const FaceAxes& axes = faces.at(std::size_t(place.face));
  const dvec2 on_face = place.uv * 2.0 - 1.0;
  return glm::normalize(axes.out + axes.right * on_face.x + axes.down * on_face.y);
}

dvec3 triplanar_weights(dvec3 normal) {
  const dvec3 squares = normal * normal;
  const dvec3 fourth = squares * squares;
  return fourth / (fourth.x + fourth.y + fourth.z);
}

}  // namespace parity::cpu
