#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility of one instance in a host's light.
#define ONE_INSTANCE
#define HOST_LIGHT 1
#include "shaders/resolve/shade_visibility.glsl"
