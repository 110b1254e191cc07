#version 460
#include "texture/layout.h"

// Reads a texture through the device's own sampler at the level of detail and with the anisotropy
// that it takes from a 2x2 quad of pixels: one quad a footprint, row after row; the answer is in its
// first pixel. Drivers may filter anisotropically in this way only.
layout(set = 0, binding = 0) uniform sampler2D image;
layout(scalar, push_constant) uniform Push { HardwareSampleArgs args; };
layout(location = 0) out vec4 color;

void main() {
  const uvec2 pixel = uvec2(gl_FragCoord.xy);
  const uint i = min((pixel.y / 2u) * args.row + pixel.x / 2u, args.count - 1u);
  const TextureFootprint f = args.footprints.at[i];
  const vec2 place = vec2(pixel & 1u);
  color = texture(image, f.uv + place.x * f.uv_dx + place.y * f.uv_dy);
}
