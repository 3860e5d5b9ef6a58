#version 460
#extension GL_GOOGLE_include_directive : require
// Stores a visibility of several instances into a picture of bytes.
#define STORED_SET 0
#define STORED_FORMAT rgba8
#include "shaders/resolve/store_visibility.glsl"
