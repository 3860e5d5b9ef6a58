#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility of one instance.
#define ONE_INSTANCE
#include "shaders/resolve/shade_visibility.glsl"
