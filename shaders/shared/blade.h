// One blade of grass and its packed storage.
#ifndef SWARD_SHARED_BLADE_H
#define SWARD_SHARED_BLADE_H

#include "shaders/shared/noise.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST float twoPi = 6.28318530717958647692f;

/// A baked blade, 16 bytes, quantised to its patch. Never written after the bake.
struct PackedBlade {
    uint rootXY;  ///< root.x 0–15, root.y 16–31, in steps of the patch
    uint rootZUp; ///< root.z 0–15, up 16–31 (octahedral)
    uint shape;   ///< facing 0–7, height 8–15, width 16–21, stiffness 22–27, hash 28–31
    uint look;    ///< tint 0–15 (RGB565), exposure 16–20, species 21–23, clump 24–31
};
SHARED_LAYOUT(PackedBlade, 16)

SHARED_BUFFER(BladeArray, PackedBlade, readonly)

/// The same blade, unpacked.
struct Blade {
    vec3 root;       ///< [m] relative to the field's origin, on the ground
    float facing;    ///< [rad] in [0, 2π): turn of the width axis about `up`, from tangentOf(up)
    vec3 up;         ///< unit; direction of growth
    float stiffness; ///< [0, 1]; 1 does not bend
    float height;    ///< [m] length of the blade
    float width;     ///< [m] full width at the root
    float exposure;  ///< [0, 1] share of open sky above the root
    uint species;    ///< slot in the field's species table, 0–7
    vec3 tint;       ///< [0, 1] colour of the ground at the root, as stored in images (sRGB)
    uint clump;      ///< 0–254, about the same for neighbours of one clump; driedClump
    uint hash;       ///< 0–15
    uint seed;       ///< seedOf() its packed form; packBlade() ignores it
};

/// The number of a clump that stands for none: its blades are dead and dry.
SHARED_CONST uint driedClump = 255u;

// Maximum errors of packing, each asserted by blade_test.cpp. Root: half a rootStep per axis.
// Height and width: half a step of the patch. Up: octahedralMaxError.
SHARED_CONST float facingMaxError = 0.01228f;    ///< [rad] π/256
SHARED_CONST float stiffnessMaxError = 0.00794f; ///< 1/126
SHARED_CONST float exposureMaxError = 0.01613f;  ///< 1/62
SHARED_CONST float tintMaxError = 0.01613f;      ///< 1/62 in red and blue, 1/126 in green

SHARED_FN uint quantise(float x, float low, float step, uint largest)
{
    if (step <= 0.0f)
        return 0u;
    return uint(clamp(floor((x - low) / step + 0.5f), 0.0f, float(largest)));
}

/// 16 random bits of a blade. They come from the bytes that do not depend on the blade's patch or on
/// its place in it, so an edit of other blades of the patch does not change them.
SHARED_FN uint seedOf(PackedBlade bits)
{
    const uint kept = (bits.shape & 0xffc000ffu) ^ ((bits.rootZUp >> 16u) << 8u);
    return mixUint(kept + bits.look * 0x9e3779b9u) >> 16u;
}

/// Packs a blade whose up-vector is encoded already: `up` is encodeOctahedral(blade.up).
SHARED_FN PackedBlade packBladeWith(Blade blade, Patch cell, uint up)
{
    const uint x = quantise(blade.root.x, cell.rootLow.x, cell.rootStep, 65535u);
    const uint y = quantise(blade.root.y, cell.rootLow.y, cell.rootStep, 65535u);
    const uint z = quantise(blade.root.z, cell.rootLow.z, cell.rootStep, 65535u);
    const uint facing = uint(int(floor(blade.facing * (256.0f / twoPi) + 0.5f))) & 255u;
    const uint height = quantise(blade.height, cell.heightLow, cell.heightStep, 255u);
    const uint width = quantise(blade.width, cell.widthLow, cell.widthStep, 63u);
    const uint stiffness = quantise(blade.stiffness, 0.0f, 1.0f / 63.0f, 63u);
    const uint exposure = quantise(blade.exposure, 0.0f, 1.0f / 31.0f, 31u);
    const uint red = quantise(blade.tint.x, 0.0f, 1.0f / 31.0f, 31u);
    const uint green = quantise(blade.tint.y, 0.0f, 1.0f / 63.0f, 63u);
    const uint blue = quantise(blade.tint.z, 0.0f, 1.0f / 31.0f, 31u);

    PackedBlade bits;
    bits.rootXY = x | (y << 16u);
    bits.rootZUp = z | (up << 16u);
    bits.shape =
        facing | (height << 8u) | (width << 16u) | (stiffness << 22u) | ((blade.hash & 15u) << 28u);
    bits.look = red | (green << 5u) | (blue << 11u) | (exposure << 16u) |
                ((blade.species & 7u) << 21u) | ((blade.clump & 255u) << 24u);
    return bits;
}

