#include "terrain/loading/repeated_ground.h"

#include "core/lower_case.h"
#include "core/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <map>
#include <optional>
#include <string_view>

namespace sward::terrain {
namespace {

constexpr std::uint32_t noIndex = 0xffffffffU;

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

// What a node shows, and in which level of detail.
struct DetailName {
    std::string thing; // path up to the name with the level, without the level, in small letters
    int level = 0;
};

// Splits "Tree_LOD2" or "tree_lod2.001" into "tree" and 2; none without a level.
std::optional<DetailName> levelIn(const std::string& name)
{
    std::string text = lowerCase(name);
    // Blender adds a number to repeated names.
    std::string repeat;
    if (text.size() > 4 && text[text.size() - 4] == '.' &&
        std::all_of(text.end() - 3, text.end(), isDigit)) {
        repeat = text.substr(text.size() - 4);
        text.resize(text.size() - 4);
    }
    std::size_t digits = 0;
    while (digits < 2 && digits < text.size() && isDigit(text[text.size() - 1 - digits]))
        ++digits;
    const std::size_t end = text.size() - digits;
    if (digits == 0 || end < 3 || text.compare(end - 3, 3, "lod") != 0)
        return std::nullopt;
    const std::string base = text.substr(0, end - 3);
    if (!base.empty() && std::string_view("_-. ").find(base.back()) == std::string_view::npos)
        return std::nullopt;
    const int level = std::stoi(text.substr(end));
    return DetailName{base.substr(0, base.empty() ? 0 : base.size() - 1) + repeat, level};
}

DetailName detailOf(const std::string& path)
{
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        if (const auto found = levelIn(path.substr(begin, end - begin)))
            return {lowerCase(path.substr(0, begin)) + found->thing, found->level};
        begin = end + 1;
    }
    return {lowerCase(path), -1};
}

bool isCollider(const std::string& path)
{
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string name = path.substr(begin, end - begin);
        if (name.ends_with("-colonly") || name.ends_with("-convcolonly"))
            return true;
        for (const char* const start : {"UCX_", "UBX_", "USP_", "UCP_"})
            if (name.starts_with(start))
                return true;
        begin = end + 1;
    }
    return false;
}

// Whether two boxes lie over one another: along each axis by half of the longer side.
bool liesOver(const Aabb& a, const Aabb& b)
{
    const float whole = std::max({a.size().x, a.size().y, a.size().z});
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const float shared =
            std::min(a.high[axis], b.high[axis]) - std::max(a.low[axis], b.low[axis]);
        const float longer = std::max(a.size()[axis], b.size()[axis]);
        // Along an axis without extent the distance counts.
        if (shared < 0.5f * longer && (longer > 0.1f * whole || shared < -0.1f * whole))
            return false;
    }
    return true;
}

std::vector<Aabb> boundsOfNodes(const GroundMesh& mesh)
{
    std::vector<Aabb> boxes(mesh.nodes.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            boxes[mesh.nodeOf[t]].add(mesh.positions[mesh.triangles[t][corner]]);
    return boxes;
}

// Marks the nodes of coarser levels.
std::vector<bool> coarseNodes(const GroundMesh& mesh)
{
    std::vector<bool> coarse(mesh.nodes.size(), false);
    std::vector<DetailName> details;
    bool hasLevels = false;
    for (const std::string& node : mesh.nodes) {
        details.push_back(detailOf(node));
        hasLevels = hasLevels || details.back().level > 0;
    }
    if (!hasLevels)
        return coarse;
    const std::vector<Aabb> boxes = boundsOfNodes(mesh);
    std::map<std::string, std::map<int, Aabb>> things; // boxes by level; −1: without one
    for (std::size_t i = 0; i < details.size(); ++i)
        if (boxes[i].low.x <= boxes[i].high.x) {
            Aabb& box = things[details[i].thing][details[i].level];
            box.add(boxes[i].low);
            box.add(boxes[i].high);
        }
    for (std::size_t i = 0; i < details.size(); ++i) {
        if (details[i].level < 1 || boxes[i].low.x > boxes[i].high.x)
            continue;
        const auto finest = things[details[i].thing].begin();
        coarse[i] = finest->first < details[i].level && liesOver(finest->second, boxes[i]);
    }
    return coarse;
}

// Removes the triangles of marked nodes, unless none would be left. Returns the nodes' names.
std::vector<std::string> removeNodes(GroundMesh& mesh, const std::vector<bool>& marked)
{
    std::vector<bool> removed;
    std::vector<bool> isShown(mesh.nodes.size(), false);
    for (const std::uint32_t node : mesh.nodeOf) {
        removed.push_back(marked[node]);
        isShown[node] = true;
    }
    const auto count = std::count(removed.begin(), removed.end(), true);
    std::vector<std::string> names;
    if (count == 0 || static_cast<std::size_t>(count) == removed.size())
        return names;
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i] && isShown[i])
            names.push_back(mesh.nodes[i]);
    removeTriangles(mesh, removed);
    return names;
}

