#version 460
#extension GL_GOOGLE_include_directive : require
// Stores a visibility of several instances into a picture of halves.
#define STORED_SET 0
#define STORED_FORMAT rgba16f
#include "shaders/resolve/store_visibility.glsl"
