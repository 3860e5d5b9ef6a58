#pragma once

#include "shaders/shared/eyepoint.h"
#include "shaders/shared/patch.h"

#include <span>
#include <vector>

namespace sward::render {

/// How much blades are wanted by a frame's eyes. The score of a patch is the width of its blades,
/// as seen by the eye that wants them most, over the width at which level of detail draws its first
/// one: it is drawn if its score is above 1. Blades out of sight of all eyes score
/// much less.
class PageScores {
public:
    /// Lowest score of what is wanted at all: in sight, its first blade is drawn at half the
    /// distance.
    static constexpr float lowest = 1.0f / 16.0f;

    /// `views` draw in this frame, `ahead` are expected to later. `threshold` [pixels] is the blade
    /// width at which level of detail begins if all blades are resident.
    void look(std::span<const shared::Eyepoint> views, std::span<const shared::Eyepoint> ahead,
              float threshold);

    std::span<const shared::Eyepoint> views() const { return views_; }

    /// Shares of the blades that eyes draw at a node: the largest of any eye.
    struct Sight {
        float inSight = 0.0f; ///< of eyes that see it
        float drawn = 0.0f;   ///< of views that see it in this frame
        float anywhere = 0.0f;
        bool isOutside = true; ///< out of sight of all eyes
    };

    /// At the nearest place of a node's box: an upper bound for all nodes below. `isOutside`: its
    /// parent is. `widest`: Subtree::widest.
    Sight nearest(const shared::Patch& cell, float widest, bool isOutside) const;

    /// At the farthest place, in sight of an eye only if all of the box is: a lower bound for the
    /// patches below. `isRough`: at the nearest place instead.
    Sight farthest(const shared::Patch& cell, bool isRough) const;

    /// Whether the farthest place of a node's box is hardly farther than the nearest for any eye.
    bool isAboutAsFar(const shared::Patch& cell) const;

    /// The score of blades from `rank` on.
    static float scoreOf(const Sight& sight, float rank);

    /// The score in this frame's views alone; 0 if they do not see it.
    static float drawnScoreOf(const Sight& sight, float rank);

private:
    template <typename Each>
    void forEyes(const Each& each) const;
    void addNearest(const shared::Eyepoint& eye, bool isView, const shared::Patch& cell,
                    float widest, bool isOutside, Sight& sight) const;

    std::vector<shared::Eyepoint> views_;
    std::vector<shared::Eyepoint> ahead_;
    float threshold_ = 1.0f;
};

} // namespace sward::render
