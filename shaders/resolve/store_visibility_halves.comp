#version 460
#extension GL_GOOGLE_include_directive : require
// Stores a visibility of one instance into a picture of halves.
#define ONE_INSTANCE
#define STORED_SET 1
#define STORED_FORMAT rgba16f
#include "shaders/resolve/store_visibility.glsl"