// "a" and 3 more
std::string firstOf(const std::vector<std::string>& names)
{
    return names.size() == 1 ? fmt::format("\"{}\"", names[0])
                             : fmt::format("\"{}\" and {} more", names[0], names.size() - 1);
}

// The corners of a triangle, the least first, so that equal fronts are equal.
std::array<glm::vec3, 3> cornersOf(const GroundMesh& mesh, std::size_t triangle)
{
    const glm::uvec3 t = mesh.triangles[triangle];
    std::array<glm::vec3, 3> corners = {mesh.positions[t.x] + 0.0f, mesh.positions[t.y] + 0.0f,
                                        mesh.positions[t.z] + 0.0f};
    const auto before = [](const glm::vec3& a, const glm::vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    const auto least = std::min_element(corners.begin(), corners.end(), before);
    std::rotate(corners.begin(), least, corners.end());
    return corners;
}

std::uint64_t hashOf(const std::array<glm::vec3, 3>& corners)
{
    std::uint64_t hash = 0;
    for (const glm::vec3& corner : corners)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            hash = hashBits(hash, std::bit_cast<std::uint32_t>(corner[axis]));
    return hash;
}

// The same for all orders of the corners.
std::uint64_t unorderedHash(const GroundMesh& mesh, std::size_t triangle)
{
    const glm::uvec3 t = mesh.triangles[triangle];
    std::uint64_t sum = 0;
    for (glm::length_t corner = 0; corner < 3; ++corner) {
        const glm::vec3 place = mesh.positions[t[corner]] + 0.0f;
        const auto bits = [&](glm::length_t axis) {
            return std::uint64_t(std::bit_cast<std::uint32_t>(place[axis]));
        };
        sum += mixBits((bits(0) << 32 | bits(1)) ^ bits(2) * 0x9e3779b97f4a7c15ULL);
    }
    return sum;
}

// Triangles that may coincide with another: all that do, and some others. Much cheaper than a table
// of all triangles, of which mostly none coincide.
std::vector<std::uint32_t> suspectsOf(const GroundMesh& mesh)
{
    const std::size_t triangles = mesh.triangles.size();
    // Sixteen bits for each triangle leave one in about sixteen under suspicion.
    const std::size_t bits = std::bit_ceil(16 * triangles + 64);
    std::vector<std::uint64_t> once(bits / 64);
    std::vector<std::uint64_t> twice(bits / 64);
    std::vector<std::uint32_t> places(triangles);
    tbb::parallel_for(std::size_t(0), triangles, [&](std::size_t t) {
        if (mesh.bears[t] == 0)
            return;
        const std::uint64_t place = unorderedHash(mesh, t) & (bits - 1) & noIndex;
        places[t] = static_cast<std::uint32_t>(place);
        const std::uint64_t bit = std::uint64_t(1) << (place & 63);
        if ((std::atomic_ref(once[place / 64]).fetch_or(bit, std::memory_order_relaxed) & bit) != 0)
            std::atomic_ref(twice[place / 64]).fetch_or(bit, std::memory_order_relaxed);
    });
    std::vector<std::uint32_t> suspects;
    for (std::size_t t = 0; t < triangles; ++t)
        if (mesh.bears[t] != 0 && (twice[places[t] / 64] >> (places[t] & 63) & 1) != 0)
            suspects.push_back(static_cast<std::uint32_t>(t));
    return suspects;
}

} // namespace

