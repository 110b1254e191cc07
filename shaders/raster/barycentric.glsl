// Where a pixel meets a triangle, from clip positions alone: no clipping, no division by a corner's
// w. Source: notes 1.3, 1.6; Olano & Greer 1997.
#ifndef PARITY_RASTER_BARYCENTRIC_GLSL
#define PARITY_RASTER_BARYCENTRIC_GLSL

/// a.x b.y - a.y b.x
float cross_product(vec2 a, vec2 b) {
  precise float product = a.x * b.y - a.y * b.x;
  return product;
}

/// Perspective-correct barycentric coordinates of the point of the triangle's plane that is seen at
/// `ndc`. Seen from the pixel the corners are (x - ndc w), which keeps small triangles accurate: the
/// error is that of moving each corner by 2^-23 of the window.
vec3 perspective_barycentric(vec4 a, vec4 b, vec4 c, vec2 ndc) {
  precise vec2 pa = a.xy - ndc * a.w, pb = b.xy - ndc * b.w, pc = c.xy - ndc * c.w;
  const vec3 areas = vec3(cross_product(pb, pc), cross_product(pc, pa), cross_product(pa, pb));
  precise float sum = areas.x + areas.y + areas.z;
  precise vec3 weights = areas / sum;
  return weights;
}

/// Barycentric coordinates in the window (noperspective): perspective ones times w, scaled to 1.
vec3 linear_barycentric(vec3 perspective, vec4 a, vec4 b, vec4 c) {
  precise vec3 scaled = perspective * vec3(a.w, b.w, c.w);
  precise float sum = scaled.x + scaled.y + scaled.z;
  precise vec3 weights = scaled / sum;
  return weights;
}

#endif
