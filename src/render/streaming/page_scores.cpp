#include "render/streaming/page_scores.h"

#include "shaders/shared/visibility.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace sward::render {
namespace {

/// The score of blades out of sight: a 32nd where all would be drawn, and in proportion to the
/// square of their width farther away. An eye that turns finds the nearest ones, and they take
/// little memory from what is in sight.
float outOfSight(float share)
{
    return 0.03125f * share * std::min(share, 1.0f);
}

/// The coarsest blades of a place have rank 0.
constexpr float lowestRank = 1e-6f;

/// Distances within this factor count as equal.
constexpr float aboutAsFar = 1.41f;

float nearestOf(const shared::Eyepoint& eye, const shared::Patch& cell)
{
    return shared::boxDistance(eye.eye, cell.boundsLow, cell.boundsHigh);
}

float farthestOf(const shared::Eyepoint& eye, const shared::Patch& cell)
{
    return glm::length(
        glm::max(glm::abs(cell.boundsLow - eye.eye), glm::abs(cell.boundsHigh - eye.eye)));
}

/// Share of a threshold's blades at `distance`, without its upper limit.
float shareAtDistance(const shared::Eyepoint& eye, float threshold, float distance)
{
    return eye.lodWidth * eye.pixelsPerUnit / (std::max(distance, 1e-6f) * threshold);
}

/// Whether no part of a box is culled in a view.
bool isInside(const shared::Eyepoint& eye, const shared::Patch& cell, float farthest)
{
    if ((eye.cullMask & shared::cullPatch) == 0)
        return true;
    for (const glm::vec4& plane : eye.planes)
        if (shared::boxOutside(-plane, cell.boundsLow, cell.boundsHigh) == false)
            return false;
    return (eye.cullMask & shared::cullDistance) == 0 || farthest <= eye.drawDistance;
}

} // namespace

void PageScores::look(std::span<const shared::Eyepoint> views,
                      std::span<const shared::Eyepoint> ahead, float threshold)
{
    views_.assign(views.begin(), views.end());
    ahead_.assign(ahead.begin(), ahead.end());
    threshold_ = std::max(threshold, 1e-6f);
}

void PageScores::addNearest(const shared::Eyepoint& eye, bool isView, const shared::Patch& cell,
                            float widest, bool isOutside, Sight& sight) const
{
    const float share = shareAtDistance(eye, threshold_, nearestOf(eye, cell));
    sight.anywhere = std::max(sight.anywhere, share);
    if (isOutside || shared::patchCulled(eye, cell, widest))
        return;
    sight.isOutside = false;
    sight.inSight = std::max(sight.inSight, share);
    if (isView)
        sight.drawn = std::max(sight.drawn, share);
}

PageScores::Sight PageScores::nearest(const shared::Patch& cell, float widest, bool isOutside) const
{
    Sight sight;
    for (const shared::Eyepoint& eye : views_)
        addNearest(eye, true, cell, widest, isOutside, sight);
    for (const shared::Eyepoint& eye : ahead_)
        addNearest(eye, false, cell, widest, isOutside, sight);
    return sight;
}

template <typename Each>
void PageScores::forEyes(const Each& each) const
{
    std::ranges::for_each(views_, each);
    std::ranges::for_each(ahead_, each);
}

PageScores::Sight PageScores::farthest(const shared::Patch& cell, bool isRough) const
{
    Sight sight;
    forEyes([&](const shared::Eyepoint& eye) {
        const float most = farthestOf(eye, cell);
        const float share = shareAtDistance(eye, threshold_, isRough ? nearestOf(eye, cell) : most);
        sight.anywhere = std::max(sight.anywhere, share);
        if (!isInside(eye, cell, most))
            return;
        sight.isOutside = false;
        sight.inSight = std::max(sight.inSight, share);
    });
    return sight;
}

bool PageScores::isAboutAsFar(const shared::Patch& cell) const
{
    bool isSame = true;
    forEyes([&](const shared::Eyepoint& eye) {
        isSame = isSame && farthestOf(eye, cell) <= aboutAsFar * nearestOf(eye, cell);
    });
    return isSame;
}

float PageScores::scoreOf(const Sight& sight, float rank)
{
    const float seen = sight.inSight / std::max(rank, lowestRank);
    // What is in sight and not drawn yet is worth less the farther it is from being drawn; at half
    // the distance as much as what is drawn but out of sight.
    const float squared = seen * seen;
    return std::max(seen >= 1.0f ? seen : squared * squared,
                    outOfSight(sight.anywhere) / std::max(rank, lowestRank));
}

float PageScores::drawnScoreOf(const Sight& sight, float rank)
{
    return sight.drawn / std::max(rank, lowestRank);
}

} // namespace sward::render
