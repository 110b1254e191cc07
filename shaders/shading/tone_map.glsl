// From light of any strength to 0..1, both linear with Rec. 709 primaries.
#ifndef PARITY_SHADING_TONE_MAP_GLSL
#define PARITY_SHADING_TONE_MAP_GLSL

// Source: Khronos PBR Neutral Tone Mapper (specification, 2024).
vec3 tone_map_neutral(vec3 c) {
  const float start = 0.76;  // compression begins; 0.04 of it is what dielectrics reflect
  const float low = min(c.r, min(c.g, c.b));
  c -= low < 0.08 ? low * (1.0 - 6.25 * low) : 0.04;
  const float peak = max(c.r, max(c.g, c.b));
  if (peak < start) return c;
  const float room = 1.0 - start;
  const float compressed = 1.0 - room * room / (peak + room - start);
  const float gray = 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0);
  return mix(c * (compressed / peak), vec3(compressed), gray);
}

// Source: Hill 2016, "ACES Fitted".
vec3 tone_map_aces(vec3 c) {
  const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const mat3 back = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605,
                         1.07602);
  const vec3 v = into * c;
  return back * ((v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
}

// Source: Sobotka 2022, "AgX"; Wrensch 2023, "Minimal AgX Implementation" (matrices, polynomial).
vec3 tone_map_agx(vec3 c) {
  const mat3 into = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                         0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434,
                         0.879142973793104);
  const mat3 back = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
                         1.15190312990417, -0.0980434501171241, -0.0990297440797205,
                         -0.0989611768448433, 1.15107367264116);
  const float least = -12.47393;
  const float most = 4.026069;
  const vec3 x = (clamp(log2(max(into * c, vec3(1e-10))), least, most) - least) / (most - least);
  const vec3 curve =
      ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
  return pow(max(back * curve, vec3(0.0)), vec3(2.2));
}

// NaN becomes 0.
vec3 tone_map(vec3 c, uint operator) {
  c = vec3(c.r > 0.0 ? c.r : 0.0, c.g > 0.0 ? c.g : 0.0, c.b > 0.0 ? c.b : 0.0);
  c = min(c, vec3(1e8));
  if (operator == 1u) c = tone_map_neutral(c);
  if (operator == 2u) c = tone_map_aces(c);
  if (operator == 3u) c = tone_map_agx(c);
  return clamp(c, 0.0, 1.0);
}
#endif
