#version 460
#extension GL_GOOGLE_include_directive : require
// A stage of blades by tessellation in a host's light.
#define HOST_LIGHT 0
#include "shaders/tessellation/blade_fragment.glsl"
