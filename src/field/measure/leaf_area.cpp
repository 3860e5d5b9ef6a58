#include "field/measure/leaf_area.h"

#include "core/bounds.h"
#include "field/measure/cover_corners.h"
#include "field/measure/distributions.h"
#include "field/measure/leaf_heights.h"
#include "field/organs.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

/// Mean heights of clumps differ by this factor from the field's.
constexpr float clumpSpread = 1.2f;

/// Maximum blades whose colours are averaged.
constexpr std::size_t colorSamples = 100'000;

/// Colour of fallen leaves of last year, and its share of the undergrowth.
constexpr glm::vec3 litterColor(0.135f, 0.120f, 0.048f);
constexpr float litterShare = 0.35f;

/// Heights [of a blade] whose colours undergrowth and sward have.
constexpr float undergrowthHeight = 0.3f;
constexpr float swardHeight = 0.6f;

/// Size of the ground's largest crumbs [mean blade heights].
constexpr float largestCrumb = 0.6f;

/// Box of the drawn ground and the roots.
Aabb placesOf(const FieldView& field)
{
    Aabb places;
    for (const shared::GroundVertex& corner : field.ground->vertices)
        places.add(corner.position);
    for (const shared::Patch& cell : field.patches)
        if (cell.bladeCount > 0) {
            places.add(cell.rootLow);
            places.add(glm::min(cell.rootLow + 65535.0f * cell.rootStep, cell.boundsHigh));
        }
    return places;
}

shared::Cover shapeOf(const FieldView& field)
{
    const Aabb places = placesOf(field);
    const glm::vec3 size = places.size();
    const float longest = std::max({size.x, size.y, size.z});
    const float edge = std::max({longest / static_cast<float>(maxCoverCorners - 1),
                                 0.5f * meanBladeSize(field).height, 1e-6f});
    const auto corners = [&](float length) {
        const auto cells = static_cast<std::uint32_t>(std::ceil(length / edge));
        return std::clamp(cells + 1u, 2u, maxCoverCorners);
    };
    shared::Cover shape = {};
    shape.low = places.low;
    shape.cellsPerMetre = 1.0f / edge;
    shape.countX = corners(size.x);
    shape.countY = corners(size.y);
    shape.countZ = corners(size.z);
    return shape;
}

/// Deals the area of blades, and that times their height and their tone.
void dealBlades(const FieldView& field, CoverCorners& leaves, CoverCorners& heights,
                CoverCorners& tones)
{
    const double all = static_cast<double>(std::max<std::size_t>(field.blades.size(), 1));
    const double share = std::min(1.0, static_cast<double>(maxCoverBlades) / all);
    for (const shared::Patch& cell : field.patches)
        forSomeBlades(field.species, cell, field.blades, share, [&](const CoverBlade& blade) {
            leaves.deal(blade.root, blade.area);
            heights.deal(blade.root, blade.area * blade.height);
            tones.deal(blade.root, blade.area * blade.tone);
        });
}

} // namespace

shared::Cover LeafAreaGrid::view() const
{
    shared::Cover cover = shape;
    cover.grass.at = values.data();
    return cover;
}

shared::Cover coverShapeOf(const FieldView& field)
{
    return shapeOf(field);
}

LeafAreaGrid leafAreaOf(const FieldView& field)
{
    LeafAreaGrid grid;
    if (field.blades.empty())
        return grid;
    grid.shape = shapeOf(field);
    const LeafHeights leafHeights = leafHeightsOf(field);
    describeHeights(leafHeights, grid.shape);
    grid.meanHeight = leafHeights.mean;
    CoverCorners leaves(grid.shape);
    CoverCorners heights(grid.shape);
    CoverCorners tones(grid.shape);
    dealBlades(field, leaves, heights, tones);
    const std::vector<float> ground = groundAreasOf(field, grid.shape);
    grid.values.reserve(ground.size());
    for (std::size_t i = 0; i < ground.size(); ++i)
        grid.values.push_back(
            grassOf({leaves.amounts()[i], heights.amounts()[i], tones.amounts()[i]}, ground[i],
                    grid.meanHeight));
    return grid;
}

std::uint32_t grassOf(glm::vec3 leaves, float ground, float meanHeight)
{
    if (!(leaves.x > 0.0f))
        return 0;
    float relative = meanHeight > 0.0f ? leaves.y / leaves.x / meanHeight : 1.0f;
    // Clumps shade one another: only where all of the grass is lower or higher does that count.
    relative = relative < 1.0f ? std::min(relative * clumpSpread, 1.0f)
                               : std::max(relative / clumpSpread, 1.0f);
    // Halves hold 65 504.
    return shared::packGrass(std::min(leaves.x / ground, 1000.0f), std::min(relative, 60.0f),
                             leaves.z / leaves.x);
}

void describeUndergrowth(const FieldView& field, shared::Cover& cover)
{
    // Mean colours of the species, by leaf area.
    glm::vec3 roots(0.0f);
    glm::vec3 tips(0.0f);
    float leaves = 0.0f;
    const std::size_t stride = std::max<std::size_t>(field.blades.size() / colorSamples, 1);
    for (const shared::Patch& cell : field.patches) {
        const std::size_t end = std::size_t(cell.firstBlade) + cell.bladeCount;
        for (std::size_t i = (cell.firstBlade + stride - 1) / stride * stride; i < end;
             i += stride) {
            const shared::Blade blade = shared::unpackBlade(field.blades[i], cell);
            const BladePart part = partOf(field.species[blade.species], blade);
            const shared::Species& look = *part.look;
            const float area =
                part.length * blade.width * shared::outlineArea(look.shape, look.tipThreshold);
            roots += area * look.rootColor;
            tips += area * look.tipColor;
            leaves += area;
        }
    }
    cover.structure = largestCrumb * meanBladeSize(field).height;
    cover.thinned = static_cast<float>(field.thinned);
    if (leaves <= 0.0f)
        return;
    colorUndergrowth(roots / leaves, tips / leaves, cover);
}

void colorUndergrowth(const glm::vec3& root, const glm::vec3& tip, shared::Cover& cover)
{
    cover.undergrowth = glm::mix(glm::mix(root, tip, undergrowthHeight), litterColor, litterShare);
    cover.sward = glm::mix(root, tip, swardHeight);
}

} // namespace sward::field
