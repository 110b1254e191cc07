#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// Part of white light from everywhere that a rough surface sends to the eye, 16 x 16, as both sides
/// compute it (cpu::albedo_table and gpu::albedo_table with 64^2 samples an entry), to five digits: so
/// that no renderer has to wait for it. A test holds it to what they compute.
///
/// Rows are roughness i / 15, at least 1/64; columns the cosine c at which
/// (c (1 + alpha) / (c + alpha))^(1/2) = j / 15. x is what comes back from a white surface (GGX, one
/// bounce); Schlick's (1 - cosine)^5 is on the mean that of the cosine c + y, which is a line between
/// columns where the weight itself is far from one; z is the root of 1 less the mean of x over the
/// cosine-weighted hemisphere: of what one bounce loses, which is no line between rows; w is the
/// albedo of a white Charlie sheen at the cosine (j / 15)^2.
///
/// Source: Karis 2013; Kulla & Conty 2017; Estevez & Kulla 2017.
const Grid<vec4>& albedo_table();

}  // namespace parity
