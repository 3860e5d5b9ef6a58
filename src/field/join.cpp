#include "field/join.h"

#include "core/error.h"
#include "field/seeds/join_seeds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>

namespace sward::field {
namespace {

/// Children of a node of the patch tree.
constexpr std::size_t widestNode = 8;

/// First of the three bits of PackedBlade::look that hold the species' slot.
constexpr unsigned speciesBit = 21;

/// Widens a moved box by this share of its largest coordinate: the box and its content were each
/// rounded by half a step of a float.
constexpr float roundingOfMove = 1.0f / 4194304.0f; // two steps

/// How a member is placed in the joined field.
struct Move {
    glm::dvec3 by{0.0};                     ///< [m] the member's origin relative to the joined one
    std::array<std::uint32_t, 8> species{}; ///< joined slot per slot of the member
    std::vector<std::uint32_t> firstBlades; ///< joined index of each patch's first blade
};

glm::vec3 moved(const glm::vec3& place, const Move& move)
{
    return glm::vec3(glm::dvec3(place) + move.by);
}

bool moves(const Move& move)
{
    return move.by != glm::dvec3(0.0);
}

void widen(glm::vec3& low, glm::vec3& high)
{
    const glm::vec3 reach = roundingOfMove * glm::max(glm::abs(low), glm::abs(high));
    low -= reach;
    high += reach;
}

bool areAlike(const Species& a, const Species& b)
{
    return a.name == b.name && a.look.rootColor == b.look.rootColor &&
           a.look.tipThreshold == b.look.tipThreshold && a.look.tipColor == b.look.tipColor &&
           a.look.groundTint == b.look.groundTint &&
           a.look.colorVariation == b.look.colorVariation &&
           a.look.translucency == b.look.translucency && a.look.gloss == b.look.gloss &&
           a.look.dryness == b.look.dryness && a.look.shape == b.look.shape &&
           a.look.fold == b.look.fold &&
           std::equal(a.organs.begin(), a.organs.end(), b.organs.begin(), b.organs.end(),
                      [](const Organ& c, const Organ& d) { return areAlike(c, d); });
}

// Assigns slots to the member's species; new species are added to the table.
void joinSpecies(const Member& member, Move& move, std::vector<Species>& table)
{
    for (std::size_t i = 0; i < member.view.species.size(); ++i) {
        const Species& one = member.view.species[i];
        const auto same = std::find_if(table.begin(), table.end(), [&one](const Species& known) {
            return areAlike(one, known);
        });
        move.species[i] = static_cast<std::uint32_t>(same - table.begin());
        if (same != table.end())
            continue;
        if (table.size() == shared::maxSpecies)
            fail(ErrorKind::input,
                 "{}: its species {} would be number {} of those shown together, more than {}",
                 member.name, one.name, table.size() + 1, shared::maxSpecies);
        table.push_back(one);
    }
}

Move moveOf(const Member& member, const glm::dvec3& origin)
{
    Move move;
    move.by = member.view.origin - origin;
    const Aabb bounds = member.view.bounds();
    if (!moves(move) || bounds.isEmpty())
        return move;
    const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(bounds.low) + move.by),
                                      glm::abs(glm::dvec3(bounds.high) + move.by));
    const double farthest = std::max({reach.x, reach.y, reach.z});
    if (!(farthest <= farthestJoined))
        fail(ErrorKind::input,
             "{}: reaches {:.0f} m from the origin of the first field, more than {:.0f} m",
             member.name, farthest, farthestJoined);
    return move;
}

// Checks that 32 bits can count patches, blades and corners of all members.
void checkCounts(std::span<const Member> members)
{
    struct {
        const char* what;
        std::size_t (*count)(const FieldView&);
    } constexpr counted[] = {
        {"patches", [](const FieldView& view) { return view.patches.size() + 1; }},
        {"blades", [](const FieldView& view) { return view.blades.size(); }},
        {"corners of the ground",
         [](const FieldView& view) { return view.ground->vertices.size(); }},
        {"indices of the ground",
         [](const FieldView& view) { return view.ground->indices.size(); }}};
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() - 1;
    for (const auto& kind : counted) {
        std::size_t total = 0;
        for (const Member& member : members) {
            total += kind.count(member.view);
            if (total > most)
                fail(ErrorKind::input, "{}: {} {} together, more than {}", member.name, total,
                     kind.what, most);
        }
    }
}

