// The struct Frame.
void putFrame()
{
#define FRAME sources.at[0].frame.at[0]
    put(uvec2(FRAME.blades));
    put(uvec2(FRAME.states));
    put(uvec2(FRAME.etas));
    put(uvec2(FRAME.patches));
    put(uvec2(FRAME.species));
    put(uvec2(FRAME.visible));
    put(uvec2(FRAME.draw));
    put(uvec2(FRAME.patchTimes));
    put(uvec2(FRAME.patchCounts));
    put(uvec2(FRAME.cullResults));
    put(uvec2(FRAME.pages));
    put(uvec2(FRAME.hostLight));
    put(uvec2(FRAME.pyramid.depths));
    put(FRAME.pyramid.size);
    for (uint i = 0u; i < maxPyramidLevels; ++i)
        put(FRAME.pyramid.first[i]);
    put(FRAME.pyramid.levels);
    for (uint column = 0u; column < 4u; ++column)
        put(FRAME.viewProjection[column]);
    for (uint i = 0u; i < 3u; ++i)
        put(FRAME.rays[i]);
    put(FRAME.depthOfEye);
    for (uint i = 0u; i < 6u; ++i)
        put(FRAME.view.planes[i]);
    put(FRAME.view.eye);
    put(FRAME.view.drawDistance);
    put(FRAME.view.pixelsPerUnit);
    put(FRAME.view.lodThreshold);
    put(FRAME.view.lodWidth);
    put(FRAME.view.minWidth);
    put(FRAME.view.maxLeafArea);
    put(FRAME.view.maxEdgeOn);
    put(FRAME.view.samples);
    put(FRAME.view.buckets);
    put(FRAME.view.bucketDistance);
    put(FRAME.view.cullMask);
    put(FRAME.tick);
    put(FRAME.environment);
    put(FRAME.patchCount);
    put(FRAME.bladeCount);
    put(FRAME.visibleCapacity);
    put(FRAME.maxTessellation);
    put(FRAME.sunDirection);
    put(FRAME.exposure);
    put(FRAME.sunColor);
    put(FRAME.debugMode);
    put(FRAME.skyColor);
    put(FRAME.fogDensity);
    put(FRAME.groundColor);
    put(FRAME.skyUp);
    put(FRAME.fixedTessellation);
    put(FRAME.clouds);
    put(FRAME.levelSteps.distance);
    put(FRAME.levelSteps.segments);
    put(FRAME.levelSteps.count);
    put(FRAME.updateRate.everyFrame);
    put(FRAME.updateRate.everyThird);
    put(FRAME.updateRate.longest);
    put(FRAME.updateRate.frame);
    put(FRAME.cover);
    put(FRAME.shadow);
    put(FRAME.bladeShadow);
    put(FRAME.fogFalloff);
    put(FRAME.lowSun);
    put(FRAME.floorPlane);
    for (uint i = 0u; i < FRAME.reserved.length(); ++i)
        put(FRAME.reserved[i]);
}
