#include "terrain/loading/placement.h"

#include "core/error.h"
#include "terrain/topology/soup.h"

#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace sward::terrain {
namespace {

struct Axis {
    std::string_view name;
    // Directions of the file's x, y and z axes in Sward's world: a rotation that maps `name` to +Y.
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

// The path, each leading part of it, and each of its names.
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

// "3 nodes: meadow, road, roof", not all of many.
std::string listOf(const std::vector<std::string>& things, const char* kind)
{
    constexpr std::size_t maxShown = 12;
    const std::size_t shown = std::min(things.size(), maxShown);
    return fmt::format(
        "{} {}{}{}{}{}", things.size(), kind, things.size() == 1 ? "" : "s", shown > 0 ? ": " : "",
        fmt::join(things.begin(), things.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
        things.size() > shown ? ", …" : "");
}

std::vector<std::string> materialsOf(const GroundMesh& mesh)
{
    std::vector<std::string> names;
    for (const GroundMaterial& material : mesh.materials)
        names.push_back(material.name);
    return names;
}

bool matchesSome(const std::vector<std::string>& globs, const std::string& thing, bool isPath)
{
    const std::vector<std::string> names =
        isPath ? namesOf(thing) : std::vector<std::string>{thing};
    return std::ranges::any_of(globs, [&](const std::string& glob) {
        return std::ranges::any_of(
            names, [&](const std::string& name) { return globMatches(glob, name); });
    });
}

// For each of `things`, whether one of `globs` matches it. Parts of a path match too. Warns of
// globs without a match.
std::vector<bool> matchAll(const std::vector<std::string>& globs,
                           const std::vector<std::string>& things, bool arePaths, const char* kind,
                           const std::string& place, Diagnostics& diagnostics)
{
    std::vector<bool> matched(things.size(), false);
    std::vector<bool> used(globs.size(), false);
    for (std::size_t i = 0; !globs.empty() && i < things.size(); ++i) {
        const std::vector<std::string> names =
            arePaths ? namesOf(things[i]) : std::vector<std::string>{things[i]};
        for (std::size_t g = 0; g < globs.size(); ++g)
            if (std::any_of(names.begin(), names.end(),
                            [&](const std::string& name) { return globMatches(globs[g], name); })) {
                matched[i] = true;
                used[g] = true;
            }
    }
    for (std::size_t g = 0; g < globs.size(); ++g)
        if (!used[g])
            diagnostics.warn("{}: \"{}\" matches none of its {}", place, globs[g],
                             listOf(things, kind));
    return matched;
}

} // namespace

GroundMesh placed(GroundMesh mesh, const glm::dmat4& worldFromFile, const std::string& name)
{
    if (worldFromFile == glm::dmat4(1.0))
        return mesh;
    Soup soup = soupOf(mesh);
    transform(soup, worldFromFile);
    return settle(std::move(soup), name);
}

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
    if (settings.bearingNodes.empty() && settings.occluderNodes.empty() &&
        settings.bearingMaterials.empty()) {
        std::fill(mesh.bears.begin(), mesh.bears.end(), std::uint8_t(1));
        return;
    }
    if (const std::string reason = unmatchedGlobs(mesh, settings);
        !reason.empty() && !settings.mayMatchNothing)
        fail(ErrorKind::input, "{}: {}", place, reason);
    const std::vector<std::string> materials = materialsOf(mesh);
    const auto bearing =
        matchAll(settings.bearingNodes, mesh.nodes, true, "node", place, diagnostics);
    const auto occluder =
        matchAll(settings.occluderNodes, mesh.nodes, true, "node", place, diagnostics);
    const auto growing =
        matchAll(settings.bearingMaterials, materials, false, "material", place, diagnostics);

    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const bool byNode = settings.bearingNodes.empty() || bearing[mesh.nodeOf[i]];
        const bool byMaterial = settings.bearingMaterials.empty() || growing[mesh.materialOf[i]];
        mesh.bears[i] = byNode && byMaterial && !occluder[mesh.nodeOf[i]] ? 1 : 0;
    }
}

std::string unmatchedGlobs(const GroundMesh& mesh, const ImportSettings& settings)
{
    const auto missed = [](const char* option, const std::vector<std::string>& globs,
                           const std::vector<std::string>& things, const char* kind,
                           bool arePaths) {
        const bool isFound =
            globs.empty() || std::ranges::any_of(things, [&](const std::string& thing) {
                return matchesSome(globs, thing, arePaths);
            });
        return isFound ? std::string()
                       : fmt::format("{} {} matches none of its {}", option, fmt::join(globs, ", "),
                                     listOf(things, kind));
    };
    const std::string nodes = missed("--node", settings.bearingNodes, mesh.nodes, "node", true);
    return nodes.empty() ? missed("--material", settings.bearingMaterials, materialsOf(mesh),
                                  "material", false)
                         : nodes;
}

} // namespace sward::terrain
