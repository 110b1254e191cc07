#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "gpu/core/context.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

/// Reflectances of bases under thin films. Mathematics: cpu::thin_film.
std::vector<vec3> thin_film(Context& context, std::span<const FilmQuery> queries);

}  // namespace parity::gpu
