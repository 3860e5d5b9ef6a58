// The sky with its sun.
#include "web/shaders/frame.glsl"
#include "shaders/common/sky_light.glsl"

in vec3 outRay;

layout(location = 0) out vec4 outColor;

void main()
{
    outColor = vec4(skyPicture(normalize(outRay), gl_FragCoord.xy), 1.0);
}
