#include "apps/sward/edit_pick.h"

#include "bake/patches/cell_tree.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace sward::apps {
namespace {

constexpr double bentShare = 0.05; ///< [heights] that blades bend aside of a straight line
constexpr int bladePieces = 8;     ///< places of a blade that are looked at

// Whether a line enters a box, and not farther away than `farthest`.
bool entersBox(const EditSight& sight, const glm::dvec3& eye, glm::dvec3 low, glm::dvec3 high)
{
    const double wide = sight.spread * sight.farthest;
    const glm::dvec3 toLow = (low - wide - eye) / sight.direction;
    const glm::dvec3 toHigh = (high + wide - eye) / sight.direction;
    double from = 0.0;
    double to = sight.farthest;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (sight.direction[axis] == 0.0) {
            if (eye[axis] < low[axis] - wide || eye[axis] > high[axis] + wide)
                return false;
            continue;
        }
        from = std::max(from, std::min(toLow[axis], toHigh[axis]));
        to = std::min(to, std::max(toLow[axis], toHigh[axis]));
    }
    return from <= to;
}

} // namespace

std::optional<std::uint32_t> speciesAlong(const bake::Session& session, const EditSight& sight)
{
    const glm::dvec3 eye = sight.eye - session.ground().origin;
    std::optional<std::uint32_t> species;
    double nearest = sight.farthest;
    for (const auto& [number, cell] : session.cells())
        for (const shared::Patch& patch : cell.patches) {
            if (patch.bladeCount == 0 ||
                !entersBox(sight, eye, glm::dvec3(patch.boundsLow), glm::dvec3(patch.boundsHigh)))
                continue;
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
                const shared::Blade blade =
                    shared::unpackBlade(cell.blades[patch.firstBlade + i], patch);
                const double height = double(blade.height);
                for (int piece = 0; piece <= bladePieces; ++piece) {
                    const glm::dvec3 place = glm::dvec3(blade.root) + height * double(piece) /
                                                                          double(bladePieces) *
                                                                          glm::dvec3(blade.up);
                    const double along = glm::dot(place - eye, sight.direction);
                    const double reach = 0.5 * double(blade.width) + sight.spread * along +
                                         (bentShare + 0.5 / double(bladePieces)) * height;
                    if (along <= 0.0 || along >= nearest ||
                        glm::length(place - eye - along * sight.direction) > reach)
                        continue;
                    nearest = along;
                    species = blade.species;
                }
            }
        }
    return species;
}

} // namespace sward::apps
