#version 460
#include "shading/layout.h"
#include "shading/thin_film.glsl"

// Reflectance of a base under a thin film; one thread a query. Source: Belcour & Barla 2017.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FilmArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const FilmQuery q = args.queries.at[i];
  args.reflectances.at[i] = thin_film(q.index, q.thickness, q.cosine, q.base);
}
