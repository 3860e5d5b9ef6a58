// The blade of a candidate, as bake::BladeGrower grows it, from what the candidate knows alone.
#ifndef SWARD_SHARED_SOW_SOWN_BLADE_H
#define SWARD_SHARED_SOW_SOWN_BLADE_H

#include "shaders/shared/blade.h"
#include "shaders/shared/sow/conditions.h"
#include "shaders/shared/sow/creases.h"
#include "shaders/shared/sow/wide_variation.h"

SHARED_BEGIN

// Purposes of a blade's random numbers, as bake::Dimension.
SHARED_CONST uint sowSpeciesDice = 6u;
SHARED_CONST uint sowHeightDice = 7u;
SHARED_CONST uint sowWidthDice = 8u;
SHARED_CONST uint sowStiffnessDice = 9u;
SHARED_CONST uint sowFacingDice = 10u;
SHARED_CONST uint sowClumpDice = 12u;
SHARED_CONST uint sowDrynessDice = 14u;

/// The clump of a candidate.
struct SowClump {
    uint64_t key; ///< of its random numbers; without a clump, the candidate's own
    ivec3 offset; ///< units from its centre to the candidate
    vec3 along;   ///< of any length: its shared direction; 0 unless a species has one
    uint isAny;   ///< 0: no clump is near
    SowClumpTraits wide;
};

SHARED_FN float sowOwn(uint64_t bits, uint purpose)
{
    return sowUnit(sowHash(bits, uint64_t(purpose)));
}

/// Share of a colony at a wave's height.
SHARED_FN float sowInside(float wave)
{
    const float t = clamp(0.5f + 2.5f * wave, 0.0f, 1.0f);
    return 2.0f * t * t * (3.0f - 2.0f * t);
}

/// Waves of a species at a place: its drift, or the factor of its colonies if it has ribbons.
SHARED_FN float sowWaveOf(ivec3 place, uint slot, uint ribbons, SowWaves waves)
{
    const uint first = sowSpeciesWaves + 4u * slot;
    const float wave = sowSlowWaves(place, waves.at[first], waves.at[first + 1u]);
    if (ribbons == 0u)
        return wave;
    if (sowInside(wave) <= 0.0f)
        return 0.0f;
    const float stand = sowSlowWaves(place, waves.at[first + 2u], waves.at[first + 3u]);
    return sowInside(wave) * sowInside(stand);
}

/// Byte of a species in two words.
SHARED_FN uint sowByteOf(uint first, uint second, uint slot)
{
    return ((slot < 4u ? first : second) >> (8u * (slot & 3u))) & 255u;
}

/// Whether conditions say vigour of each species: everywhere, or where strokes sow species.
SHARED_FN bool sowIsMixed(SowMeadow meadow, SeedConditions conditions)
{
    return meadow.isMixed != 0u || (conditions.share[0] | conditions.share[1]) != 0u;
}

/// Factor on SowMeadow::heightsPerMetre of a piece that strokes change. A cell has its least.
SHARED_FN float sowHeightScale(SeedPiece piece)
{
    const uint doublings = (piece.form >> 26u) & 3u;
    return doublings == 0u ? 1.0f : doublings == 1u ? 0.5f : doublings == 2u ? 0.25f : 0.125f;
}