// A node above the members' trees, or the root of one.
struct Above {
    std::uint32_t member = PatchSource::none;
    std::vector<Above> children;
    Aabb box;
};

// Groups up to eight nodes under one, repeatedly, until one is left.
Above buildAbove(std::span<const Member> members, std::span<const Move> moves)
{
    std::vector<Above> row;
    for (std::uint32_t m = 0; m < members.size(); ++m) {
        const FieldView& view = members[m].view;
        if (view.patches.empty())
            continue;
        Above leaf;
        leaf.member = m;
        leaf.box.low = moved(view.patches[0].boundsLow, moves[m]);
        leaf.box.high = moved(view.patches[0].boundsHigh, moves[m]);
        widen(leaf.box.low, leaf.box.high);
        row.push_back(std::move(leaf));
    }
    while (row.size() > 1) {
        std::vector<Above> wider((row.size() + widestNode - 1) / widestNode);
        for (std::size_t i = 0; i < row.size(); ++i) {
            Above& parent = wider[i / widestNode];
            parent.box.add(row[i].box);
            parent.children.push_back(std::move(row[i]));
        }
        row = std::move(wider);
    }
    return row.empty() ? Above() : std::move(row[0]);
}

// A node without blades: only its box and place in the tree are set.
shared::Patch patchAbove(const Above& above)
{
    shared::Patch patch = {};
    patch.boundsLow = above.box.low;
    patch.boundsHigh = above.box.high;
    patch.rootLow = above.box.low;
    patch.coneAxis = glm::vec3(0.0f, 1.0f, 0.0f);
    patch.coneCosine = -1.0f;
    patch.childCount = static_cast<std::uint32_t>(above.children.size());
    return patch;
}

shared::Patch patchOf(const Member& member, std::uint32_t index, const Move& move)
{
    shared::Patch patch = member.view.patches[index];
    if (!moves(move))
        return patch;
    patch.boundsLow = moved(patch.boundsLow, move);
    patch.boundsHigh = moved(patch.boundsHigh, move);
    widen(patch.boundsLow, patch.boundsHigh);
    patch.rootLow = moved(patch.rootLow, move);
    return patch;
}

// Lays all patches out level by level, and their blades in the same order.
void layOut(std::span<const Member> members, std::vector<Move>& moves, JoinedFields& joined)
{
    const Above top = buildAbove(members, moves);
    if (top.member == PatchSource::none && top.children.empty())
        return;
    struct Pending {
        const Above* above;
        std::uint32_t patch; // of the member
        std::uint32_t parent;
        std::uint32_t level;
    };
    std::deque<Pending> queue{{&top, 0, shared::noPatch, 0}};
    std::uint32_t nextChild = 1;
    std::uint32_t nextBlade = 0;
    for (; !queue.empty(); queue.pop_front()) {
        const Pending& pending = queue.front();
        const Above& above = *pending.above;
        const auto index = static_cast<std::uint32_t>(joined.field.patches.size());
        shared::Patch patch;
        if (above.member == PatchSource::none) {
            patch = patchAbove(above);
            for (const Above& child : above.children)
                queue.push_back({&child, 0, index, pending.level + 1});
            joined.sources.push_back({});
        } else {
            patch = patchOf(members[above.member], pending.patch, moves[above.member]);
            for (std::uint32_t i = 0; i < patch.childCount; ++i)
                queue.push_back({&above, patch.firstChild + i, index, pending.level + 1});
            joined.sources.push_back({above.member, pending.patch});
            moves[above.member].firstBlades.push_back(nextBlade);
        }
        patch.firstBlade = nextBlade;
        patch.parent = pending.parent;
        patch.level = pending.level;
        patch.firstChild = patch.childCount == 0 ? shared::noPatch : nextChild;
        nextChild += patch.childCount;
        nextBlade += patch.bladeCount;
        joined.field.patches.push_back(patch);
    }
}

// A member's patches keep their order, so the n-th entry belongs to the n-th patch.
void copyBlades(const FieldView& view, const Move& move, Field& field)
{
    for (std::size_t p = 0; p < view.patches.size(); ++p) {
        const shared::Patch& patch = view.patches[p];
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            shared::PackedBlade blade = view.blades[patch.firstBlade + i];
            const std::uint32_t slot = blade.look >> speciesBit & 7u;
            blade.look = (blade.look & ~(7u << speciesBit)) | move.species[slot] << speciesBit;
            field.blades[move.firstBlades[p] + i] = blade;
        }
        if (!field.keys.empty())
            std::copy_n(view.keys.begin() + patch.firstBlade, patch.bladeCount,
                        field.keys.begin() + move.firstBlades[p]);
    }
}

