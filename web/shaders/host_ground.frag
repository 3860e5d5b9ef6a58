// The light of the ground in a framebuffer of a host.
#define IN_HOST
#include "web/shaders/host.glsl"
#include "web/shaders/ground.frag"
