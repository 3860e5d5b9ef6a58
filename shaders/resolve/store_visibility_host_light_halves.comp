#version 460
#extension GL_GOOGLE_include_directive : require
// Stores a visibility of one instance, in a host's light, into a picture of halves.
#define ONE_INSTANCE
#define HOST_LIGHT 1
#define STORED_SET 2
#define STORED_FORMAT rgba16f
#include "shaders/resolve/store_visibility.glsl"