/// The species of a candidate by shares, drifts and clump: as bake::BladeChooser.
SHARED_FN uint sowSpecies(SowMeadow meadow, SeedConditions conditions, ivec3 place, uint64_t own,
                          uint64_t clump, SowWaves waves)
{
    if (meadow.speciesCount < 2u)
        return 0u;
    float share[8];
    float total = 0.0f;
    uint painted = 0u;
    for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
        const uint said = sowByteOf(conditions.share[0], conditions.share[1], slot);
        share[slot] = meadow.isMixed != 0u ? float(said) : meadow.species.at[slot].share;
        total += share[slot];
        painted += said;
    }
    // Strokes leave a share of the blades to what the meadow chooses.
    if (meadow.isMixed == 0u && painted > 0u) {
        const float kept = float(255u - min(painted, 255u));
        float sum = 0.0f;
        for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
            const uint said = sowByteOf(conditions.share[0], conditions.share[1], slot);
            share[slot] = kept * share[slot] + total * float(said);
            sum += share[slot];
        }
        total = sum;
    }
    if (meadow.drifts > 0.0f && total > 0.0f) {
        float wave[8];
        float mean = 0.0f;
        float blades = 0.0f;
        for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
            wave[slot] = 0.0f;
            if (share[slot] <= 0.0f)
                continue;
            wave[slot] = sowWaveOf(place, slot, meadow.species.at[slot].ribbons, waves);
            if (meadow.species.at[slot].ribbons > 0u)
                continue;
            mean += share[slot] * wave[slot];
            blades += share[slot];
        }
        if (blades > 0.0f)
            mean = (mean < 0.0f ? -1.0f : 1.0f) * sowDivide(abs(mean), blades);
        float sum = 0.0f;
        for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
            const float middle = meadow.species.at[slot].ribbons > 0u ? 1.0f : mean;
            wave[slot] = share[slot] * max(1.0f + meadow.drifts * (wave[slot] - middle), 0.0f);
            sum += wave[slot];
        }
        // Between colonies of a meadow without grass, plants stand as without drifts.
        if (sum > 0.0f) {
            total = sum;
            for (uint slot = 0u; slot < meadow.speciesCount; ++slot)
                share[slot] = wave[slot];
        }
    }
    // Blades of a clump are mostly of one species; plants stand alone.
    uint chosen = 0u;
    for (uint round = 0u; round < 2u; ++round) {
        float left = total * sowOwn(round == 0u ? own : clump, sowSpeciesDice);
        for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
            if (share[slot] <= 0.0f)
                continue;
            chosen = slot;
            left -= share[slot];
            if (left < 0.0f)
                break;
        }
        if (round == 1u || meadow.species.at[chosen].ribbons > 0u ||
            sowOwn(own, sowClumpDice) >= meadow.species.at[0].clumping)
            break;
        total = 0.0f;
        for (uint slot = 0u; slot < meadow.speciesCount; ++slot) {
            if (meadow.species.at[slot].ribbons > 0u)
                share[slot] = 0.0f;
            total += share[slot];
        }
        chosen = 0u;
    }
    return chosen;
}

/// An octahedral code as a vector of whole numbers, of any length.
SHARED_FN vec3 sowOctahedral(uint code)
{
    const int x = int(code & 255u) - 127;
    const int y = int((code >> 8u) & 255u) - 127;
    const int z = 127 - abs(x) - abs(y);
    if (z >= 0)
        return vec3(float(x), float(y), float(z));
    return vec3(float((127 - abs(y)) * (x >= 0 ? 1 : -1)),
                float((127 - abs(x)) * (y >= 0 ? 1 : -1)), float(z));
}

/// Sign of z by which decoders choose the frame around a decoded up-vector. On the octahedron's
/// equator, where z is 0, their rounding decides: decodeOctahedral() has it of these numbers.
SHARED_FN float sowFrameSign(uint code)
{
    const float x = float(int(code & 255u) - 127) * 0.00787401572f;
    const float y = float(int((code >> 8u) & 255u) - 127) * 0.00787401572f;
    return signNotZero(1.0f - abs(x) - abs(y));
}

