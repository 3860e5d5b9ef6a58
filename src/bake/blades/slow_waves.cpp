#include "bake/blades/slow_waves.h"

#include "core/math/wide_registers.h"
#include "core/random.h"
#include "shaders/shared/noise.h"

namespace sward::bake {
namespace {

constexpr std::size_t count = PlaceBlock::size;

// The lattice cells of a block's places along one axis, and the smooth weights of their farther
// corners.
struct Axis {
    alignas(32) std::uint32_t cell[count];
    alignas(32) float weight[count];
};

// The largest whole number that is not above `x`. std::floor() is a call without SSE 4.1; this sum
// rounds to a whole number below 2⁵². Larger numbers are whole.
[[gnu::always_inline]] inline double floorAt(double x)
{
    constexpr double rounding = 0x1.8p52;
    const double near = (x + rounding) - rounding;
    return near > x ? near - 1.0 : near;
}

[[gnu::always_inline]] inline void divide(const double* places, double length, std::uint32_t origin,
                                          Axis& axis)
{
    // A place farther than this from the origin gets the wave of the border.
    constexpr double farthest = 0x1p51;
    // Cells are numbered modulo 2³².
    constexpr double numbers = 0x1p32;
    for (std::size_t i = 0; i < count; ++i) {
        const double scaled = places[i] / length;
        const double above = scaled < -farthest ? -farthest : scaled;
        const double place = above > farthest ? farthest : above;
        const double cell = floorAt(place);
        const double number = cell - numbers * floorAt(cell * (1.0 / numbers));
        axis.cell[i] =
            (static_cast<std::uint32_t>(static_cast<std::int32_t>(number - 0.5 * numbers)) ^
             0x80000000U) +
            origin;
        const auto f = static_cast<float>(place - cell);
        axis.weight[i] = f * f * (3.0f - 2.0f * f);
    }
}

// Height of a lattice point in [-1, 1).
[[gnu::always_inline]] inline float heightAt(std::uint32_t point)
{
    // As shared::latticeHeight(), around its middle: a conversion of signed numbers is cheaper.
    point ^= point >> 11U;
    point *= 0x31848babU;
    return static_cast<float>(static_cast<std::int32_t>(point ^ 0x80000000U)) * 0x1p-31f;
}

[[gnu::always_inline]] inline float between(float a, float b, float share)
{
    return a + share * (b - a);
}

// Height between four lattice points of a plane across z.
[[gnu::always_inline]] inline float heightOfEdges(std::uint32_t point, float x, float y)
{
    const std::uint32_t upper = point + shared::latticeY;
    const float low = between(heightAt(point), heightAt(point + shared::latticeX), x);
    const float high = between(heightAt(upper), heightAt(upper + shared::latticeX), x);
    return between(low, high, y);
}

// Adds one wave. As shared::valueNoise(), but cells are numbered in double precision, for ground
// far from the origin.
[[gnu::always_inline]] inline void addWave(const PlaceBlock& places, double length, float high,
                                           std::uint64_t key, BlockOfFloats& waves)
{
    Axis x;
    Axis y;
    Axis z;
    const auto origin = [&](std::uint64_t axis) {
        return static_cast<std::uint32_t>(hashBits(key, axis));
    };
    divide(places.x.data(), length, origin(0), x);
    divide(places.y.data(), length, origin(1), y);
    divide(places.z.data(), length, origin(2), z);
    using shared::latticeZ;
    float* const sums = waves.data();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t point =
            x.cell[i] * shared::latticeX + y.cell[i] * shared::latticeY + z.cell[i] * latticeZ;
        const float near = heightOfEdges(point, x.weight[i], y.weight[i]);
        const float far = heightOfEdges(point + latticeZ, x.weight[i], y.weight[i]);
        sums[i] += high * between(near, far, z.weight[i]);
    }
}

[[gnu::always_inline]] inline void sumOfWaves(const PlaceBlock& places, double shorter,
                                              double longer, std::uint64_t seed,
                                              BlockOfFloats& waves)
{
    waves.fill(0.0f);
    addWave(places, shorter, 0.75f, hashBits(seed, 0), waves);
    addWave(places, longer, 0.5f, hashBits(seed, 1), waves);
    for (float& wave : waves)
        wave = wave < -1.0f ? -1.0f : wave > 1.0f ? 1.0f : wave;
}

SWARD_WIDE void wideWaves(const PlaceBlock& places, double shorter, double longer,
                          std::uint64_t seed, BlockOfFloats& waves)
{
    sumOfWaves(places, shorter, longer, seed, waves);
}

} // namespace

void slowWaves(const PlaceBlock& places, double shorter, double longer, std::uint64_t seed,
               BlockOfFloats& waves, bool wide)
{
    if (wide)
        wideWaves(places, shorter, longer, seed, waves);
    else
        sumOfWaves(places, shorter, longer, seed, waves);
}

void slowWaves(const PlaceBlock& places, double shorter, double longer, std::uint64_t seed,
               BlockOfFloats& waves)
{
    slowWaves(places, shorter, longer, seed, waves, hasWideRegisters());
}

double slowWaves(glm::dvec3 place, double shorter, double longer, std::uint64_t seed)
{
    PlaceBlock places;
    places.x.fill(place.x);
    places.y.fill(place.y);
    places.z.fill(place.z);
    BlockOfFloats waves;
    slowWaves(places, shorter, longer, seed, waves);
    return double(waves[0]);
}

} // namespace sward::bake
