#include "field/verify.h"

#include "core/error.h"
#include "field/seeds/seeds.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace sward::field {
namespace {

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isInUnit(float x)
{
    return x >= 0.0f && x <= 1.0f;
}

// Verifies the numbers of one patch.
void verifyPatchNumbers(const shared::Patch& patch, std::size_t index, const std::string& place)
{
    if (!isFinite(patch.boundsLow) || !isFinite(patch.boundsHigh) ||
        patch.boundsLow.x > patch.boundsHigh.x || patch.boundsLow.y > patch.boundsHigh.y ||
        patch.boundsLow.z > patch.boundsHigh.z)
        fail(ErrorKind::input, "{}: patch {} has no valid bounds", place, index);
    const float steps[] = {patch.rootStep, patch.heightLow, patch.heightStep, patch.widthLow,
                           patch.widthStep};
    for (const float step : steps)
        if (!std::isfinite(step) || step < 0.0f)
            fail(ErrorKind::input, "{}: patch {} has the quantisation step {}", place, index, step);
    if (!isFinite(patch.rootLow))
        fail(ErrorKind::input, "{}: patch {} has a root that is not finite", place, index);
    if (!isFinite(patch.coneAxis) || std::abs(glm::length(patch.coneAxis) - 1.0f) > 1e-3f ||
        !(patch.coneCosine >= -1.0f && patch.coneCosine <= 1.0f))
        fail(ErrorKind::input, "{}: patch {} has no valid normal cone", place, index);
    if (!isInUnit(patch.rankLow) || !isInUnit(patch.rankHigh) || patch.rankLow > patch.rankHigh)
        fail(ErrorKind::input, "{}: patch {} has ranks {} to {}, outside 0 to 1", place, index,
             patch.rankLow, patch.rankHigh);
    if (patch.bladeCount > shared::maxPatchBlades)
        fail(ErrorKind::input, "{}: patch {} owns {} blades, more than {}", place, index,
             patch.bladeCount, shared::maxPatchBlades);
}

void verifyGround(const DisplayGround& ground, const std::string& place)
{
    for (std::size_t v = 0; v < ground.vertices.size(); ++v) {
        const shared::GroundVertex& vertex = ground.vertices[v];
        if (!isFinite(vertex.position) || !std::isfinite(vertex.uv.x) ||
            !std::isfinite(vertex.uv.y))
            fail(ErrorKind::input, "{}: ground vertex {} is not finite", place, v);
    }
    for (const std::uint32_t index : ground.indices)
        if (index >= ground.vertices.size())
            fail(ErrorKind::input, "{}: ground index {} has no vertex; there are {}", place, index,
                 ground.vertices.size());
    for (const GroundRange& range : ground.ranges) {
        if (range.material >= ground.materials.size())
            fail(ErrorKind::input, "{}: ground material {} is missing; there are {}", place,
                 range.material, ground.materials.size());
        if (range.indexCount % 3 != 0 ||
            std::uint64_t(range.firstIndex) + range.indexCount > ground.indices.size())
            fail(ErrorKind::input, "{}: a ground range of {} indices from {} does not fit into {}",
                 place, range.indexCount, range.firstIndex, ground.indices.size());
    }
    for (const shared::GroundMaterial& material : ground.materials) {
        if (material.image != shared::noImage && material.image >= ground.images.size())
            fail(ErrorKind::input, "{}: ground image {} is missing; there are {}", place,
                 material.image, ground.images.size());
        if (!isFinite(
                glm::vec3(material.baseColor.x, material.baseColor.y, material.baseColor.z)) ||
            !isInUnit(material.roughness) || !isInUnit(material.metallic))
            fail(ErrorKind::input, "{}: a ground material is out of range", place);
    }
}

} // namespace

void verifyTree(std::span<const shared::Patch> patches, std::uint64_t blades,
                const std::string& place)
{
    std::uint64_t nextBlade = 0;
    std::uint64_t nextChild = 1;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const shared::Patch& patch = patches[p];
        verifyPatchNumbers(patch, p, place);
        // Blades must be contiguous.
        if (patch.firstBlade != nextBlade)
            fail(ErrorKind::input, "{}: patch {} begins at blade {} instead of {}", place, p,
                 patch.firstBlade, nextBlade);
        nextBlade += patch.bladeCount;
        // Children are contiguous, in the order of their parents: each has exactly one parent.
        if (p == 0 ? patch.parent != shared::noPatch || patch.level != 0 : patch.parent >= p)
            fail(ErrorKind::input, "{}: patch {} has the parent {}", place, p, patch.parent);
        if (patch.childCount > 8)
            fail(ErrorKind::input, "{}: patch {} has {} children, more than 8", place, p,
                 patch.childCount);
        if (patch.firstChild != (patch.childCount == 0 ? shared::noPatch : nextChild))
            fail(ErrorKind::input, "{}: patch {} has its children at {}", place, p,
                 patch.firstChild);
        nextChild += patch.childCount;
        if (p > 0) {
            const shared::Patch& parent = patches[patch.parent];
            if (p < parent.firstChild || p - parent.firstChild >= parent.childCount)
                fail(ErrorKind::input, "{}: patch {} is not a child of its parent {}", place, p,
                     patch.parent);
            if (patch.level != parent.level + 1)
                fail(ErrorKind::input, "{}: patch {} has level {}", place, p, patch.level);
        }
    }
    if (nextBlade != blades)
        fail(ErrorKind::input, "{}: the patches own {} blades, of {} that there are", place,
             nextBlade, blades);
    if (!patches.empty() && nextChild != patches.size())
        fail(ErrorKind::input, "{}: {} patches are reached from the root, of {} that there are",
             place, nextChild, patches.size());
}

