// Particles and the grid: linear weights. Needs fluid/grid.glsl. Source: Zhu & Bridson 2005 (FLIP);
// Jiang, Schroeder, Selle, Teran & Stomakhin 2015 (APIC).

/// Place of a particle in cells from the domain's corner.
vec3 place_of_particle(FluidScene scene, vec3 position) {
  return (position - scene.origin) * (1.0 / scene.spacing);
}

/// From a particle to a point along one axis, the shorter way around a periodic one.
float towards(FluidScene scene, uint d, float point, float place) {
  float way = point - place;
  if (wraps(scene, d)) {
    const float period = float(scene.cells[d]);
    way -= period * floor(way / period + 0.5);
  }
  return way;
}

/// Weight of a point along one axis. Beyond the outermost point there is no other: it has all.
float weight_along(FluidScene scene, uint axis, uint d, int at, float way) {
  const int last = int(scene.cells[d]) - 1 + (d == axis ? 1 : 0);
  if (!wraps(scene, d)) {
    if (at == 0 && way > 0.0 && d != axis) return 1.0;
    if (at == last && way < 0.0 && d != axis) return 1.0;
  }
  return max(0.0, 1.0 - abs(way));
}
