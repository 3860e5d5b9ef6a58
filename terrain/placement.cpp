#include "terrain/placement.h"

#include "core/error.h"

#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace sward::terrain {
namespace {

struct Axis {
    std::string_view name;
    // Where the file's x, y and z axes point in Sward's world: a rotation that takes `name` to +Y.
    glm::dvec3 x, y, z;
};

constexpr std::array<Axis, 6> axes = {{
    {"y", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {"-y", {1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    {"z", {1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {"-z", {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {"x", {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
    {"-x", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
}};

struct Unit {
    std::string_view name;
    double metres;
};

constexpr std::array<Unit, 4> units = {{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}}};

template <typename Table>
const auto& find(const Table& table, const std::string& name, const char* option)
{
    std::vector<std::string_view> known;
    for (const auto& entry : table) {
        if (entry.name == name)
            return entry;
        known.push_back(entry.name);
    }
    fail(ErrorKind::usage, "{} \"{}\" is not known; known are {}", option, name,
         fmt::join(known, " "));
}

// The path itself, each leading part of it, and each name on the way.
std::vector<std::string> namesOf(const std::string& path)
{
    std::vector<std::string> names = {path};
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= path.size(); ++i) {
        if (i < path.size() && path[i] != '/')
            continue;
        names.push_back(path.substr(0, i));
        names.push_back(path.substr(begin, i - begin));
        begin = i + 1;
    }
    return names;
}

// For each of `things`, whether one of its names matches one of `globs`.
std::vector<bool> matchAll(const std::vector<std::string>& globs,
                           const std::vector<std::vector<std::string>>& things, const char* kind,
                           const std::string& place, Diagnostics& diagnostics)
{
    std::vector<bool> matched(things.size(), false);
    for (const std::string& glob : globs) {
        bool used = false;
        for (std::size_t i = 0; i < things.size(); ++i)
            if (std::any_of(things[i].begin(), things[i].end(),
                            [&](const std::string& name) { return globMatches(glob, name); })) {
                matched[i] = true;
                used = true;
            }
        if (!used) {
            std::vector<std::string> known;
            for (std::size_t i = 0; i < std::min<std::size_t>(things.size(), 12); ++i)
                known.push_back(things[i].front());
            diagnostics.warn("{}: \"{}\" matches none of its {} {}s: {}{}", place, glob,
                             things.size(), kind, fmt::join(known, ", "),
                             things.size() > known.size() ? ", …" : "");
        }
    }
    return matched;
}

} // namespace

glm::dmat4 worldFromFile(const ImportSettings& settings)
{
    const Axis& axis = find(axes, settings.upAxis, "up axis");
    const Unit& unit = find(units, settings.units, "unit");
    if (!(settings.scale > 0.0 && settings.scale <= 1e9))
        fail(ErrorKind::usage, "scale {} is outside (0, 1e9]", settings.scale);
    const double factor = unit.metres * settings.scale;
    return glm::dmat4(glm::dmat3(axis.x * factor, axis.y * factor, axis.z * factor));
}

void assignRoles(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                 Diagnostics& diagnostics)
{
    std::vector<std::vector<std::string>> nodes;
    for (const std::string& node : mesh.nodes)
        nodes.push_back(namesOf(node));
    std::vector<std::vector<std::string>> materials;
    for (const GroundMaterial& material : mesh.materials)
        materials.push_back({material.name});

    const auto bearing = matchAll(settings.bearingNodes, nodes, "node", place, diagnostics);
    const auto occluder = matchAll(settings.occluderNodes, nodes, "node", place, diagnostics);
    const auto growing =
        matchAll(settings.bearingMaterials, materials, "material", place, diagnostics);

    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const bool byNode = settings.bearingNodes.empty() || bearing[mesh.nodeOf[i]];
        const bool byMaterial = settings.bearingMaterials.empty() || growing[mesh.materialOf[i]];
        mesh.bears[i] = byNode && byMaterial && !occluder[mesh.nodeOf[i]] ? 1 : 0;
    }
}

} // namespace sward::terrain
