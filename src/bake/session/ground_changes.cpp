#include "bake/session/ground_changes.h"

#include "core/error.h"
#include "terrain/load.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <utility>

namespace sward::bake {
namespace {

using terrain::GroundMesh;
using terrain::SurfaceFeatures;

template <typename T>
bool areSameBytes(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool haveSameAttributes(const GroundMesh& a, const GroundMesh& b)
{
    return std::equal(
        a.attributes.list.begin(), a.attributes.list.end(), b.attributes.list.begin(),
        b.attributes.list.end(),
        [](const terrain::VertexAttribute& one, const terrain::VertexAttribute& other) {
            return one.name == other.name && one.components == other.components;
        });
}

// A corner of a triangle with everything that belongs to its vertex.
bool isSameVertex(const GroundView& before, std::uint32_t a, const GroundView& after,
                  std::uint32_t b)
{
    const GroundMesh& old = before.ground;
    const GroundMesh& next = after.ground;
    const std::vector<float>& curvature = before.features.curvature;
    if (!areSameBytes(old.positions[a], next.positions[b]) ||
        !areSameBytes(old.normals[a], next.normals[b]) || !areSameBytes(old.uvs[a], next.uvs[b]) ||
        !areSameBytes(old.colors[a], next.colors[b]) ||
        (!curvature.empty() && !areSameBytes(curvature[a], after.features.curvature[b])))
        return false;
    for (std::size_t i = 0; i < old.attributes.list.size(); ++i)
        if (!areSameBytes(old.attributes.list[i].values[a], next.attributes.list[i].values[b]))
            return false;
    return true;
}

bool isSameTriangle(const GroundView& before, const GroundView& after, std::size_t t)
{
    const std::vector<float>& islands = before.features.islandArea;
    if (before.ground.materialOf[t] != after.ground.materialOf[t] ||
        before.ground.bears[t] != after.ground.bears[t] ||
        (!islands.empty() && !areSameBytes(islands[t], after.features.islandArea[t])))
        return false;
    for (glm::length_t corner = 0; corner < 3; ++corner)
        if (!isSameVertex(before, before.ground.triangles[t][corner], after,
                          after.ground.triangles[t][corner]))
            return false;
    return true;
}

Aabb boxOf(const GroundMesh& ground, std::size_t t)
{
    Aabb box;
    for (glm::length_t corner = 0; corner < 3; ++corner)
        box.add(ground.positions[ground.triangles[t][corner]]);
    return box;
}

// The edges that only one of the lists has.
void addChangedEdges(const std::vector<SurfaceFeatures::BorderEdge>& before,
                     const std::vector<SurfaceFeatures::BorderEdge>& after,
                     std::vector<Aabb>& boxes)
{
    using Ends = std::array<float, 6>;
    const auto sorted = [](const std::vector<SurfaceFeatures::BorderEdge>& edges) {
        std::vector<Ends> ends;
        ends.reserve(edges.size());
        for (const SurfaceFeatures::BorderEdge& edge : edges)
            ends.push_back(
                {edge.from.x, edge.from.y, edge.from.z, edge.to.x, edge.to.y, edge.to.z});
        std::sort(ends.begin(), ends.end());
        return ends;
    };
    const std::vector<Ends> old = sorted(before);
    const std::vector<Ends> next = sorted(after);
    std::vector<Ends> changed;
    std::set_symmetric_difference(old.begin(), old.end(), next.begin(), next.end(),
                                  std::back_inserter(changed));
    for (const Ends& ends : changed) {
        Aabb& box = boxes.emplace_back();
        box.add({ends[0], ends[1], ends[2]});
        box.add({ends[3], ends[4], ends[5]});
    }
}

} // namespace

GroundChanges groundChanges(const GroundView& before, const GroundView& after)
{
    const std::size_t triangles = before.ground.triangles.size();
    if (after.ground.triangles.size() != triangles)
        fail(
            ErrorKind::input,
            "the new ground has {} triangles, the one before {}: only ground of the same triangles "
            "can replace it; begin a new session",
            after.ground.triangles.size(), triangles);
    GroundChanges changes;
    changes.isEverywhere =
        before.ground.origin != after.ground.origin ||
        before.ground.hasNormals != after.ground.hasNormals ||
        before.ground.hasColors != after.ground.hasColors ||
        before.features.curvature.empty() != after.features.curvature.empty() ||
        before.features.islandArea.empty() != after.features.islandArea.empty() ||
        !haveSameAttributes(before.ground, after.ground) ||
        terrain::appearanceHash(before.ground) != terrain::appearanceHash(after.ground);
    if (changes.isEverywhere)
        return changes;
    for (std::size_t t = 0; t < triangles; ++t) {
        if (isSameTriangle(before, after, t))
            continue;
        changes.boxes.push_back(boxOf(before.ground, t));
        changes.boxes.push_back(boxOf(after.ground, t));
    }
    addChangedEdges(before.features.borders, after.features.borders, changes.boxes);
    addChangedEdges(before.features.bareEdges, after.features.bareEdges, changes.boxes);
    return changes;
}

} // namespace sward::bake