void copyGround(const DisplayGround& from, const Move& move, DisplayGround& to)
{
    const auto firstVertex = static_cast<std::uint32_t>(to.vertices.size());
    const auto firstIndex = static_cast<std::uint32_t>(to.indices.size());
    const auto firstMaterial = static_cast<std::uint32_t>(to.materials.size());
    const auto firstImage = static_cast<std::uint32_t>(to.images.size());
    for (shared::GroundVertex vertex : from.vertices) {
        vertex.position = moved(vertex.position, move);
        to.vertices.push_back(vertex);
    }
    for (const std::uint32_t index : from.indices)
        to.indices.push_back(firstVertex + index);
    for (GroundRange range : from.ranges) {
        range.firstIndex += firstIndex;
        range.material += firstMaterial;
        to.ranges.push_back(range);
    }
    for (shared::GroundMaterial material : from.materials) {
        if (material.image != shared::noImage)
            material.image += firstImage;
        to.materials.push_back(material);
    }
    to.images.insert(to.images.end(), from.images.begin(), from.images.end());
}

std::shared_ptr<const SharedSeeds> seedsOf(std::span<const Member> members,
                                           const std::vector<Move>& moves, const Field& field)
{
    std::vector<SeedMember> seeded;
    for (std::size_t m = 0; m < members.size(); ++m)
        seeded.push_back({{members[m].view.seeds, members[m].view.origin},
                          std::span(moves[m].species).first(members[m].view.species.size()),
                          members[m].name});
    return joinSeeds(seeded, field.origin, field.species.size());
}

void copyTexts(std::span<const Member> members, Field& field)
{
    std::vector<std::string> owners;
    field.provenance = "{\"fields\":[";
    for (const Member& member : members) {
        const FieldView& view = member.view;
        field.provenance += (&member == members.data() ? "" : ",") + *view.provenance;
        if (!view.copyright->empty() &&
            std::find(owners.begin(), owners.end(), *view.copyright) == owners.end())
            owners.push_back(*view.copyright);
        if (&member != members.data())
            field.defaults.cameras.insert(field.defaults.cameras.end(),
                                          view.defaults->cameras.begin(),
                                          view.defaults->cameras.end());
    }
    field.provenance += "]}";
    for (const std::string& owner : owners)
        field.copyright += (field.copyright.empty() ? "" : "\n") + owner;
}

} // namespace

JoinedFields join(std::span<const Member> members)
{
    requireUsage(!members.empty(), "there is no field to join");
    checkCounts(members);
    JoinedFields joined;
    Field& field = joined.field;
    field.origin = members[0].view.origin;
    field.defaults = *members[0].view.defaults;
    std::vector<Move> moves;
    for (const Member& member : members)
        moves.push_back(moveOf(member, field.origin));
    // Seeds tell species by slots, so those of the first field with seeds keep theirs.
    const auto seeded = std::find_if(members.begin(), members.end(), [](const Member& member) {
        return member.view.seeds != nullptr;
    });
    if (seeded != members.end())
        joinSpecies(*seeded, moves[std::size_t(seeded - members.begin())], field.species);
    for (std::size_t m = 0; m < members.size(); ++m)
        joinSpecies(members[m], moves[m], field.species);
    numberOrgans(field.species, "the fields shown together");
    layOut(members, moves, joined);

    std::size_t blades = 0;
    double meadow = 0.0;
    bool haveKeys = true;
    for (const Member& member : members) {
        blades += member.view.blades.size();
        meadow += member.view.thinned * double(member.view.blades.size());
        haveKeys = haveKeys && member.view.keys.size() == member.view.blades.size();
    }
    if (blades > 0)
        field.thinned = std::max(meadow / double(blades), 1.0);
    field.blades.resize(blades);
    if (haveKeys)
        field.keys.resize(blades);
    for (std::size_t m = 0; m < members.size(); ++m) {
        copyBlades(members[m].view, moves[m], field);
        copyGround(*members[m].view.ground, moves[m], field.ground);
    }
    std::stable_sort(field.ground.ranges.begin(), field.ground.ranges.end(),
                     [](const GroundRange& a, const GroundRange& b) { return a.level < b.level; });
    field.seeds = seedsOf(members, moves, field);
    copyTexts(members, field);
    return joined;
}

} // namespace sward::field
