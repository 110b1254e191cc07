// What the words of a pressure system say; numerics/layout.h.

/// Cell of a float or uint of a level's arrays; false: it pads the row.
bool cell_of_slot(PressureLevel level, uint slot, out uvec3 cell) {
  const uint row = 4u * level.row;
  const uint y = (slot / row) % level.cells.y;
  const uint z = (slot / (row * level.cells.y)) % level.cells.z;
  const uint colour = slot / (row * level.cells.y * level.cells.z);
  cell = uvec3(2u * (slot % row) + ((y + z + colour) & 1u), y, z);
  return cell.x < level.cells.x;
}

uint slot_of_cell(PressureLevel level, uvec3 cell) {
  const uint row = 4u * level.row;
  const uint colour = (cell.x + cell.y + cell.z) & 1u;
  return ((colour * level.cells.z + cell.z) * level.cells.y + cell.y) * row + cell.x / 2u;
}

uint slot_count(PressureLevel level) {
  return 8u * level.row * level.cells.y * level.cells.z;
}
