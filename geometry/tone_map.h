#pragma once

namespace parity {

/// How light becomes what a screen shows, both linear in Rec. 709 primaries.
enum class ToneMap {
  clamp,    ///< nothing but the limits of the screen
  neutral,  ///< Khronos PBR Neutral: base colours under grey light stay, highlights are compressed
  aces,     ///< Hill's fit of the ACES reference and output transforms
  agx       ///< Sobotka's AgX, in Wrensch's fit
};

}  // namespace parity
