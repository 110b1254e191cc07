// The ellipse that a pixel's disc becomes in a texture. Source: notes 6.3; Heckbert 1989.
#ifndef PARITY_TEXTURE_ANISOTROPIC_GLSL
#define PARITY_TEXTURE_ANISOTROPIC_GLSL

struct Ellipse {
  float major2;  // squares of the half axes, texels
  float minor2;  // at least major2 over the square of the largest ratio
  vec2 axis;     // of the major one, unit
};

// The squares are the eigenvalues of J J^T, where J has columns dx and dy. The larger is a sum of
// positive numbers; the smaller follows from the determinant, so that neither loses digits.
Ellipse footprint_ellipse(vec2 dx, vec2 dy, float max_anisotropy) {
  const float p = dx.x * dx.x + dy.x * dy.x;
  const float r = dx.y * dx.y + dy.y * dy.y;
  const float q = dx.x * dx.y + dy.x * dy.y;
  const float determinant = dx.x * dy.y - dx.y * dy.x;
  const float half_difference = 0.5 * (p - r);
  const float root = sqrt(half_difference * half_difference + q * q);
  const float major2 = 0.5 * (p + r) + root;
  const float minor2 = major2 > 0.0 ? determinant * (determinant / major2) : 0.0;
  const vec2 along = half_difference > 0.0 ? vec2(half_difference + root, q)
                                           : vec2(q, root - half_difference);
  const float squared = dot(along, along);
  return Ellipse(major2, max(minor2, major2 / (max_anisotropy * max_anisotropy)),
                 squared > 0.0 ? along / sqrt(squared) : vec2(1.0, 0.0));
}

// The ellipse with the texel's own disc; no half axis is longer than 32 texels, so that loops end.
Ellipse with_texel(Ellipse e) {
  e.major2 = min(e.major2 + 0.6, 1024.0);
  e.minor2 = min(e.minor2 + 0.6, 1024.0);
  return e;
}

// (1 - r^2)^2 at r of the ellipse's radius, 0 outside.
float ellipse_weight(Ellipse e, vec2 d) {
  const float along = dot(d, e.axis);
  const float across = d.y * e.axis.x - d.x * e.axis.y;
  const float rest = max(1.0 - along * along / e.major2 - across * across / e.minor2, 0.0);
  return rest * rest;
}

// Rows and columns that an ellipse reaches.
struct EllipseRows {
  float height;     // half of it
  float slope;      // of the middle of the columns, per row
  float half_width; // of the columns: times sqrt(height^2 - dy^2)
};

EllipseRows ellipse_rows(Ellipse e) {
  const vec2 axis2 = e.axis * e.axis;
  const float r = e.major2 * axis2.y + e.minor2 * axis2.x;
  return EllipseRows(sqrt(r), (e.major2 - e.minor2) * e.axis.x * e.axis.y / r,
                     sqrt(e.major2 * e.minor2) / r);
}
#endif
