// The frame as constants, in the set of descriptors FRAME_SET. A GPU keeps what every thread reads of
// them out of its registers, unlike what comes by an address.
#ifndef SWARD_FRAME_CONSTANTS_GLSL
#define SWARD_FRAME_CONSTANTS_GLSL

#include "shaders/shared/frame.h"

layout(set = FRAME_SET, binding = 0, scalar) uniform FrameConstants { Frame frameConstants; };

#define FRAME frameConstants

#endif
