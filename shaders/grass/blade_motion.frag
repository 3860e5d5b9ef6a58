#version 460
#extension GL_GOOGLE_include_directive : require
// A stage of blades by tessellation that tells how they have moved, too.
#define HAS_MOTION
#include "shaders/grass/blade_fragment.glsl"