void verifyKeys(const FieldView& field, const std::string& place)
{
    if (!field.keys.empty() && field.keys.size() != field.blades.size())
        fail(ErrorKind::input, "{}: {} keys for {} blades", place, field.keys.size(),
             field.blades.size());
}

BladeVerifier::BladeVerifier(const FieldView& field, std::string place)
    : field_(field)
    , place_(std::move(place))
{
    for (std::size_t i = 0; i < field.species.size(); ++i) {
        ribbons_[i] = ribbonsOf(field.species[i].organs);
        hasPlants_ = hasPlants_ || ribbons_[i] > 0;
    }
}

void BladeVerifier::add(std::span<const shared::PackedBlade> blades)
{
    for (std::size_t b = 0; b < blades.size(); ++b)
        if (((blades[b].look >> 21) & 7) >= field_.species.size())
            fail(ErrorKind::input, "{}: blade {} has species {}; there are {}", place_, next_ + b,
                 (blades[b].look >> 21) & 7, field_.species.size());
    if (hasPlants_)
        addPlants(blades);
    next_ += blades.size();
}

// Each ribbon of a compound plant follows its stalk in the same patch, with the stalk's data.
void BladeVerifier::addPlants(std::span<const shared::PackedBlade> blades)
{
    constexpr std::uint32_t widthBits = 63U << 16U;
    constexpr std::uint32_t clumpBits = 255U << 24U;
    for (std::size_t i = 0; i < blades.size(); ++i) {
        const std::size_t b = next_ + i;
        while (b >=
               std::size_t(field_.patches[patch_].firstBlade) + field_.patches[patch_].bladeCount)
            ++patch_;
        const shared::PackedBlade& blade = blades[i];
        const shared::PackedBlade before = std::exchange(last_, blade);
        const std::uint32_t number = blade.look >> 24U;
        const std::uint32_t ribbons = ribbons_[blade.look >> 21U & 7U];
        if (number == 0 || ribbons == 0)
            continue;
        if (number > ribbons)
            fail(ErrorKind::input, "{}: blade {} is ribbon {} of a plant with {}", place_, b,
                 number, ribbons);
        if (b == field_.patches[patch_].firstBlade || before.look >> 24U != number - 1 ||
            before.rootXY != blade.rootXY || before.rootZUp != blade.rootZUp ||
            ((before.shape ^ blade.shape) & ~widthBits) != 0 ||
            ((before.look ^ blade.look) & ~clumpBits) != 0)
            fail(ErrorKind::input, "{}: blade {} is ribbon {} without its stalk", place_, b,
                 number);
    }
}

void verifyBlades(const FieldView& field, const std::string& place)
{
    verifyKeys(field, place);
    verifyTree(field.patches, field.blades.size(), place);
    BladeVerifier(field, place).add(field.blades);
}

void verifyWithoutBlades(const FieldView& field, std::uint64_t blades, const std::string& place)
{
    if (!std::isfinite(field.origin.x) || !std::isfinite(field.origin.y) ||
        !std::isfinite(field.origin.z))
        fail(ErrorKind::input, "{}: the origin is not finite", place);
    if (field.species.empty() || field.species.size() > shared::maxSpecies)
        fail(ErrorKind::input, "{}: {} species, outside 1 to {}", place, field.species.size(),
             shared::maxSpecies);
    if (!(field.thinned >= 1.0 && field.thinned <= maxThinned))
        fail(ErrorKind::input, "{}: a meadow of {:.6g} times the leaf area, outside 1 to {}", place,
             field.thinned, maxThinned);
    verifyTree(field.patches, blades, place);
    if (field.seeds != nullptr)
        verifySeeds(*field.seeds, field.species.size(), place);
    verifyGround(*field.ground, place);
}

void verify(const FieldView& field, const std::string& place)
{
    verifyKeys(field, place);
    verifyWithoutBlades(field, field.blades.size(), place);
    BladeVerifier(field, place).add(field.blades);
}

} // namespace sward::field
