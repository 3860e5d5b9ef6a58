// The frame as uniform constants in descriptor set FRAME_SET. A GPU keeps uniform data that all threads read out of
// vector registers, unlike data read through an address.
#ifndef SWARD_COMMON_FRAME_CONSTANTS_GLSL
#define SWARD_COMMON_FRAME_CONSTANTS_GLSL

#include "shaders/shared/frame.h"

layout(set = FRAME_SET, binding = 0, scalar) uniform FrameConstants { Frame frameConstants; };

#define FRAME frameConstants

#endif
