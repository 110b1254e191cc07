// Radial kernels W(r) with support H and their gradients, gradient = kernel_slope * d. 1 / H and the
// normalisation come with the constants. Sources: notes 10.4; Monaghan 1992 (cubic spline); Müller
// et al. 2003 (poly6, spiky); Wendland 1995 (C2).
layout(constant_id = 0) const uint kernel_kind = 0u;  // of parity::SphKernel

float kernel_value(float r2, float inverse_support, float scale) {
  precise const float q = sqrt(r2) * inverse_support;
  precise const float t = max(1.0 - q, 0.0);
  precise float w;
  if (kernel_kind == 0u) {
    w = q < 0.5 ? 1.0 - 6.0 * q * q * t : 2.0 * t * t * t;
  } else if (kernel_kind == 1u) {
    precise const float s = max(1.0 - r2 * inverse_support * inverse_support, 0.0);
    w = s * s * s;
  } else if (kernel_kind == 2u) {
    w = t * t * t;
  } else {
    precise const float t2 = t * t;
    w = t2 * t2 * (1.0 + 4.0 * q);
  }
  precise const float value = scale * w;
  return value;
}

/// dW/dr divided by r; 0 at r = 0 where the gradient has no direction.
float kernel_slope(float r2, float inverse_support, float scale) {
  precise const float r = sqrt(r2);
  precise const float q = r * inverse_support;
  precise const float t = max(1.0 - q, 0.0);
  precise const float per_length = scale * inverse_support;
  precise float slope;
  if (kernel_kind == 0u) {
    slope = q < 0.5 ? per_length * inverse_support * (18.0 * q - 12.0) : per_length * -6.0 * t * t / r;
  } else if (kernel_kind == 1u) {
    precise const float s = max(1.0 - r2 * inverse_support * inverse_support, 0.0);
    slope = per_length * inverse_support * (-6.0 * s * s);
  } else if (kernel_kind == 2u) {
    slope = r > 0.0 ? per_length * -3.0 * t * t / r : 0.0;
  } else {
    slope = per_length * inverse_support * (-20.0 * t * t * t);
  }
  return slope;
}

float squared_length(vec3 d) {
  precise const float sum = d.x * d.x + d.y * d.y + d.z * d.z;
  return sum;
}

float inner_product(vec3 a, vec3 b) {
  precise const float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}
