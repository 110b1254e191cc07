#version 460

// Marks the pixels of the device's own line.
layout(location = 0) out uint covered;

void main() { covered = 1u; }
