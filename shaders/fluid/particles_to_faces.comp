#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "fluid/liquid.glsl"

// Velocity of faces from the particles around; one thread a face gathers from the cells that reach
// it, in the order of cells and ids. Source: Zhu & Bridson 2005; Jiang et al. 2015.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

void gather_cell(FluidScene scene, ivec3 face, ivec3 cell, inout float momentum, inout float mass) {
  for (uint d = 0u; d < 3u; ++d) {
    const int count = int(scene.cells[d]);
    if (wraps(scene, d)) cell[d] = (cell[d] + count) % count;
    if (cell[d] < 0 || cell[d] >= count) return;
  }
  const uint index = point_index(ivec3(scene.cells), cell);
  const uint end = args.ranges.at[2u * index + 1u];
  for (uint k = args.ranges.at[2u * index]; k < end; ++k) {
    const uint id = args.sorted.at[k];
    const vec3 place = place_of_particle(scene, args.positions.at[id]);
    vec3 way;
    float weight = 1.0;
    for (uint d = 0u; d < 3u; ++d) {
      way[d] = towards(scene, d, float(face[d]) + (d == args.axis ? 0.0 : 0.5), place[d]);
      weight *= weight_along(scene, args.axis, d, face[d], way[d]);
    }
    float speed = args.velocities.at[id][args.axis];
    const mat3 gradient = args.gradients.at[id];
    for (uint d = 0u; d < 3u; ++d) speed += gradient[d][args.axis] * way[d] * scene.spacing;
    momentum += weight * speed;
    mass += weight;
  }
}

void main() {
  if (args.clock.at[0].step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  ivec3 face;
  if (!point_of_thread(scene, args.axis, face)) return;
  const uint index = point_index(points_of(scene.cells, args.axis), face);
  ivec3 low = -ivec3(1), high = ivec3(1);
  high[args.axis] = 0;
  if (scene.cells.z == 1u) low.z = high.z = 0;
  // A short periodic axis must not bring a cell twice.
  for (uint d = 0u; d < 3u; ++d)
    if (wraps(scene, d) && int(scene.cells[d]) <= high[d] - low[d]) low[d] = high[d] - int(scene.cells[d]) + 1;
  float momentum = 0.0, mass = 0.0;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        gather_cell(scene, face, face + ivec3(x, y, z), momentum, mass);
  const float speed = mass > 0.0 ? momentum / mass : 0.0;
  write_face(args.velocity, args.axis, index, speed);
  write_face(args.old, args.axis, index, speed);
}
