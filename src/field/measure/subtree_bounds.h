#pragma once

#include "core/bounds.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::field {

/// A blade, and how far it reaches beyond that.
struct GrownBlade {
    shared::Blade blade;
    std::uint32_t packedUp = 0; ///< encodeOctahedral(blade.up)
    float ribbon = 0.0f;        ///< [m] length of a ribbon on a stalk; 0 for all other blades
};

/// Bounds of all blades in a patch's subtree, gathered from the leaves upwards: a box with the
/// reach of every bent blade, and a cone about all up-vectors.
class SubtreeDescription {
public:
    /// Result of a finished subtree for its parent patch; plain data. All of it can be told from
    /// the patches of a field, see splitCells().
    struct Summary {
        glm::vec3 boundsLow, boundsHigh;
        std::uint64_t count; ///< blades
        glm::vec3 coneAxis;
        float coneCosine;
    };

    /// Adds the patch's own blades.
    void addOwn(std::span<const GrownBlade> own);

    /// Adds a finished child.
    void addChild(const Summary& child);

    /// Computes the cone after everything has been added; writes cone and bounds.
    Summary finish(shared::Patch& patch);

private:
    struct Cone {
        glm::vec3 axis;
        float cosine;
    };

    Aabb box_;
    glm::dvec3 sum_{0.0}; ///< of own up-vectors, and of the children's axes times their blades
    std::uint64_t count_ = 0;
    std::vector<Cone> parts_; ///< of own blades (single directions) and children
};

} // namespace sward::field
