#pragma once

#include "core/bounds.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// What a patch says of the blades of its whole subtree, gathered from the leaves upwards: bounds
/// with the reach of every bent blade, and a cone about all up-vectors.
class SubtreeDescription {
public:
    /// What a finished subtree says to the patch above it; plain data.
    struct Summary {
        glm::vec3 boundsLow, boundsHigh;
        glm::dvec3 upSum; ///< of all up-vectors
        std::uint64_t count;
        glm::vec3 coneAxis;
        float coneCosine;
    };

    /// Adds blades of the patch's own.
    void addOwn(std::span<const shared::Blade> own);

    /// Adds a finished child.
    void addChild(const Summary& child);

    /// Settles the cone, once everything has been added, and writes it and the bounds.
    Summary finish(shared::Patch& patch);

private:
    struct Cone {
        glm::vec3 axis;
        float cosine;
    };

    Aabb box_;
    glm::dvec3 sum_{0.0}; ///< of all up-vectors
    std::uint64_t count_ = 0;
    std::vector<Cone> parts_; ///< of own blades (single directions) and children
};

/// Sets the steps by which the patch's own blades are quantised.
void describeOwn(shared::Patch& patch, std::span<const shared::Blade> own);

} // namespace sward::bake
