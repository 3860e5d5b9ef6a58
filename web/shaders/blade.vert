// A vertex of a ribbon.
#include "web/shaders/ribbon.glsl"

out vec3 outPosition;
out vec4 outPlace; // −1 … 1 across, 0 … 1 along, [m] wide and drawn
flat out uvec4 outSurface;
flat out uvec4 outFrame;
flat out uvec3 outBend; // bend of BladeVaryings; seed and finish

void main()
{
    const Ribbon ribbon = recordedRibbon();
    outPosition = vec3(0.0);
    outPlace = vec4(0.0);
    outSurface = recordSurface;
    outFrame = recordFrame;
    outBend = uvec3(recordBend.xy, ribbon.seed | (recordBend.z << 16u));
    if (ribbon.width <= 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    const vec2 place = placeOfVertex(ribbon);
    const CrossSection section = crossSectionAt(ribbon, place.y, FRAME.view.eye, FRAME.view.minWidth);
    outPosition = onCrossSection(section, place.x);
    outPlace = vec4(2.0 * place.x - 1.0, place.y, section.wide, section.drawn);
    gl_Position = inClip(FRAME.viewProjection * vec4(outPosition, 1.0));
}
