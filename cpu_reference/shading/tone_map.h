#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/tone_map.h"

namespace parity::cpu {

/// Linear colour of the screen, 0..1, for light of any strength; negative numbers and NaN count as
/// 0.
///
/// Source: Khronos PBR Neutral Tone Mapper (specification, 2024); Hill 2016, "ACES Fitted"; Sobotka
/// 2022, "AgX", with the matrices and polynomial of Wrensch 2023, "Minimal AgX Implementation".
dvec3 tone_map(const dvec3& light, ToneMap tone_map);

/// Of a picture, after 2^exposure. Alpha stays.
Grid<vec4> tone_map(const Grid<vec4>& colors, ToneMap tone_map, float exposure);

}  // namespace parity::cpu
