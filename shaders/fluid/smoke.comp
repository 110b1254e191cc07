#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"

// What smoke and heat do; one thread a cell, or a face of an axis. Source: notes 10.4; Fedkiw, Stam &
// Jensen 2001.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidScalarArgs args; };

layout(constant_id = 1) const uint mode = 0u;
const uint sources = 0u;    ///< cells: what was carried there, held in sources, heat cools
const uint vorticity = 1u;  ///< cells: curl of the velocity
const uint spin = 2u;       ///< cells: confinement
const uint forces = 3u;     ///< faces: everything that pushes

void hold_sources(FluidScene scene, float step, ivec3 cell, uint index) {
  const vec3 position = scene.origin + scene.spacing * (vec3(cell) + 0.5);
  float smoke = args.carried_smoke.at[index];
  precise float heat = args.carried_temperature.at[index] / (1.0 + scene.cooling * step);
  for (uint k = 0u; k < scene.source_count; ++k) {
    const FluidSourceRecord source = scene.sources.at[k];
    if (distance(position, source.center) > source.radius) continue;
    smoke = source.smoke;
    heat = source.temperature;
  }
  args.smoke.at[index] = smoke;
  args.temperature.at[index] = heat;
}

vec3 cell_velocity(FluidScene scene, ivec3 cell) {
  cell = clamp(cell, ivec3(0), ivec3(scene.cells) - 1);
  vec3 u;
  for (uint axis = 0u; axis < 3u; ++axis) {
    const ivec3 size = points_of(scene.cells, axis);
    u[axis] = 0.5 * (read_face(args.velocity, axis, point_index(size, cell)) +
                     read_face(args.velocity, axis, point_index(size, cell + unit(axis))));
  }
  return u;
}

vec3 curl_at(FluidScene scene, ivec3 cell) {
  const vec3 x = cell_velocity(scene, cell + unit(0u)) - cell_velocity(scene, cell - unit(0u));
  const vec3 y = cell_velocity(scene, cell + unit(1u)) - cell_velocity(scene, cell - unit(1u));
  const vec3 z = cell_velocity(scene, cell + unit(2u)) - cell_velocity(scene, cell - unit(2u));
  return vec3(y.z - z.y, z.x - x.z, x.y - y.x) / (2.0 * scene.spacing);
}

float curl_size(FluidScene scene, ivec3 cell) {
  cell = clamp(cell, ivec3(0), ivec3(scene.cells) - 1);
  return args.vorticity.at[point_index(ivec3(scene.cells), cell)].w;
}

vec3 confinement_at(FluidScene scene, ivec3 cell, uint index) {
  vec3 slope;
  for (uint d = 0u; d < 3u; ++d)
    slope[d] = curl_size(scene, cell + unit(d)) - curl_size(scene, cell - unit(d));
  slope /= 2.0 * scene.spacing;
  // The direction fades to nothing where there is none: below a curl of 1e-3 / s in a cell.
  const vec3 towards = slope / (length(slope) + 1e-3 / scene.spacing);
  return scene.confinement * scene.spacing * cross(towards, args.vorticity.at[index].xyz);
}

float push(FluidScene scene, ivec3 face) {
  const ivec3 size = ivec3(scene.cells);
  ivec3 above = face, below = face - unit(args.axis);
  const int count = size[args.axis];
  if (wraps(scene, args.axis)) {
    above[args.axis] = above[args.axis] % count;
    below[args.axis] = (below[args.axis] + count) % count;
  }
  const uint a = point_index(size, clamp(above, ivec3(0), size - 1));
  const uint b = point_index(size, clamp(below, ivec3(0), size - 1));
  precise float sum = scene.force[args.axis];
  if (args.axis == 1u)
    sum += 0.5 * scene.heat_lift * (args.temperature.at[a] + args.temperature.at[b]) -
           0.5 * scene.smoke_weight * (args.smoke.at[a] + args.smoke.at[b]);
  if (scene.confinement > 0.0)
    sum += 0.5 * (args.spin.at[a][args.axis] + args.spin.at[b][args.axis]);
  return sum;
}

void push_face(FluidScene scene, float step, ivec3 face, uint index) {
  if (in_closed_wall(scene, args.axis, face)) {
    write_face(args.pushed, args.axis, index, 0.0);
    return;
  }
  precise float u = read_face(args.velocity, args.axis, index) + step * push(scene, face);
  const vec3 half_cell = 0.5 * vec3(1.0 - vec3(unit(args.axis)));
  const vec3 position = scene.origin + scene.spacing * (vec3(face) + half_cell);
  for (uint k = 0u; k < scene.source_count; ++k) {
    const FluidSourceRecord source = scene.sources.at[k];
    if (source.velocity != vec3(0.0) && distance(position, source.center) <= source.radius)
      u = source.velocity[args.axis];
  }
  write_face(args.pushed, args.axis, index, u);
}

void main() {
  FluidScene scene = args.scene.at[0];
  const float step = args.clock.at[0].step;
  const uint axis = mode == forces ? args.axis : 3u;
  ivec3 at;
  if (!point_of_thread(scene, axis, at) || step == 0.0) return;
  const uint index = point_index(points_of(scene.cells, axis), at);
  if (mode == sources) {
    hold_sources(scene, step, at, index);
  } else if (mode == vorticity) {
    const vec3 curl = curl_at(scene, at);
    args.vorticity.at[index] = vec4(curl, length(curl));
  } else if (mode == spin) {
    args.spin.at[index] = vec4(confinement_at(scene, at, index), 0.0);
  } else {
    push_face(scene, step, at, index);
  }
}
