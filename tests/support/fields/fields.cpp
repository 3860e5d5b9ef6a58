#include "support/fields/fields.h"

#include "core/bounds.h"
#include "core/random.h"
#include "support/fields/display_ground.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

namespace sward::test {
namespace {

// Half of a patch's maximum, so that small fields have enough patches.
constexpr std::uint32_t maxOwned = shared::maxPatchBlades / 2;

/// Random numbers of one blade.
struct Dice {
    std::uint64_t seed;
    std::size_t blade;

    float between(float low, float high, std::uint32_t dimension) const
    {
        return low + (high - low) * static_cast<float>(uniform(seed, blade, dimension));
    }
    std::uint32_t below(std::uint32_t bound, std::uint32_t dimension) const
    {
        return static_cast<std::uint32_t>(uniform(seed, blade, dimension) * bound);
    }
};

/// Uniform on the unit sphere (Archimedes: the height is uniform).
glm::vec3 direction(const Dice& dice, std::uint32_t dimension)
{
    const float z = dice.between(-1.0f, 1.0f, dimension);
    const float angle = dice.between(0.0f, shared::twoPi, dimension + 1);
    const float side = std::sqrt(std::max(1.0f - z * z, 0.0f));
    return {side * std::cos(angle), side * std::sin(angle), z};
}

shared::Blade makeBlade(const FieldSettings& settings, std::size_t index)
{
    const Dice dice{settings.seed, index};
    const float half = 0.5f * settings.extent;
    shared::Blade blade = {};
    switch (settings.surface) {
    case Surface::cloud:
        blade.root = {dice.between(-half, half, 0), dice.between(-half, half, 1),
                      dice.between(-half, half, 2)};
        blade.up = direction(dice, 3);
        break;
    case Surface::plane:
        blade.root = {dice.between(-half, half, 0), 0.0f, dice.between(-half, half, 2)};
        blade.up = {0.0f, 1.0f, 0.0f};
        break;
    case Surface::sphere:
        blade.up = direction(dice, 3);
        blade.root = half * blade.up;
        break;
    }
    blade.facing = dice.between(0.0f, shared::twoPi, 5);
    blade.stiffness = dice.between(0.3f, 0.8f, 6);
    blade.height = dice.between(settings.heightLow, settings.heightHigh, 7);
    blade.width = dice.between(settings.widthLow, settings.widthHigh, 8);
    blade.exposure = dice.between(0.8f, 1.0f, 9);
    blade.tint = {dice.between(0.25f, 0.40f, 10), dice.between(0.27f, 0.38f, 11),
                  dice.between(0.12f, 0.20f, 12)};
    blade.clump = dice.below(256, 13);
    blade.hash = dice.below(16, 14);
    return blade;
}

/// Blades of a node and its box, before its patch is written.
struct Node {
    std::vector<std::uint32_t> blades; ///< of the whole subtree, in progressive order
    glm::vec3 low;
    float size;
    std::uint32_t parent;
    std::uint32_t level;
    float rankLow;
};

/// Makes a patch from the blades of its subtree and the number it owns.
shared::Patch patchOf(const Node& node, const std::vector<shared::Blade>& blades,
                      std::uint32_t owned)
{
    shared::Patch cell = {};
    Aabb bounds;
    glm::vec3 axis(0.0f);
    for (const std::uint32_t i : node.blades) {
        const glm::vec3 reach(blades[i].height + blades[i].width);
        bounds.add(blades[i].root - reach);
        bounds.add(blades[i].root + reach);
        axis += blades[i].up;
    }
    cell.boundsLow = bounds.low;
    cell.boundsHigh = bounds.high;
    cell.coneAxis = glm::length(axis) > 1e-3f ? glm::normalize(axis) : glm::vec3(0.0f, 1.0f, 0.0f);
    cell.coneCosine = 1.0f;
    for (const std::uint32_t i : node.blades)
        cell.coneCosine = std::max(
            std::min(cell.coneCosine, glm::dot(cell.coneAxis, blades[i].up) - 2e-4f), -1.0f);

    // Choose quantisation steps for the range of the owned blades.
    Aabb roots;
    float height[2] = {1e9f, 0.0f};
    float width[2] = {1e9f, 0.0f};
    for (std::uint32_t k = 0; k < owned; ++k) {
        const shared::Blade& blade = blades[node.blades[k]];
        roots.add(blade.root);
        height[0] = std::min(height[0], blade.height);
        height[1] = std::max(height[1], blade.height);
        width[0] = std::min(width[0], blade.width);
        width[1] = std::max(width[1], blade.width);
    }
    if (owned > 0) {
        const glm::vec3 size = roots.size();
        cell.rootLow = roots.low;
        cell.rootStep = std::max({size.x, size.y, size.z}) / 65535.0f;
        cell.heightLow = height[0];
        cell.heightStep = (height[1] - height[0]) / 255.0f;
        cell.widthLow = width[0];
        cell.widthStep = (width[1] - width[0]) / 63.0f;
    }
    cell.bladeCount = owned;
    cell.parent = node.parent;
    cell.level = node.level;
    cell.firstChild = shared::noPatch;
    cell.rankLow = node.rankLow;
    const float total = static_cast<float>(node.blades.size());
    cell.rankHigh = node.blades.size() == owned
                        ? 1.0f
                        : node.rankLow + (1.0f - node.rankLow) * static_cast<float>(owned) / total;
    return cell;
}

/// Divides the blades that a node does not own into its octants.
std::array<Node, 8> divide(const Node& node, const std::vector<shared::Blade>& blades,
                           std::uint32_t owned, std::uint32_t index, float rankHigh)
{
    std::array<Node, 8> children;
    const float half = 0.5f * node.size;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        children[octant] = {{},
                            node.low +
                                half * glm::vec3(octant & 1u, (octant >> 1u) & 1u, octant >> 2u),
                            half,
                            index,
                            node.level + 1,
                            rankHigh};
    for (std::size_t k = owned; k < node.blades.size(); ++k) {
        const glm::vec3 place = blades[node.blades[k]].root - node.low;
        const std::size_t octant =
            (place.x >= half ? 1u : 0u) + (place.y >= half ? 2u : 0u) + (place.z >= half ? 4u : 0u);
        children[octant].blades.push_back(node.blades[k]);
    }
    return children;
}

field::Species meadowGrass()
{
    field::Species grass;
    grass.name = "meadow grass";
    grass.look = {.rootColor = {0.020f, 0.042f, 0.010f},
                  .tipThreshold = 0.35f,
                  .tipColor = {0.135f, 0.205f, 0.040f},
                  .groundTint = 0.3f,
                  .colorVariation = 0.5f,
                  .translucency = 0.45f,
                  .gloss = 0.5f,
                  .dryness = 0.15f,
                  .shape = shared::shapeTriangleTip,
                  .fold = 0.0f,
                  .firstOrgan = 0,
                  .organKinds = 0};
    return grass;
}

} // namespace

field::Field smallGround(Surface surface)
{
    FieldSettings settings;
    settings.surface = surface;
    settings.blades = 16;
    settings.extent = 10.0f;
    return makeField(settings);
}

field::Field emptyField()
{
    field::Field field;
    field.species = {meadowGrass()};
    return field;
}

field::Field treeOf(const std::vector<shared::Blade>& blades,
                    const std::vector<field::BladeKey>& keys, glm::vec3 low, float size)
{
    field::Field field = emptyField();
    if (blades.empty())
        return field;
    Node root{{}, low, size, shared::noPatch, 0, 0.0f};
    for (std::uint32_t i = 0; i < blades.size(); ++i)
        root.blades.push_back(i);

    // Level by level: a node of at most 32 m owns its first blades, its octants the rest.
    std::deque<Node> waiting{std::move(root)};
    while (!waiting.empty()) {
        const Node node = std::move(waiting.front());
        waiting.pop_front();
        const auto index = static_cast<std::uint32_t>(field.patches.size());
        const auto here = static_cast<std::uint32_t>(node.blades.size());
        const std::uint32_t owned = node.size > 32.0f ? 0 : std::min(here, maxOwned);
        shared::Patch cell = patchOf(node, blades, owned);
        cell.firstBlade = static_cast<std::uint32_t>(field.blades.size());
        for (std::uint32_t k = 0; k < owned; ++k) {
            field.blades.push_back(shared::packBlade(blades[node.blades[k]], cell));
            field.keys.push_back(keys[node.blades[k]]);
        }
        // Append children behind all waiting nodes.
        for (Node& child : divide(node, blades, owned, index, cell.rankHigh)) {
            if (child.blades.empty())
                continue;
            if (cell.childCount++ == 0)
                cell.firstChild = index + 1 + static_cast<std::uint32_t>(waiting.size());
            waiting.push_back(std::move(child));
        }
        field.patches.push_back(cell);
    }
    return field;
}

field::Field makeField(const FieldSettings& settings)
{
    field::Field field = emptyField();
    field.origin = settings.origin;
    if (settings.hasGround && settings.surface == Surface::plane)
        field.ground = planeGround(settings.extent);
    if (settings.hasGround && settings.surface == Surface::sphere)
        field.ground = sphereGround(settings.extent);
    if (settings.blades == 0)
        return field;

    // Independent random blades, so that every prefix has the same distribution.
    std::vector<shared::Blade> blades(settings.blades);
    std::vector<field::BladeKey> keys(settings.blades);
    for (std::size_t i = 0; i < blades.size(); ++i) {
        blades[i] = makeBlade(settings, i);
        keys[i] = {static_cast<std::uint32_t>(i), 0};
    }
    field::Field tree = treeOf(blades, keys, glm::vec3(-0.5f * settings.extent), settings.extent);
    field.patches = std::move(tree.patches);
    field.blades = std::move(tree.blades);
    field.keys = std::move(tree.keys);
    return field;
}

} // namespace sward::test
