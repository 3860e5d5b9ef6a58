#include "field/verify.h"

#include "core/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

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

void verifyTree(const FieldView& field, const std::string& place)
{
    std::uint64_t nextBlade = 0;
    std::uint64_t nextChild = 1;
    for (std::size_t p = 0; p < field.patches.size(); ++p) {
        const shared::Patch& patch = field.patches[p];
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
            const shared::Patch& parent = field.patches[patch.parent];
            if (p < parent.firstChild || p - parent.firstChild >= parent.childCount)
                fail(ErrorKind::input, "{}: patch {} is not a child of its parent {}", place, p,
                     patch.parent);
            if (patch.level != parent.level + 1)
                fail(ErrorKind::input, "{}: patch {} has level {}", place, p, patch.level);
        }
    }
    if (nextBlade != field.blades.size())
        fail(ErrorKind::input, "{}: the patches own {} blades, the file has {}", place, nextBlade,
             field.blades.size());
    if (!field.patches.empty() && nextChild != field.patches.size())
        fail(ErrorKind::input, "{}: {} patches are reached from the root, the file has {}", place,
             nextChild, field.patches.size());
}

// Verifies that each ribbon of a compound plant follows its stalk, with the stalk's data.
void verifyPlants(const FieldView& field, const std::string& place)
{
    std::array<std::uint32_t, shared::maxSpecies> ribbons{};
    for (std::size_t i = 0; i < field.species.size(); ++i)
        ribbons[i] = ribbonsOf(field.species[i].organs);
    if (std::all_of(ribbons.begin(), ribbons.end(), [](std::uint32_t n) { return n == 0; }))
        return;
    constexpr std::uint32_t widthBits = 63U << 16U;
    constexpr std::uint32_t clumpBits = 255U << 24U;
    for (const shared::Patch& patch : field.patches)
        for (std::size_t b = patch.firstBlade; b < patch.firstBlade + patch.bladeCount; ++b) {
            const shared::PackedBlade& blade = field.blades[b];
            const std::uint32_t number = blade.look >> 24U;
            if (number == 0 || ribbons[blade.look >> 21U & 7U] == 0)
                continue;
            if (number > ribbons[blade.look >> 21U & 7U])
                fail(ErrorKind::input, "{}: blade {} is ribbon {} of a plant with {}", place, b,
                     number, ribbons[blade.look >> 21U & 7U]);
            const shared::PackedBlade& before = field.blades[std::max<std::size_t>(b, 1) - 1];
            if (b == patch.firstBlade || before.look >> 24U != number - 1 ||
                before.rootXY != blade.rootXY || before.rootZUp != blade.rootZUp ||
                ((before.shape ^ blade.shape) & ~widthBits) != 0 ||
                ((before.look ^ blade.look) & ~clumpBits) != 0)
                fail(ErrorKind::input, "{}: blade {} is ribbon {} without its stalk", place, b,
                     number);
        }
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

void verifyKeys(const FieldView& field, const std::string& place)
{
    if (!field.keys.empty() && field.keys.size() != field.blades.size())
        fail(ErrorKind::input, "{}: {} keys for {} blades", place, field.keys.size(),
             field.blades.size());
}

void verifyBlades(const FieldView& field, const std::string& place)
{
    verifyKeys(field, place);
    verifyTree(field, place);
    for (std::size_t b = 0; b < field.blades.size(); ++b)
        if (((field.blades[b].look >> 21) & 7) >= field.species.size())
            fail(ErrorKind::input, "{}: blade {} has species {}; there are {}", place, b,
                 (field.blades[b].look >> 21) & 7, field.species.size());
    verifyPlants(field, place);
}

void verify(const FieldView& field, const std::string& place)
{
    if (!std::isfinite(field.origin.x) || !std::isfinite(field.origin.y) ||
        !std::isfinite(field.origin.z))
        fail(ErrorKind::input, "{}: the origin is not finite", place);
    if (field.species.empty() || field.species.size() > shared::maxSpecies)
        fail(ErrorKind::input, "{}: {} species, outside 1 to {}", place, field.species.size(),
             shared::maxSpecies);
    if (!(field.thinned >= 1.0 && field.thinned <= maxThinned))
        fail(ErrorKind::input, "{}: a meadow of {} times the leaf area, outside 1 to {}", place,
             field.thinned, maxThinned);
    verifyBlades(field, place);
    verifyGround(*field.ground, place);
}

} // namespace sward::field
