// One point of a ribbon in a framebuffer of a host.
#define IN_HOST
#include "web/shaders/host.glsl"
#include "web/shaders/blade.frag"
