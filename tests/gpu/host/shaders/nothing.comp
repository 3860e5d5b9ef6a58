#version 460
// In place of shaders that are compiled but not run.

layout(local_size_x = 1) in;

void main() {}
