#include "bake/blades/slow_waves.h"

#include "core/random.h"
#include "shaders/shared/noise.h"

#include <glm/common.hpp>

#include <algorithm>

namespace sward::bake {
namespace {

// One wave in [-1, 1]. As shared::valueNoise(), but in double precision, for ground far from the
// origin.
double waveAt(glm::dvec3 place, double length, std::uint64_t key)
{
    // Numbers of cells must fit into 64 bits, whatever the blade scale.
    const glm::dvec3 p = glm::clamp(place / length, -1e18, 1e18);
    const glm::dvec3 cell = glm::floor(p);
    const glm::dvec3 f = p - cell;
    const glm::dvec3 s = f * f * (3.0 - 2.0 * f);
    // Numbers of cells are taken modulo 2³², from an origin that depends on the seed.
    const auto number = [&](double coordinate, std::uint64_t axis) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(
            static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)) +
            hashBits(key, axis)));
    };
    const std::int32_t x = number(cell.x, 0);
    const std::int32_t y = number(cell.y, 1);
    const std::int32_t z = number(cell.z, 2);
    double sum = 0.0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const bool right = (corner & 1U) != 0;
        const bool upper = (corner & 2U) != 0;
        const bool front = (corner & 4U) != 0;
        const std::uint32_t point =
            shared::latticePoint(x, y, z) + (right ? shared::latticeX : 0U) +
            (upper ? shared::latticeY : 0U) + (front ? shared::latticeZ : 0U);
        sum += (right ? s.x : 1.0 - s.x) * (upper ? s.y : 1.0 - s.y) * (front ? s.z : 1.0 - s.z) *
               double(shared::latticeHeight(point));
    }
    return 2.0 * sum * double(shared::latticeUnit) - 1.0;
}

} // namespace

double slowWaves(glm::dvec3 place, double shorter, double longer, std::uint64_t seed)
{
    return std::clamp(0.75 * waveAt(place, shorter, hashBits(seed, 0)) +
                          0.5 * waveAt(place, longer, hashBits(seed, 1)),
                      -1.0, 1.0);
}

} // namespace sward::bake
