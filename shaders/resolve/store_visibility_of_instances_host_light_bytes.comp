#version 460
#extension GL_GOOGLE_include_directive : require
// Stores a visibility of several instances, in a host's light, into a picture of bytes.
#define HOST_LIGHT 0
#define STORED_SET 1
#define STORED_FORMAT rgba8
#include "shaders/resolve/store_visibility.glsl"
