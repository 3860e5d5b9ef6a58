#include "core/error.h"
#include "field/inspect.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

// Pairs (index in first, index in second) of blades to compare.
struct Pairing {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::uint64_t onlyFirst = 0;
    std::uint64_t onlySecond = 0;
};

// Indices of the blades with roots: ribbons repeat what their stalks say.
std::vector<std::size_t> rootedOf(const FieldView& field)
{
    std::vector<std::size_t> rooted;
    rooted.reserve(field.blades.size());
    for (std::size_t b = 0; b < field.blades.size(); ++b)
        if (!field.isRibbon(b))
            rooted.push_back(b);
    return rooted;
}

std::vector<std::size_t> orderById(const FieldView& field, std::vector<std::uint64_t>& ids)
{
    ids.resize(field.keys.size());
    std::transform(field.keys.begin(), field.keys.end(), ids.begin(), bladeId);
    std::vector<std::size_t> order = rootedOf(field);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return ids[a] != ids[b] ? ids[a] < ids[b] : a < b;
    });
    return order;
}

Pairing pairById(const FieldView& first, const FieldView& second)
{
    if (first.keys.size() != first.blades.size() || second.keys.size() != second.blades.size())
        fail(ErrorKind::input, "a field without blade keys cannot be matched by id");
    std::vector<std::uint64_t> firstIds;
    std::vector<std::uint64_t> secondIds;
    const std::vector<std::size_t> a = orderById(first, firstIds);
    const std::vector<std::size_t> b = orderById(second, secondIds);
    Pairing result;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        const std::uint64_t left = firstIds[a[i]];
        const std::uint64_t right = secondIds[b[j]];
        if (left == right)
            result.pairs.emplace_back(a[i++], b[j++]);
        else if (left < right)
            ++i, ++result.onlyFirst;
        else
            ++j, ++result.onlySecond;
    }
    result.onlyFirst += a.size() - i;
    result.onlySecond += b.size() - j;
    return result;
}

Pairing pairByOrder(const FieldView& first, const FieldView& second)
{
    const std::vector<std::size_t> a = rootedOf(first);
    const std::vector<std::size_t> b = rootedOf(second);
    const std::size_t common = std::min(a.size(), b.size());
    Pairing result;
    result.pairs.reserve(common);
    for (std::size_t i = 0; i < common; ++i)
        result.pairs.emplace_back(a[i], b[i]);
    result.onlyFirst = a.size() - common;
    result.onlySecond = b.size() - common;
    return result;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// A blade in world space, with the patch that quantised it.
struct Placed {
    shared::Blade blade;
    const shared::Patch& patch;
    glm::dvec3 root;
    glm::dvec3 up;
    glm::dvec3 axis;
};

Placed place(const FieldView& field, const std::vector<std::uint32_t>& patchOf, std::size_t index)
{
    const shared::Patch& patch = field.patches[patchOf[index]];
    const shared::Blade blade = shared::unpackBlade(field.blades[index], patch);
    return {blade, patch, field.origin + glm::dvec3(blade.root), glm::dvec3(blade.up),
            glm::dvec3(shared::widthAxis(blade.up, blade.facing))};
}

} // namespace

Comparison compare(const FieldView& first, const FieldView& second, const glm::dmat4& transform,
                   Match match, double tolerance)
{
    const glm::dmat3 linear(transform);
    const double scale = std::cbrt(std::abs(glm::determinant(linear)));
    const Pairing pairing =
        match == Match::id ? pairById(first, second) : pairByOrder(first, second);

    Comparison result;
    result.matched = pairing.pairs.size();
    result.onlyFirst = pairing.onlyFirst;
    result.onlySecond = pairing.onlySecond;
    const std::vector<std::uint32_t> firstPatches = patchOfBlades(first);
    const std::vector<std::uint32_t> secondPatches = patchOfBlades(second);

    // Both sides were rounded, so differences up to twice the packing error are ignored. A facing
    // is measured around a rounded up-vector.
    constexpr double upTolerance = 2.0 * double(shared::octahedralMaxError);
    constexpr double facingTolerance =
        2.0 * double(shared::facingMaxError + shared::octahedralMaxError);
    constexpr double stiffnessTolerance = 2.0 * double(shared::stiffnessMaxError) + 1e-6;
    for (const auto& [i, j] : pairing.pairs) {
        const Placed a = place(first, firstPatches, i);
        const Placed b = place(second, secondPatches, j);
        const glm::dvec3 moved = glm::dvec3(transform * glm::dvec4(a.root, 1.0));
        result.largestRootDistance =
            std::max(result.largestRootDistance, glm::distance(moved, b.root));
        result.largestUpAngle = std::max(result.largestUpAngle, angleBetween(linear * a.up, b.up));
        const double facing = angleBetween(linear * a.axis, b.axis);
        result.largestFacingAngle = std::max(result.largestFacingAngle, facing);

        const double heightError =
            std::abs(double(a.blade.height) * scale - double(b.blade.height));
        const double widthError = std::abs(double(a.blade.width) * scale - double(b.blade.width));
        result.largestHeightDifference = std::max(
            result.largestHeightDifference, heightError / std::max(double(b.blade.height), 1e-30));
        result.largestWidthDifference = std::max(
            result.largestWidthDifference, widthError / std::max(double(b.blade.width), 1e-30));
        const double heightTolerance =
            0.51 * (double(a.patch.heightStep) * scale + double(b.patch.heightStep)) +
            1e-5 * double(b.blade.height);
        const double widthTolerance =
            0.51 * (double(a.patch.widthStep) * scale + double(b.patch.widthStep)) +
            1e-5 * double(b.blade.width);
        if (heightError > heightTolerance || widthError > widthTolerance ||
            std::abs(double(a.blade.stiffness - b.blade.stiffness)) > stiffnessTolerance ||
            a.blade.species != b.blade.species || facing > facingTolerance)
            ++result.traitsDiffer;
    }

    // As documented at compare(): a transform changes last bits, and with them a few decisions.
    const double allowed = transform == glm::dmat4(1.0)
                               ? 0.0
                               : 1e-4 * double(std::max(first.blades.size(), second.blades.size()));
    if (double(result.onlyFirst + result.onlySecond) > allowed)
        result.reasons.push_back(
            fmt::format("{} blades are only in the first field, {} only in the second",
                        result.onlyFirst, result.onlySecond));
    if (result.largestRootDistance > tolerance)
        result.reasons.push_back(fmt::format("roots differ by up to {:.6g} m, more than {:.6g}",
                                             result.largestRootDistance, tolerance));
    if (result.largestUpAngle > upTolerance)
        result.reasons.push_back(
            fmt::format("up-vectors differ by up to {:.4g} rad, more than {:.4g}",
                        result.largestUpAngle, upTolerance));
    if (double(result.traitsDiffer) > allowed)
        result.reasons.push_back(
            fmt::format("{} blades differ in facing, height, width, stiffness or species",
                        result.traitsDiffer));
    result.comparesSeeds = transform == glm::dmat4(1.0);
    if (result.comparesSeeds)
        result.seeds = compareSeeds({first.seeds, first.origin}, {second.seeds, second.origin});
    result.reasons.insert(result.reasons.end(), result.seeds.reasons.begin(),
                          result.seeds.reasons.end());
    return result;
}

} // namespace sward::field
