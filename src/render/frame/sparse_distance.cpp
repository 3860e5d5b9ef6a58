#include "render/frame/frame.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::render {

float sparseDistance(const FieldShape& field, float full, float nearest)
{
    constexpr double twoPi = 6.283185307179586;
    // Whole units come: the ranks up to the next power of two, as the unit's nearest place wants
    // them. Coarse ranks have wide units, see field::unitLevel().
    const auto halfUnit = [&](double share) {
        const double level = field.sown.levels + std::ceil(0.5 * std::log2(std::max(share, 1e-9)));
        return 12.0 * std::exp2(-std::clamp(level - 3.0, 0.0, 4.0));
    };
    constexpr double maxNearer = 0.3; // where units are wider than what is around the eye
    // Units leave gaps between them, and some are for where eyes will be.
    constexpr double usable = 0.9;
    constexpr double forHere = 0.75;
    const double room = forHere * field.sown.room;
    const double all = field.sown.blades;
    if (all > 0.0 && all <= usable * field.sown.room)
        return 0.0f;
    // Shares fall with the distance. So most is drawn where all blades stand in a closed sward as
    // near as the content is.
    const double near = nearest;
    double farthest = near + glm::length(glm::dvec3(field.content.size()));
    if (all > 0.0)
        farthest = std::min(
            farthest, std::sqrt(near * near + 2.0 * all / (twoPi * field.sown.bladesPerArea)));
    // Rings of equal logarithms of their radii; a metre below the eye is one ring.
    constexpr int rings = 48;
    const double first = std::max(near, 1.0);
    const double ratio = std::pow(std::max(farthest / first, 1.0), 1.0 / rings);
    const double fullTo = std::max(double(full), 1e-6);
    const auto blades = [&](double s) {
        double sum = 0.0;
        double inner = near;
        double outer = first;
        for (int ring = 0; ring <= rings; ++ring, inner = outer, outer *= ratio) {
            const auto shareAt = [&](double r) {
                const double nearness = std::min(s / r, 1.0);
                return std::min(fullTo / r, 1.0) * nearness * nearness * nearness;
            };
            const double middle = 0.5 * (inner + outer);
            const double share = shareAt(
                std::max(middle - std::min(halfUnit(shareAt(middle)), maxNearer * middle), near));
            int exponent = 0;
            std::frexp(share, &exponent);
            if (share > field.sown.stored)
                sum += (outer * outer - inner * inner) * std::min(std::ldexp(1.0, exponent), 1.0);
        }
        return 0.5 * twoPi * field.sown.bladesPerArea * sum;
    };
    double low = 1e-3;
    double high = farthest;
    if (blades(high) <= room)
        return 0.0f;
    for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (low + high);
        (blades(middle) <= room ? low : high) = middle;
    }
    return static_cast<float>(low);
}

} // namespace sward::render
