#pragma once

#include "field/field.h"
#include "field/measure/leaf_area.h"

#include <glm/vec3.hpp>

namespace sward::interchange {

/// What the renderer knows of a blade besides its shape, at its first level of detail.
struct DrawnLook {
    glm::vec3 root{0.0f};  ///< linear, with the blade's variation, clump and ground
    glm::vec3 tip{0.0f};   ///< linear; of a compound plant, of its stalk
    float leafArea = 0.0f; ///< m² of leaf per m² of ground around the root that shades the blade
};

/// The looks of a field's blades, by the shared functions of the renderer.
class DrawnLooks {
public:
    /// `field` must outlive this.
    explicit DrawnLooks(const field::FieldView& field);

    DrawnLook of(const shared::Blade& blade) const;

    /// The field's grass; valid as long as this.
    shared::Cover cover() const;

private:
    const field::FieldView* field_;
    field::LeafAreaGrid grid_;
};

} // namespace sward::interchange