void removeTriangles(GroundMesh& mesh, const std::vector<bool>& removed)
{
    mesh.heightCells = nullptr;
    // Renumber triangles, and the gaps between them.
    std::vector<std::uint32_t> before(removed.size() + 1, 0); // kept triangles
    for (std::size_t t = 0; t < removed.size(); ++t)
        before[t + 1] = before[t] + (removed[t] ? 0U : 1U);
    for (AttributeGap& gap : mesh.attributes.gaps) {
        gap.first = before[gap.first];
        gap.end = before[gap.end];
    }
    std::erase_if(mesh.attributes.gaps,
                  [](const AttributeGap& gap) { return gap.first == gap.end; });
    const auto keep = [&](auto& values) {
        for (std::size_t t = 0; t < values.size(); ++t)
            if (!removed[t])
                values[before[t]] = values[t];
        values.resize(std::min<std::size_t>(values.size(), before.back()));
    };
    keep(mesh.triangles);
    keep(mesh.materialOf);
    keep(mesh.nodeOf);
    keep(mesh.bears);
    keep(mesh.sourceOf);

    // Renumber vertices.
    std::vector<std::uint32_t> newIndex(mesh.positions.size(), noIndex);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            newIndex[triangle[corner]] = 0;
    std::uint32_t next = 0;
    for (std::uint32_t& index : newIndex)
        if (index != noIndex)
            index = next++;
    const auto keepVertices = [&](auto& values) {
        for (std::size_t v = 0; v < values.size(); ++v)
            if (newIndex[v] != noIndex)
                values[newIndex[v]] = values[v];
        values.resize(next);
    };
    keepVertices(mesh.positions);
    keepVertices(mesh.normals);
    keepVertices(mesh.uvs);
    keepVertices(mesh.colors);
    mesh.attributes.keep(newIndex, noIndex);
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = {newIndex[triangle.x], newIndex[triangle.y], newIndex[triangle.z]};
}

void removeCoarseLevels(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                        Diagnostics& diagnostics)
{
    if (!settings.bearingNodes.empty())
        return;
    const std::vector<std::string> coarse = removeNodes(mesh, coarseNodes(mesh));
    if (!coarse.empty())
        diagnostics.warn("{}: {} nodes are coarser levels of detail and are left out: {}; --node "
                         "chooses others",
                         place, coarse.size(), firstOf(coarse));
}

void removeColliders(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                     Diagnostics& diagnostics)
{
    if (!settings.bearingNodes.empty())
        return;
    std::vector<bool> colliders;
    for (const std::string& node : mesh.nodes)
        colliders.push_back(isCollider(node));
    const std::vector<std::string> left = removeNodes(mesh, colliders);
    if (!left.empty())
        diagnostics.warn("{}: {} nodes are colliders by their names and are left out: {}; --node "
                         "chooses others",
                         place, left.size(), firstOf(left));
}

void removeCoincident(GroundMesh& mesh, Diagnostics& diagnostics)
{
    const std::vector<std::uint32_t> suspects = suspectsOf(mesh);
    // A table of first triangles with open addressing, at most half full.
    const std::size_t slots = std::bit_ceil(2 * suspects.size() + 1);
    std::vector<std::uint32_t> table(slots, noIndex);
    std::vector<bool> removed(mesh.triangles.size(), false);
    std::size_t count = 0;
    double area = 0.0;
    std::string names;
    for (const std::uint32_t t : suspects) {
        const std::array<glm::vec3, 3> corners = cornersOf(mesh, t);
        if (corners[0] == corners[1] || corners[1] == corners[2])
            continue;
        std::size_t slot = hashOf(corners) & (slots - 1);
        while (table[slot] != noIndex && cornersOf(mesh, table[slot]) != corners)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == noIndex) {
            table[slot] = t;
            continue;
        }
        removed[t] = true;
        area += mesh.area(t);
        if (count++ == 0)
            names = fmt::format("node \"{}\" on node \"{}\"", mesh.nodes[mesh.nodeOf[t]],
                                mesh.nodes[mesh.nodeOf[table[slot]]]);
    }
    if (count == 0)
        return;
    removeTriangles(mesh, removed);
    diagnostics.warn("{} triangles ({:.6g} m²) coincide with others before them and bear no second "
                     "time: {}",
                     count, area, names);
}

} // namespace sward::terrain
