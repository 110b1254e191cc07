#version 460

// The element that passes the depth test.
layout(location = 0) flat in uint element;
layout(location = 0) out uint front;

void main() { front = element; }
