// Lines pixel by pixel. Source: notes 1.9.
#ifndef PARITY_RASTER_LINE_GLSL
#define PARITY_RASTER_LINE_GLSL

/// Pixels of a line less one: the greater side of its box.
uint line_steps(ivec4 segment) {
  const ivec2 d = abs(segment.zw - segment.xy);
  return uint(max(d.x, d.y));
}

#endif
