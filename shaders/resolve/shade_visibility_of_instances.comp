#version 460
#extension GL_GOOGLE_include_directive : require
// Lights a visibility of several instances.
#include "shaders/resolve/shade_visibility.glsl"
