// Echoes shared::HostLight: part of layout_echo.comp.
#define LIGHT sources.at[0].hostLight.at[1]
void putHostLight()
{
    for (uint i = 0u; i < 3u; ++i)
        for (uint column = 0u; column < 4u; ++column)
            put(LIGHT.ambient[i][column]);
    put(LIGHT.above);
    for (uint i = 0u; i < maxCascades; ++i) {
        put(LIGHT.cascades[i].across);
        put(LIGHT.cascades[i].down);
        put(LIGHT.cascades[i].depth);
        put(LIGHT.cascades[i].width);
    }
    for (uint i = 0u; i < maxLamps; ++i) {
        put(LIGHT.lamps[i].position);
        put(LIGHT.lamps[i].perRange);
        put(LIGHT.lamps[i].color);
        put(LIGHT.lamps[i].nearest);
        put(LIGHT.lamps[i].direction);
        put(LIGHT.lamps[i].perCone);
        put(LIGHT.lamps[i].coneEdge);
        put(LIGHT.lamps[i].reserved);
    }
    put(LIGHT.cascadeCount);
    put(LIGHT.lampCount);
    put(LIGHT.hasAmbient);
    put(LIGHT.nearer);
    put(LIGHT.lift);
}
