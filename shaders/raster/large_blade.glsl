// A sample of a large blade that the tessellator has cut, into the visibility. The including shader
// has sampleOfPixel() and AT_SAMPLE, the word that interpolates there.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/raster/put_sample.glsl"

layout(location = 3) AT_SAMPLE in vec4 inPlace; // across, along, [m] wide and drawn
layout(location = 8) flat in uint inBlade;

void main()
{
    const uint s = sampleOfPixel();
    if ((samplesKept(inPlace.zw, inBlade) & (1u << s)) != 0u)
        putSample(uvec2(gl_FragCoord.xy), s, gl_FragCoord.z, inBlade);
}