SHARED_FN PackedBlade packBlade(Blade blade, Patch cell)
{
    return packBladeWith(blade, cell, encodeOctahedral(blade.up));
}

SHARED_FN Blade unpackBlade(PackedBlade bits, Patch cell)
{
    Blade blade;
    blade.root =
        cell.rootLow + cell.rootStep * vec3(float(bits.rootXY & 65535u), float(bits.rootXY >> 16u),
                                            float(bits.rootZUp & 65535u));
    blade.up = decodeOctahedral(bits.rootZUp >> 16u);
    blade.facing = float(bits.shape & 255u) * (twoPi / 256.0f);
    blade.height = cell.heightLow + cell.heightStep * float((bits.shape >> 8u) & 255u);
    blade.width = cell.widthLow + cell.widthStep * float((bits.shape >> 16u) & 63u);
    blade.stiffness = float((bits.shape >> 22u) & 63u) * (1.0f / 63.0f);
    blade.hash = bits.shape >> 28u;
    blade.tint = vec3(float(bits.look & 31u) * (1.0f / 31.0f),
                      float((bits.look >> 5u) & 63u) * (1.0f / 63.0f),
                      float((bits.look >> 11u) & 31u) * (1.0f / 31.0f));
    blade.exposure = float((bits.look >> 16u) & 31u) * (1.0f / 31.0f);
    blade.species = (bits.look >> 21u) & 7u;
    blade.clump = bits.look >> 24u;
    blade.seed = seedOf(bits);
    return blade;
}

/// Unit width axis of a blade: perpendicular to its own up-vector, for any direction of that.
SHARED_FN vec3 widthAxis(vec3 up, float facing)
{
    return tangentOf(up) * cos(facing) + bitangentOf(up) * sin(facing);
}

/// Unit direction that a blade faces and leans to: perpendicular to up and width axis.
SHARED_FN vec3 frontOf(vec3 up, vec3 axis)
{
    return cross(up, axis);
}

/// The axes of a blade: unit, at right angles, right-handed in this order.
struct BladeAxes {
    vec3 front; ///< direction that it faces and leans to
    vec3 side;  ///< opposite to its width axis
    vec3 up;
};

/// Axes of a blade that grows along unit `up` with its width along `axis`.
SHARED_FN BladeAxes axesAlong(vec3 up, vec3 axis)
{
    BladeAxes axes;
    axes.front = frontOf(up, axis);
    axes.side = -axis;
    axes.up = up;
    return axes;
}

/// The same from its front.
SHARED_FN BladeAxes axesTowards(vec3 up, vec3 front)
{
    BladeAxes axes;
    axes.front = front;
    axes.side = cross(up, front);
    axes.up = up;
    return axes;
}

/// Converts a vector from space to blade axes: front, side, up.
SHARED_FN vec3 alongAxes(BladeAxes axes, vec3 v)
{
    return vec3(dot(v, axes.front), dot(v, axes.side), dot(v, axes.up));
}

/// Converts a vector from blade axes to space.
SHARED_FN vec3 inSpace(BladeAxes axes, vec3 v)
{
    return v.x * axes.front + v.y * axes.side + v.z * axes.up;
}

SHARED_END
#endif
