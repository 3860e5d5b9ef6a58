// The structs of opaque.h.
void putOpaque()
{
    put(sources.at[0].largeTriangle.at[1].triangle);
    put(sources.at[0].largeTriangle.at[1].firstTile);
    put(sources.at[0].largeTriangle.at[1].tile);
    put(sources.at[0].largeTriangle.at[1].columns);
    for (uint i = 0u; i < 3u; ++i)
        put(sources.at[0].opaqueWork.at[1].middle.groups[i]);
    put(sources.at[0].opaqueWork.at[1].middle.count);
    for (uint i = 0u; i < 3u; ++i)
        put(sources.at[0].opaqueWork.at[1].tiles.groups[i]);
    put(sources.at[0].opaqueWork.at[1].tiles.count);
    put(sources.at[0].opaqueWork.at[1].tilesAsked);
    put(sources.at[0].opaqueWork.at[1].trianglesAsked);
    put(uvec2(sources.at[0].opaquePush.at[1].frame));
    put(uvec2(sources.at[0].opaquePush.at[1].visibility));
    put(uvec2(sources.at[0].opaquePush.at[1].clusters));
    put(uvec2(sources.at[0].opaquePush.at[1].indices));
    put(uvec2(sources.at[0].opaquePush.at[1].vertices));
    put(uvec2(sources.at[0].opaquePush.at[1].materials));
    put(uvec2(sources.at[0].opaquePush.at[1].work));
    put(uvec2(sources.at[0].opaquePush.at[1].middle));
    put(uvec2(sources.at[0].opaquePush.at[1].large));
    put(sources.at[0].opaquePush.at[1].size);
    put(sources.at[0].opaquePush.at[1].clusterCount);
    put(sources.at[0].opaquePush.at[1].triangleCount);
    put(sources.at[0].opaquePush.at[1].firstImage);
    put(sources.at[0].opaquePush.at[1].imageCount);
}
