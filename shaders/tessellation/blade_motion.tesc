#version 460
#extension GL_GOOGLE_include_directive : require
// A stage of blades by tessellation with motion output.
#define HAS_MOTION
#include "shaders/tessellation/blade_control.glsl"
