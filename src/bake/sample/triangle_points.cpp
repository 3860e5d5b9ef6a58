#include "bake/sample/triangle_points.h"

#include "core/random.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::bake {
namespace {

// Keys of the random numbers of triangles, different from those of roots.
constexpr std::uint64_t placeSalt = 0x706c616365ULL;
constexpr std::uint64_t countSalt = 0x636f756e74ULL;

constexpr std::uint64_t backBit = 1ULL << 32;

std::uint32_t reverseBits(std::uint32_t x)
{
    x = (x & 0x55555555U) << 1 | (x >> 1 & 0x55555555U);
    x = (x & 0x33333333U) << 2 | (x >> 2 & 0x33333333U);
    x = (x & 0x0f0f0f0fU) << 4 | (x >> 4 & 0x0f0f0f0fU);
    return __builtin_bswap32(x);
}

// Scrambles from the low bits up: a hash of the lower bits flips each bit (Laine & Karras 2011,
// with the constants of Vegdahl 2021).
std::uint32_t scramble(std::uint32_t x, std::uint32_t seed)
{
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= seed >> 16 | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

// The second Sobol' matrix, its result with the lowest bit first: Pascal's triangle modulo 2.
std::uint32_t pascal(std::uint32_t x)
{
    x ^= (x & 0xaaaaaaaaU) >> 1;
    x ^= (x & 0xccccccccU) >> 2;
    x ^= (x & 0xf0f0f0f0U) >> 4;
    x ^= (x & 0xff00ff00U) >> 8;
    x ^= x >> 16;
    return x;
}

} // namespace

TrianglePoints::TrianglePoints(const terrain::GroundMesh& ground, std::size_t triangle)
    : TrianglePoints(ground, triangle, ground.faceNormal(triangle))
{
}

TrianglePoints::TrianglePoints(const terrain::GroundMesh& ground, std::size_t triangle,
                               const glm::dvec3& face)
    : triangle_(static_cast<std::uint32_t>(triangle))
    , face_(face)
{
    const glm::uvec3 corners = ground.triangles[triangle];
    corner_ = glm::dvec3(ground.positions[corners.x]);
    first_ = glm::dvec3(ground.positions[corners.y]) - corner_;
    second_ = glm::dvec3(ground.positions[corners.z]) - corner_;
    normal_[0] = glm::dvec3(ground.normals[corners.x]);
    normal_[1] = glm::dvec3(ground.normals[corners.y]);
    normal_[2] = glm::dvec3(ground.normals[corners.z]);
}

glm::dvec3 TrianglePoints::normalAt(double b, double c) const
{
    const glm::dvec3 sum = (1.0 - b - c) * normal_[0] + b * normal_[1] + c * normal_[2];
    const double squared = glm::dot(sum, sum);
    if (squared < 1e-12 || glm::dot(sum, face_) <= 0.0)
        return face_;
    return sum * (1.0 / std::sqrt(squared));
}

RootSample TrianglePoints::at(float b, float c, std::uint32_t candidate) const
{
    const auto wideB = static_cast<double>(b);
    const auto wideC = static_cast<double>(c);
    const glm::dvec3 normal = normalAt(wideB, wideC);
    RootSample root;
    root.triangle = triangle_;
    root.candidate = candidate;
    root.barycentric = glm::vec2(b, c);
    root.position = glm::vec3(corner_ + wideB * first_ + wideC * second_);
    root.normal = glm::vec3((candidate & backSide) != 0 ? -normal : normal);
    return root;
}

TriangleSequence::TriangleSequence(std::uint64_t seed, std::uint32_t source, bool back)
{
    const std::uint64_t bits = hashBits(seed ^ placeSalt, source | (back ? backBit : 0));
    first_ = static_cast<std::uint32_t>(bits);
    second_ = static_cast<std::uint32_t>(bits >> 32);
}

glm::vec2 TriangleSequence::at(std::uint32_t index) const
{
    constexpr double unit = 0x1.0p-32;
    const double u = (reverseBits(scramble(index, first_)) + 0.5) * unit;
    const double v = (reverseBits(scramble(pascal(index), second_)) + 0.5) * unit;
    const double s = std::sqrt(u);
    return {static_cast<float>(s * (1.0 - v)), static_cast<float>(s * v)};
}

double roundingShare(std::uint64_t seed, std::uint32_t source, bool back)
{
    // Assign sixteen strata to sixteen neighbours: bit-reversed numbers, randomly rotated.
    static constexpr std::uint32_t reversed[16] = {0, 8, 4, 12, 2, 10, 6, 14,
                                                   1, 9, 5, 13, 3, 11, 7, 15};
    const std::uint64_t side = back ? backBit : 0;
    const std::uint64_t group = hashBits(seed ^ countSalt, (source >> 4) | side | backBit << 1);
    const auto odd = static_cast<std::uint32_t>(group & 7) * 2 + 1;
    const auto shift = static_cast<std::uint32_t>(group >> 3 & 15);
    const std::uint32_t flip = static_cast<std::uint32_t>(group >> 7 & 15);
    const std::uint32_t stratum = reversed[(odd * (source & 15) + shift) & 15] ^ flip;
    const double jitter =
        static_cast<double>(hashBits(seed ^ countSalt, source | side) >> 11) * 0x1.0p-53;
    return (stratum + jitter) / 16.0;
}

} // namespace sward::bake
