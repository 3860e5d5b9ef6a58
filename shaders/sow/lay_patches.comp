#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Lays the blades of an octree cell of a unit in order of rank, with their ribbons, and divides them into patches: as
// field::growUnit(), byte for byte. Bounds and cones of patches contain those of the CPU. A work-group for each cell.
#include "shaders/sow/batch.glsl"

layout(local_size_x = sowLayThreads) in;

const uint rankBins = 256u;

shared uint sortedBy[maxStalksOfCell];      // place in the list of each rank
shared uint binned[maxStalksOfCell];        // the same, of each bin of ranks, in any order
shared uint ranksOrStarts[maxStalksOfCell]; // ranks, then first blades
shared uint binEnds[rankBins];
shared uint sums[sowLayThreads];
shared uint total;
shared uint isRefused;
shared uint firstBlade;
shared uint lastStalk;
shared uint lows[3];
shared uint highs[3];
shared int upSums[3];
shared uint widestSteps;
shared uint cosine;

/// Numbers in the order of floats.
uint orderedBits(float x)
{
    const uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float floatOf(uint ordered)
{
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

/// Whether a record comes before another of its cell.
bool comesBefore(SowBatch batch, SowCell cell, uint a, float rankA, uint b, float rankB)
{
    if (rankA != rankB)
        return rankA < rankB;
    const SowRecord first = batch.sorted.at[a];
    const SowRecord second = batch.sorted.at[b];
    return keyOf(cell.pieces.at[first.piece], first.candidate) < keyOf(cell.pieces.at[second.piece], second.candidate);
}

uint speciesOf(SowStalk stalk)
{
    return (stalk.bits.look >> 21u) & 7u;
}

/// The first ribbon of a species.
uint firstRibbonOf(SowBatch batch, uint species)
{
    uint first = 0u;
    for (uint slot = 0u; slot < species; ++slot)
        first += batch.meadow.at[0].species.at[slot].ribbons;
    return first;
}

SownBlade sownOf(SowStalk stalk)
{
    SownBlade sown;
    sown.bits = stalk.bits;
    sown.species = speciesOf(stalk);
    sown.height = stalk.height;
    return sown;
}

uint binOf(SowOrder unit, float rank)
{
    const float share = (rank - unit.from) / (unit.share - unit.from);
    return uint(clamp(share * float(rankBins), 0.0f, float(rankBins - 1u)));
}

/// Puts the records of the cell into the order of ranks. The bins of ranks hold one or two each.
void orderStalks(SowBatch batch, SowCell cell, uint start, uint count, SowOrder unit)
{
    const uint thread = gl_LocalInvocationID.x;
    for (uint bin = thread; bin < rankBins; bin += sowLayThreads)
        binEnds[bin] = 0u;
    barrier();
    for (uint i = thread; i < count; i += sowLayThreads) {
        const float rank = batch.sorted.at[start + i].rank;
        ranksOrStarts[i] = floatBitsToUint(rank);
        atomicAdd(binEnds[binOf(unit, rank)], 1u);
    }
    barrier();
    // Two bins a thread.
    const uint first = binEnds[2u * thread];
    const uint both = first + binEnds[2u * thread + 1u];
    sums[thread] = both;
    barrier();
    for (uint step = 1u; step < sowLayThreads; step *= 2u) {
        const uint other = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += other;
        barrier();
    }
    binEnds[2u * thread] = sums[thread] - both;
    binEnds[2u * thread + 1u] = sums[thread] - both + first;
    barrier();
    for (uint i = thread; i < count; i += sowLayThreads)
        binned[atomicAdd(binEnds[binOf(unit, uintBitsToFloat(ranksOrStarts[i]))], 1u)] = i;
    barrier();
    for (uint i = thread; i < count; i += sowLayThreads) {
        const float rank = uintBitsToFloat(ranksOrStarts[i]);
        const uint bin = binOf(unit, rank);
        uint order = bin > 0u ? binEnds[bin - 1u] : 0u;
        for (uint k = order; k < binEnds[bin]; ++k) {
            const uint other = binned[k];
            const float otherRank = uintBitsToFloat(ranksOrStarts[other]);
            if (other != i && otherRank <= rank &&
                comesBefore(batch, cell, start + other, otherRank, start + i, rank))
                ++order;
        }
        sortedBy[order] = i;
    }
    barrier();
}

/// Finds the first blade of each stalk. Returns the number of blades.
uint countBlades(SowBatch batch, uint start, uint count)
{
    const uint thread = gl_LocalInvocationID.x;
    uint before = 0u;
    for (uint base = 0u; base < count; base += sowLayThreads) {
        const uint k = base + thread;
        uint own = 0u;
        if (k < count)
            own = 1u + batch.meadow.at[0].species.at[speciesOf(batch.stalks.at[start + sortedBy[k]])].ribbons;
        sums[thread] = own;
        barrier();
        for (uint step = 1u; step < sowLayThreads; step *= 2u) {
            const uint other = thread >= step ? sums[thread - step] : 0u;
            barrier();
            sums[thread] += other;
            barrier();
        }
        if (k < count)
            ranksOrStarts[k] = before + sums[thread] - own;
        before += sums[sowLayThreads - 1u];
        barrier();
    }
    return before;
}

void writeBlades(SowBatch batch, uint start, uint count)
{
    for (uint k = gl_LocalInvocationID.x; k < count; k += sowLayThreads) {
        const SowStalk stalk = batch.stalks.at[start + sortedBy[k]];
        const uint at = firstBlade + ranksOrStarts[k];
        batch.blades.at[at] = stalk.bits;
        const uint species = speciesOf(stalk);
        const uint first = firstRibbonOf(batch, species);
        const uint ribbons = batch.meadow.at[0].species.at[species].ribbons;
        for (uint i = 0u; i < ribbons; ++i)
            batch.blades.at[at + 1u + i] =
                sowRibbon(batch.meadow.at[0], sownOf(stalk), i + 1u, batch.ribbons.at[first + i].height,
                          batch.ribbons.at[first + i].width);
    }
}

/// Cosine of the sum of two angles in [0, π] given by their cosines; −1 from π on.
float cosineOfSum(float a, float b)
{
    if (a <= -b)
        return -1.0f;
    return a * b - sqrt(max((1.0f - a * a) * (1.0f - b * b), 0.0f));
}

/// Gathers box, sum of up-vectors and widest blade of the stalks of a patch.
void addToPatch(SowBatch batch, SowCell cell, uint start, uint first, uint end, SowOrder unit, uint cellNumber)
{
    SowMeadow meadow = batch.meadow.at[0];
    meadow.heightsPerMetre *= cell.heightScale;
    const uint bits = meadow.unitBits + 5u - unit.level;
    uvec3 at = uvec3(0u);
    for (uint bit = 0u; bit < 3u; ++bit)
        at |= ((uvec3(cellNumber) >> (3u * bit + uvec3(0u, 1u, 2u))) & 1u) << bit;
    const float side = float(1u << bits) * meadow.metresPerUnit;
    const vec3 corner = vec3(unit.low) * meadow.metresPerUnit + vec3(at) * side;
    vec3 low = vec3(3.0e38f);
    vec3 high = vec3(-3.0e38f);
    ivec3 ups = ivec3(0);
    uint widest = 0u;
    for (uint k = first + gl_LocalInvocationID.x; k < end; k += sowLayThreads) {
        const SowStalk stalk = batch.stalks.at[start + sortedBy[k]];
        const float height = float((stalk.bits.shape >> 8u) & 255u) / meadow.heightsPerMetre;
        uint steps = (stalk.bits.shape >> 16u) & 63u;
        float longest = height;
        const uint species = speciesOf(stalk);
        const uint firstRibbon = firstRibbonOf(batch, species);
        const uint ribbons = meadow.species.at[species].ribbons;
        for (uint i = 0u; i < ribbons; ++i) {
            const SowRibbon ribbon = batch.ribbons.at[firstRibbon + i];
            longest = max(longest, height * (1.0f + ribbon.longest));
            steps = max(steps, sowSteps(stalk.height * ribbon.height * ribbon.width, meadow.widthsPerMetre, 63u));
        }
        // As SubtreeDescription, and a little more.
        const float reach = 1.001f * (1.02f * longest + 0.55f * float(steps) / meadow.widthsPerMetre) + 1.0e-4f;
        const vec3 root = corner + side / 65535.0f * vec3(stalk.bits.rootXY & 65535u, stalk.bits.rootXY >> 16u,
                                                          stalk.bits.rootZUp & 65535u);
        low = min(low, root - reach);
        high = max(high, root + reach);
        ups += int(1u + ribbons) * ivec3(round(decodeOctahedral(stalk.bits.rootZUp >> 16u) * 65536.0f));
        widest = max(widest, steps);
    }
    for (int axis = 0; axis < 3; ++axis) {
        atomicMin(lows[axis], orderedBits(low[axis]));
        atomicMax(highs[axis], orderedBits(high[axis]));
        atomicAdd(upSums[axis], ups[axis]);
    }
    atomicMax(widestSteps, widest);
}

/// The axis of a cone of this many blades; 0 if their up-vectors cancel out.
vec3 axisOf(uint blades)
{
    const vec3 sum = vec3(upSums[0], upSums[1], upSums[2]) / 65536.0f;
    const float square = dot(sum, sum);
    return square > 1.0e-6f * float(blades * blades) ? sum / sqrt(square) : vec3(0.0f);
}

void makePatches(SowBatch batch, SowCell cell, uint cellIndex, uint start, uint count, SowOrder unit)
{
    const uint thread = gl_LocalInvocationID.x;
    for (uint first = 0u; first < count;) {
        if (thread == 0u) {
            lastStalk = count;
            for (int axis = 0; axis < 3; ++axis) {
                lows[axis] = 0xffffffffu;
                highs[axis] = 0u;
                upSums[axis] = 0;
            }
            widestSteps = 0u;
            cosine = orderedBits(1.0f);
        }
        barrier();
        // A stalk that does not fit begins the next patch.
        for (uint k = first + 1u + thread; k < count; k += sowLayThreads) {
            const uint end = k + 1u < count ? ranksOrStarts[k + 1u] : total;
            if (end - ranksOrStarts[first] > maxPatchBlades)
                atomicMin(lastStalk, k);
        }
        barrier();
        const uint end = lastStalk;
        addToPatch(batch, cell, start, first, end, unit, cellIndex % sowCells);
        barrier();
        const uint blades = (end < count ? ranksOrStarts[end] : total) - ranksOrStarts[first];
        const vec3 axis = axisOf(blades);
        // Up-vectors are packed with an angular error, see SubtreeDescription.
        const float packedUp = 1.0f - 0.5f * octahedralMaxError * octahedralMaxError;
        float least = 1.0f;
        for (uint k = first + gl_LocalInvocationID.x; k < end; k += sowLayThreads)
            least = min(least, cosineOfSum(clamp(dot(axis, decodeOctahedral(batch.stalks.at[start + sortedBy[k]].bits.rootZUp >> 16u)),
                                                 -1.0f, 1.0f),
                                           packedUp));
        atomicMin(cosine, orderedBits(least));
        barrier();
        if (thread == 0u) {
            const uint place = atomicAdd(batch.counts.at[0].patches, 1u);
            if (place < batch.maxPatches) {
                SowPatch patch_;
                patch_.boundsLow = vec3(floatOf(lows[0]), floatOf(lows[1]), floatOf(lows[2]));
                patch_.boundsHigh = vec3(floatOf(highs[0]), floatOf(highs[1]), floatOf(highs[2]));
                patch_.cell = cellIndex;
                patch_.firstBlade = firstBlade + ranksOrStarts[first];
                patch_.coneAxis = axis == vec3(0.0f) ? vec3(0.0f, 1.0f, 0.0f) : axis;
                patch_.coneCosine = axis == vec3(0.0f) ? -1.0f : max(floatOf(cosine) - 1.0e-5f, -1.0f);
                patch_.bladeCount = blades;
                patch_.widest = widestSteps;
                patch_.rankLow = batch.sorted.at[start + sortedBy[first]].rank;
                patch_.rankHigh = batch.sorted.at[start + sortedBy[end - 1u]].rank;
                batch.patches.at[place] = patch_;
            } else {
                batch.failed.at[cellIndex / sowCells] = 1u;
            }
        }
        barrier();
        first = end;
    }
}

void main()
{
    SowBatch batch = push.batch.at[0];
    const uint cellIndex = batch.growing.at[gl_WorkGroupID.x];
    const uint unitNumber = cellIndex / sowCells;
    const uint count = batch.cells.at[cellIndex];
    const uint start = batch.ends.at[cellIndex] - count;
    SowOrder unit = batch.units.at[unitNumber];
    SowCell cell = unit.cell.at[0];
    // The CPU grows what does not fit. Other work-groups may write the word meanwhile, so one thread reads it.
    if (gl_LocalInvocationID.x == 0u) {
        isRefused = count > maxStalksOfCell ? 1u : batch.failed.at[unitNumber];
        if (isRefused != 0u)
            batch.failed.at[unitNumber] = 1u;
    }
    barrier();
    if (isRefused != 0u)
        return;
    orderStalks(batch, cell, start, count, unit);
    const uint blades = countBlades(batch, start, count);
    if (gl_LocalInvocationID.x == 0u) {
        total = blades;
        firstBlade = atomicAdd(batch.counts.at[0].blades, blades);
        if (firstBlade + blades > batch.maxBlades)
            batch.failed.at[unitNumber] = 1u;
    }
    barrier();
    if (firstBlade + blades > batch.maxBlades)
        return;
    writeBlades(batch, start, count);
    makePatches(batch, cell, cellIndex, start, count, unit);
}
