#version 460
#include "fluid/draw_volume.glsl"

// How much of the sun and of the sky comes to the centres of one layer of cells, from the layer
// above (short characteristics): what comes to the point above, between its four cells, less what is
// taken on the way. One thread a cell of the layer, layers from the top down. The sky counts from
// straight above twice and from 45 degrees on four sides. Source: Kunasz & Auer 1988.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DrawLightArgs args; };

const vec3 sky_directions[5] = vec3[](vec3(0, 1, 0), vec3(1, 1, 0), vec3(-1, 1, 0), vec3(0, 1, 1),
                                      vec3(0, 1, -1));

/// (light, value) of a cell of the layer above; all light and nothing in the way outside.
vec2 above(uint direction, ivec2 cell) {
  REF(DrawScene) s = args.scene;
  const ivec3 n = s.at[0].volume_size;
  if (int(args.row) + 1 >= n.y || any(lessThan(cell, ivec2(0))) ||
      any(greaterThanEqual(cell, n.xz)))
    return vec2(1.0, 0.0);
  const uint i = uint((cell.y * n.y + int(args.row) + 1) * n.x + cell.x);
  return vec2(args.above.at[direction * uint(n.x * n.z) + uint(cell.y * n.x + cell.x)],
              s.at[0].values.at[i]);
}

/// What part of the light comes down along a direction whose y is 1.
float light_from(uint direction, vec3 along, ivec2 cell, float value) {
  const vec2 at = vec2(cell) + along.xz, low = floor(at), part = at - low;
  const ivec2 c = ivec2(low);
  const vec2 upper = mix(mix(above(direction, c), above(direction, c + ivec2(1, 0)), part.x),
                         mix(above(direction, c + ivec2(0, 1)), above(direction, c + 1), part.x),
                         part.y);
  const float way = args.scene.at[0].cell * length(along);
  return upper.x * exp(-0.5 * way * (value + upper.y));
}

void main() {
  REF(DrawScene) s = args.scene;
  const ivec3 n = s.at[0].volume_size;
  const uint i = gl_GlobalInvocationID.x, count = uint(n.x * n.z);
  if (i >= count) return;
  const ivec2 cell = ivec2(int(i) % n.x, int(i) / n.x);
  const uint index = uint((cell.y * n.y + int(args.row)) * n.x + cell.x);
  const float value = s.at[0].values.at[index];
  const float sun = light_from(0u, s.at[0].sun / s.at[0].sun.y, cell, value);
  args.here.at[i] = sun;
  float sky = 0.0;
  for (uint d = 0u; d < 5u; ++d) {
    const float light = light_from(d + 1u, sky_directions[d], cell, value);
    args.here.at[(d + 1u) * count + i] = light;
    sky += d == 0u ? 2.0 * light : light;
  }
  const vec3 point = s.at[0].volume_origin +
                     s.at[0].cell * (vec3(cell.x, args.row, cell.y) + 0.5);
  s.at[0].cells.at[index] = DrawCell(value, sun, sky / 6.0, draw_solids_sun(s, point));
}
