#version 460

// One for each sample covered, added up by the blender, and the element.
layout(location = 0) flat in uint element;
layout(location = 0) out float count;
layout(location = 1) out uint last;

void main() {
  count = 1.0;
  last = element;
}
