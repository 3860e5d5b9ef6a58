#include "terrain/procedural/noise.h"

#include "core/random.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::terrain {
namespace {

struct Cell {
    std::int64_t x, y, z;
};

std::uint64_t hashCell(std::uint64_t seed, const Cell& cell)
{
    return hashBits(hashBits(hashBits(seed, static_cast<std::uint64_t>(cell.x)),
                             static_cast<std::uint64_t>(cell.y)),
                    static_cast<std::uint64_t>(cell.z));
}

// Unit gradient of a lattice point: its first random point in the unit ball, normalised to length
// 1.
glm::dvec3 gradientAt(std::uint64_t seed, const Cell& cell)
{
    constexpr double step = 2.0 / 2097151.0; // 21 bits a coordinate onto [−1, 1]
    std::uint64_t bits = hashCell(seed, cell);
    while (true) {
        const glm::dvec3 v(static_cast<double>(bits & 0x1fffffU) * step - 1.0,
                           static_cast<double>((bits >> 21) & 0x1fffffU) * step - 1.0,
                           static_cast<double>((bits >> 42) & 0x1fffffU) * step - 1.0);
        const double square = glm::dot(v, v);
        if (square <= 1.0 && square > 1e-4)
            return v / std::sqrt(square);
        bits = mixBits(bits + 0x9e3779b97f4a7c15ULL);
    }
}

// 6t⁵ − 15t⁴ + 10t³ (Perlin 2002): first and second derivative vanish at both ends.
double fade(double t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double lerp(double a, double b, double t)
{
    return a + t * (b - a);
}

// Uses a different lattice per octave, so that their zeros do not coincide.
std::uint64_t octaveSeed(std::uint64_t seed, int octave)
{
    return hashBits(seed, static_cast<std::uint64_t>(octave));
}

} // namespace

double gradientNoise(std::uint64_t seed, const glm::dvec3& point)
{
    const glm::dvec3 base(std::floor(point.x), std::floor(point.y), std::floor(point.z));
    const glm::dvec3 in = point - base;
    const Cell cell{static_cast<std::int64_t>(base.x), static_cast<std::int64_t>(base.y),
                    static_cast<std::int64_t>(base.z)};

    // Evaluate each corner's gradient at the point.
    double ramps[8];
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1;
        const int dy = (corner >> 1) & 1;
        const int dz = corner >> 2;
        ramps[corner] = glm::dot(gradientAt(seed, {cell.x + dx, cell.y + dy, cell.z + dz}),
                                 in - glm::dvec3(dx, dy, dz));
    }

    // Blend them.
    const double u = fade(in.x);
    const double v = fade(in.y);
    const double w = fade(in.z);
    const double front = lerp(lerp(ramps[0], ramps[1], u), lerp(ramps[2], ramps[3], u), v);
    const double back = lerp(lerp(ramps[4], ramps[5], u), lerp(ramps[6], ramps[7], u), v);
    return lerp(front, back, w);
}

double fractalNoise(std::uint64_t seed, const glm::dvec3& point, const Octaves& octaves)
{
    double sum = 0.0;
    double total = 0.0;
    double amplitude = 1.0;
    double frequency = 1.0;
    for (int octave = 0; octave < octaves.count; ++octave) {
        sum += amplitude * gradientNoise(octaveSeed(seed, octave), point * frequency);
        total += amplitude;
        amplitude *= octaves.gain;
        frequency *= octaves.lacunarity;
    }
    return total > 0.0 ? sum / total : 0.0;
}

double ridgedNoise(std::uint64_t seed, const glm::dvec3& point, const Octaves& octaves)
{
    double sum = 0.0;
    double total = 0.0;
    double amplitude = 1.0;
    double frequency = 1.0;
    for (int octave = 0; octave < octaves.count; ++octave) {
        const double noise = gradientNoise(octaveSeed(seed, octave), point * frequency);
        sum += amplitude * (1.0 - std::fabs(noise));
        total += amplitude;
        amplitude *= octaves.gain;
        frequency *= octaves.lacunarity;
    }
    return total > 0.0 ? sum / total : 1.0;
}

} // namespace sward::terrain
