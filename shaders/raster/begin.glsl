// Fills the visibility with what has been drawn so far. The including shader has depthAt().
layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size)))
        return;
    Visibility visibility = Visibility(uvec2(push.visibility));
    for (uint s = 0u; s < samplesPerPixel; ++s)
        visibility.at[sampleIndex(pixel, s)] =
            uint64_t(floatBitsToUint(depthAt(ivec2(pixel), int(s)))) << 32u;
}
