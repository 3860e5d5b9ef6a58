#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility of several instances in a host's light.
#define HOST_LIGHT 0
#include "shaders/resolve/shade_visibility.glsl"