/// The octahedral code nearest to a vector of any length above 0: encodeOctahedral() of its
/// direction, without a root.
SHARED_FN uint sowEncodeUp(vec3 v)
{
    const float sum = abs(v.x) + abs(v.y) + abs(v.z);
    if (sum <= 0.0f)
        return 127u | (254u << 8u); // (0, 1, 0)
    const float scale = sowDivide(1.0f, sum);
    float x = v.x * scale;
    float y = v.y * scale;
    if (v.z < 0.0f) {
        const float folded = (1.0f - abs(y)) * signNotZero(x);
        y = (1.0f - abs(x)) * signNotZero(y);
        x = folded;
    }
    const float x0 = floor(clamp(x, -1.0f, 1.0f) * 127.0f) + 127.0f;
    const float y0 = floor(clamp(y, -1.0f, 1.0f) * 127.0f) + 127.0f;
    uint best = 0u;
    float bestDot = 0.0f;
    float bestSquare = 1.0f;
    for (uint corner = 0u; corner < 4u; ++corner) {
        const uint code = uint(min(x0 + float(corner & 1u), 254.0f)) |
                          (uint(min(y0 + float(corner >> 1u), 254.0f)) << 8u);
        const vec3 d = sowOctahedral(code);
        const float along = max(sowDot(d, v), 0.0f);
        const float square = sowDot(d, d);
        // Compares cosines: along / √square.
        if (along * along * bestSquare > bestDot * bestDot * square || corner == 0u) {
            best = code;
            bestDot = along;
            bestSquare = square;
        }
    }
    return best;
}

/// Direction that the blades of a clump share: an edge of its triangle, turned in its plane by a
/// random number of the clump. Of any length; as bake::Clumps::Clump::direction().
SHARED_FN vec3 sowClumpDirection(vec3 first, vec3 second, uint64_t key)
{
    const vec3 normal = sowCross(first, second);
    const float square = sowDot(normal, normal);
    const vec3 edge = sowDot(first, first) > 0.05f * sowDot(second, second) ? first : second;
    if (square <= 0.0f)
        return edge;
    const float inverse = sowDivide(1.0f, sowSqrt(square));
    const vec3 across =
        sowCross(vec3(normal.x * inverse, normal.y * inverse, normal.z * inverse), edge);
    const vec2 turn = sowDirection(sowUnit(sowHash(sowHash(key, 0ul), 3ul)));
    return vec3(turn.x * edge.x + turn.y * across.x, turn.x * edge.y + turn.y * across.y,
                turn.x * edge.z + turn.y * across.z);
}

/// Key of the random numbers of a clump, as bake::Clumps.
SHARED_FN uint64_t sowClumpKey(uint64_t key, uint source, uint number)
{
    return sowHash(key, (uint64_t(source) << 32) | uint64_t(number));
}

/// Where a clump's centre lies.
SHARED_FN ivec3 sowClumpPlace(SeedVertex a, SeedVertex b, SeedVertex c, uint64_t key)
{
    const uint64_t bits = sowHash(key, 0ul);
    const SowPoint point =
        sowRandomPoint(sowUpper(sowHash(bits, 1ul)), sowUpper(sowHash(bits, 2ul)));
    return sowPlace(a, b, c, sowWeights(point));
}

/// Quantises a number ≥ 0 with this many steps per 1.
SHARED_FN uint sowSteps(float x, float perOne, uint largest)
{
    return uint(clamp(floor(x * perOne + 0.5f), 0.0f, float(largest)));
}

/// One coordinate in an octree cell of 2^bits units, in 65535ths of its side, rounded.
SHARED_FN uint sowPackCoordinate(int x, uint bits)
{
    const uint64_t inside = uint64_t(uint(x) & ((1u << bits) - 1u));
    return uint((inside * 65535ul + (uint64_t(1u) << (bits - 1u))) >> bits);
}

/// What a candidate is sown with.
struct SowRoot {
    uint64_t own; ///< hash of seed and key
    uint hash;    ///< [0, 15]
    ivec3 place;  ///< units from the cell's low corner
    vec3 up;      ///< direction of growth, of any length
    vec3 first;   ///< the triangle's edges from its first corner, of any common length
    vec3 second;
    uint level; ///< sowLevel()
};

/// A blade before its ribbons.
struct SownBlade {
    PackedBlade bits;
    uint species;
    float height; ///< [m] before quantisation
};

/// Turn of a width axis about a decoded up-vector, in turns.
SHARED_FN vec2 sowInFrame(vec3 axis, vec3 tangent, vec3 bitangent)
{
    return vec2(sowDot(axis, tangent), sowDot(axis, bitangent));
}

