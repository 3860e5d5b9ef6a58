#version 460
#extension GL_GOOGLE_include_directive : require
// A stage of blades by tessellation.
#include "shaders/tessellation/blade_fragment.glsl"
