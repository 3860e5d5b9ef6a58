#include "render/sowing/sown_view.h"

#include "field/seeds/seeds.h"

#include <algorithm>

namespace sward::render {
namespace {

constexpr float largestLeafArea = 1000.0f; ///< halves hold 65 504

} // namespace

bool isSown(const field::FieldView& field)
{
    return field.seeds != nullptr && !field.blades.empty() && field.seeds->meadow->stored > 0.0 &&
           field.seeds->meadow->stored < 1.0;
}

double bladesPerArea(const field::SeedMeadow& meadow)
{
    double shares = 0.0;
    double blades = 0.0;
    for (const shared::SowSpecies& kind : meadow.species) {
        shares += double(kind.share);
        blades += double(kind.share) * (1.0 + double(kind.ribbons));
    }
    return meadow.density * (shares > 0.0 ? blades / shares : 1.0);
}

SownView::SownView(const field::FieldView& stored)
    : patches_(stored.patches.begin(), stored.patches.end())
    , view_(stored)
    , share_(std::min(stored.seeds->meadow->stored, 1.0))
{
    const auto widening = static_cast<float>(stored.seeds->meadow->storedWidening);
    for (shared::Patch& patch : patches_)
        patch.widthStep /= widening;
    view_.patches = patches_;
    view_.thinned = 1.0;
}

SownDelta::SownDelta(const field::Delta& stored, float widening)
    : delta_(stored)
{
    for (field::CellChange& change : delta_.cells) {
        std::vector<shared::Patch>& own =
            patches_.emplace_back(change.patches.begin(), change.patches.end());
        for (shared::Patch& patch : own)
            patch.widthStep /= widening;
    }
    for (std::size_t i = 0; i < patches_.size(); ++i)
        delta_.cells[i].patches = patches_[i];
}

field::LeafAreaGrid SownView::leafArea() const
{
    field::LeafAreaGrid grid = field::leafAreaOf(view_);
    for (std::uint32_t& corner : grid.values) {
        const glm::vec3 grass = shared::unpackGrass(corner);
        if (!(grass.x > 0.0f))
            continue;
        const float leaves = std::min(grass.x / static_cast<float>(share_), largestLeafArea);
        corner = shared::packGrass(leaves, grass.y / grass.x, grass.z / grass.x);
    }
    return grid;
}

} // namespace sward::render
