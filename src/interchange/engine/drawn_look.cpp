#include "interchange/engine/drawn_look.h"

#include "shaders/shared/look/blade_colors.h"
#include "shaders/shared/organ.h"

#include <limits>

namespace sward::interchange {

DrawnLooks::DrawnLooks(const field::FieldView& field)
    : field_(&field)
    , grid_(field::leafAreaOf(field))
{
    field::describeUndergrowth(field, grid_.shape);
    grid_.shape.thatch = 1.0f;
    grid_.shape.farthest = std::numeric_limits<float>::max();
}

shared::Cover DrawnLooks::cover() const
{
    return grid_.view();
}

DrawnLook DrawnLooks::of(const shared::Blade& blade) const
{
    const field::Species& species = field_->species[blade.species];
    const shared::Cover cover = grid_.view();
    shared::Blade toned = blade;
    // All parts of a plant have one tone.
    if (!species.organs.empty())
        toned.clump = shared::plantKey(blade) % shared::driedClump;
    const float leafArea = shared::leafAreaAt(cover, blade.root);
    const shared::BladeColors colors = shared::bladeColors(cover, toned, species.look, leafArea);
    return {.root = colors.root,
            .tip = colors.tip,
            .leafArea = shared::leavesAround(leafArea, cover.thinned)};
}

} // namespace sward::interchange
