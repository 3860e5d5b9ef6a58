flat in uint outSeed;
in float outDepth;

layout(location = 0) out uvec2 texel;

void main()
{
    texel = uvec2(outSeed, floatBitsToUint(outDepth));
}
