// Places on a staggered grid. Source: notes 10.4; Harlow & Welch 1965.

float read_face(FluidFaces faces, uint axis, uint index) {
  return axis == 0u ? faces.x.at[index] : (axis == 1u ? faces.y.at[index] : faces.z.at[index]);
}

void write_face(FluidFaces faces, uint axis, uint index, float value) {
  if (axis == 0u) {
    faces.x.at[index] = value;
  } else if (axis == 1u) {
    faces.y.at[index] = value;
  } else {
    faces.z.at[index] = value;
  }
}

ivec3 unit(uint axis) { return ivec3(axis == 0u, axis == 1u, axis == 2u); }

/// Points of a field: one more than cells along the axis of faces; 3 stands for cells.
ivec3 points_of(uvec3 cells, uint axis) { return ivec3(cells) + unit(axis); }

uint point_index(ivec3 size, ivec3 at) { return uint((at.z * size.y + at.y) * size.x + at.x); }

ivec3 point_of(ivec3 size, uint index) {
  return ivec3(int(index) % size.x, int(index) / size.x % size.y, int(index) / (size.x * size.y));
}

uint point_count(ivec3 size) { return uint(size.x * size.y * size.z); }

bool wraps(FluidScene scene, uint axis) { return scene.walls[2u * axis] == wall_periodic; }

/// Whether a face lies in a wall that nothing passes.
bool in_closed_wall(FluidScene scene, uint axis, ivec3 face) {
  const uint side = face[axis] == 0 ? 2u * axis : 2u * axis + 1u;
  if (face[axis] != 0 && face[axis] != int(scene.cells[axis])) return false;
  return scene.walls[side] == wall_no_slip || scene.walls[side] == wall_free_slip;
}
