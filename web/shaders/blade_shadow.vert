// A vertex of a ribbon in the sun's view of the blades near the eye.
#include "web/shaders/ribbon.glsl"

flat out uint outSeed;
out float outDepth;

void main()
{
    Ribbon ribbon = recordedRibbon();
    ribbon.fold = 0.0;
    outSeed = ribbon.seed;
    outDepth = 0.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (ribbon.width <= 0.0)
        return;
    const vec2 place = placeOfVertex(ribbon);
    const CrossSection section = crossSectionAt(ribbon, place.y, FRAME.view.eye, 0.0);
    const vec4 point = vec4(onCrossSection(section, place.x), 1.0);
    const BladeShadow map = FRAME.bladeShadow;
    const vec2 texel = vec2(dot(map.across, point), dot(map.down, point));
    outDepth = dot(map.depth, point);
    gl_Position = inClip(vec4(texel * (2.0 / float(map.size)) - 1.0, outDepth, 1.0));
}