/// The turn of a width axis, turned by a share [0, 1] towards an axis of any length above 0.
SHARED_FN float sowTurnedTowards(float turn, vec2 aim, float share)
{
    const float inverse = sowDivide(1.0f, sowSqrt(aim.x * aim.x + aim.y * aim.y));
    const vec2 now = sowDirection(turn);
    return sowAtanTurns(now.y + share * (aim.y * inverse - now.y),
                        now.x + share * (aim.x * inverse - now.x));
}

/// The blade of a root. `waves` are the cell's.
SHARED_FN SownBlade sowBlade(SowMeadow meadow, SowRoot root, SowClump clump,
                             SeedConditions conditions, SowWaves waves, SowTones tones)
{
    const uint64_t clumpBits = sowHash(clump.key, 0ul);
    SownBlade sown;
    sown.species = sowSpecies(meadow, conditions, root.place, root.own, clumpBits, waves);
    const SowSpecies species = meadow.species.at[sown.species];

    // The frame of the decoder, around the decoded up-vector.
    const uint up = sowEncodeUp(root.up);
    const vec3 n = sowUnitVector(sowOctahedral(up));
    const float s = sowFrameSign(up);
    const float a = -s * sowDivide(1.0f, abs(s + n.z));
    const vec3 tangent = vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
    const vec3 bitangent = vec3(n.x * n.y * a, s + n.y * n.y * a, -n.y);

    // The width axis lies across what the blade leans to: away from the clump's centre, along its
    // direction, or along an edge of the triangle.
    vec3 ahead = vec3(0.0f, 0.0f, 0.0f);
    float spread = 1.0f;
    if (clump.isAny != 0u && species.facing == sowOutward) {
        ahead = sowDirectionOf(clump.offset);
        spread = 1.0f - 0.6f * species.clumping;
    } else if (clump.isAny != 0u && species.facing == sowShared) {
        ahead = clump.along;
        spread = 1.0f - 0.9f * species.clumping;
    }
    vec3 axis = sowCross(ahead, root.up);
    const float smallest = 1e-12f * sowDot(ahead, ahead) * sowDot(root.up, root.up);
    if (sowDot(axis, axis) <= smallest) {
        const vec3 first = sowCross(root.first, root.up);
        const vec3 second = sowCross(root.second, root.up);
        axis = sowDot(first, first) > 0.05f * sowDot(second, second) ? first : second;
        spread = 1.0f;
    }
    const vec2 across = sowInFrame(axis, tangent, bitangent);
    float turn =
        sowAtanTurns(across.y, across.x) + (sowOwn(root.own, sowFacingDice) - 0.5f) * spread;

    // Lain patches.
    const float lain = meadow.wideVariation * clump.wide.lain;
    if (lain > 0.0f) {
        const vec3 towards = clump.wide.towards;
        const vec3 aim = sowCross(towards, root.up);
        if (sowDot(aim, aim) > 1e-12f * sowDot(towards, towards) * sowDot(root.up, root.up))
            turn = sowTurnedTowards(turn, sowInFrame(aim, tangent, bitangent), 0.5f * lain);
    }

    // Beside a path blades lean away from it.
    const vec3 lean = vec3(float(int(conditions.lean & 255u) - 127),
                           float(int((conditions.lean >> 8u) & 255u) - 127),
                           float(int((conditions.lean >> 16u) & 255u) - 127));
    const float leanSquare = sowDot(lean, lean);
    if (leanSquare > 8.0f) {
        const vec2 aim = sowInFrame(sowCross(lean, n), tangent, bitangent);
        if (aim.x * aim.x + aim.y * aim.y > 0.25f)
            turn = sowTurnedTowards(turn, aim, min(sowSqrt(leanSquare) * 0.00787401575f, 1.0f));
    }
    const uint facing = uint(int(floor(turn * 256.0f + 0.5f))) & 255u;

    // Size.
    const float ownHeight = sowOwn(root.own, sowHeightDice);
    const float tall =
        ownHeight + 0.7f * species.clumping * (sowOwn(clumpBits, sowHeightDice) - ownHeight);
    const float ownStiffness = sowOwn(root.own, sowStiffnessDice);
    const float stiff = ownStiffness + 0.5f * species.clumping *
                                           (sowOwn(clumpBits, sowStiffnessDice) - ownStiffness);
    const uint vigourByte =
        sowIsMixed(meadow, conditions)
            ? sowByteOf(conditions.vigour[0], conditions.vigour[1], sown.species)
            : (conditions.size >> 16u) & 255u;
    const float vigour = float(vigourByte) * 0.00392156863f;
    float height = (species.heightLow + tall * species.heightRange) *
                   (float(conditions.size & 65535u) * 0.0001220703125f) *
                   (meadow.sparseHeight + (1.0f - meadow.sparseHeight) * vigour);
    const float shade = 1.0f - float((conditions.growth >> 16u) & 255u) * 0.00392156863f;
    const float moisture = clump.wide.moisture + 0.5f * shade;
    height *= sowWideHeight(meadow, moisture, clump.wide.grazed);
    if (meadow.heightWaves > 0.0f)
        height *= 1.0f + meadow.heightWaves * sowSlowWaves(root.place, waves.at[0], waves.at[1]);
    const uint room = conditions.size >> 24u;
    if (room < 255u)
        height = min(height, max(float(room) * 0.00392156863f * meadow.room, 0.05f * height));
    const float width = species.widthLow + sowOwn(root.own, sowWidthDice) * species.widthRange;
    const float stiffness = (species.stiffnessLow + stiff * species.stiffnessRange) *
                            (1.0f - 0.12f * lain) * float(conditions.look >> 24u) * 0.00392156863f;

    const float dry = float(conditions.growth >> 24u) * 0.00392156863f;
    uint number = min(uint(sowHash(clump.key, 1ul) & 255ul), driedClump - 1u);
    if (meadow.wideVariation > 0.0f && meadow.clumpReach > 0l)
        number = sowTonedNumber(meadow, tones, number, moisture, clump.wide.grazed);
    if (sowOwn(root.own, sowDrynessDice) < dry)
        number = driedClump;
    if (species.ribbons > 0u)
        number = 0u;

    const uint bits = meadow.unitBits + 5u - root.level;
    sown.height = height;
    sown.bits.rootXY =
        sowPackCoordinate(root.place.x, bits) | (sowPackCoordinate(root.place.y, bits) << 16u);
    sown.bits.rootZUp = sowPackCoordinate(root.place.z, bits) | (up << 16u);
    sown.bits.shape = facing | (sowSteps(height, meadow.heightsPerMetre, 255u) << 8u) |
                      (sowSteps(width, meadow.widthsPerMetre, 63u) << 16u) |
                      (sowSteps(stiffness, 63.0f, 63u) << 22u) | (root.hash << 28u);
    const uint red = ((conditions.look & 255u) * 31u + 127u) / 255u;
    const uint green = (((conditions.look >> 8u) & 255u) * 63u + 127u) / 255u;
    const uint blue = (((conditions.look >> 16u) & 255u) * 31u + 127u) / 255u;
    const uint exposure = (((conditions.growth >> 16u) & 255u) * 31u + 127u) / 255u;
    sown.bits.look = red | (green << 5u) | (blue << 11u) | (exposure << 16u) |
                     (sown.species << 21u) | (number << 24u);
    return sown;
}

/// Ribbon `number` of a stalk: `length` in heights of the stalk, `width` in lengths.
SHARED_FN PackedBlade sowRibbon(SowMeadow meadow, SownBlade stalk, uint number, float length,
                                float width)
{
    PackedBlade bits = stalk.bits;
    bits.shape = (bits.shape & ~(63u << 16u)) |
                 (sowSteps(stalk.height * length * width, meadow.widthsPerMetre, 63u) << 16u);
    bits.look = (bits.look & 0xffffffu) | (number << 24u);
    return bits;
}

SHARED_END
#endif
