#include "terrain/loading/bare_names.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::terrain {
namespace {

constexpr std::array<std::string_view, 49> bareWords{
    "rock",    "stone",   "boulder", "cliff",  "pebble",   "gravel",   "scree",
    "sand",    "lava",    "snow",    "ice",    "glacier",  "water",    "waterfall",
    "river",   "lake",    "sea",     "ocean",  "pond",     "pool",     "road",
    "path",    "street",  "asphalt", "tarmac", "pavement", "sidewalk", "concrete",
    "brick",   "bridge",  "roof",    "wall",   "house",    "building", "castle",
    "tower",   "chimney", "window",  "door",   "fence",    "metal",    "glass",
    "plastic", "tree",    "trunk",   "bark",   "vehicle",  "railway",  "pier"};
constexpr std::array<std::string_view, 6> grassWords{"grass",   "lawn", "meadow",
                                                     "pasture", "turf", "moss"};

bool isSmall(char c)
{
    return c >= 'a' && c <= 'z';
}

bool isCapital(char c)
{
    return c >= 'A' && c <= 'Z';
}

// The words of a name in small letters. Bytes of other alphabets count as letters.
std::vector<std::string> wordsOf(const std::string& name)
{
    std::vector<std::string> words(1);
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        const bool isLetter = isSmall(c) || isCapital(c) || static_cast<unsigned char>(c) >= 128;
        const bool beginsWord =
            isCapital(c) && i > 0 &&
            (isSmall(name[i - 1]) || (i + 1 < name.size() && isSmall(name[i + 1])));
        if (!isLetter || beginsWord)
            words.emplace_back();
        if (isLetter)
            words.back() += isCapital(c) ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return words;
}

template <std::size_t count>
bool holds(const std::array<std::string_view, count>& known, const std::string& word)
{
    return std::any_of(known.begin(), known.end(), [&](std::string_view one) {
        if (!word.starts_with(one))
            return false;
        const std::string_view end = std::string_view(word).substr(one.size());
        return end.empty() || end == "s" || end == "es";
    });
}

std::vector<std::string> partsOf(const std::string& path)
{
    std::vector<std::string> parts(1);
    for (const char c : path)
        if (c == '/')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

// Number of leading parts that all paths share.
std::size_t sharedParts(const std::vector<std::vector<std::string>>& paths)
{
    std::size_t shared = paths.empty() ? 0 : paths.front().size();
    for (const std::vector<std::string>& path : paths) {
        const auto end =
            std::mismatch(path.begin(), path.end(), paths.front().begin(), paths.front().end());
        shared = std::min(shared, static_cast<std::size_t>(end.first - path.begin()));
    }
    return shared;
}

// What a material or a node says, and in which name.
struct Verdict {
    NameSays says = NameSays::nothing;
    std::string name = {};
};

std::vector<Verdict> verdictsOfMaterials(const GroundMesh& mesh,
                                         const std::vector<std::size_t>& triangles)
{
    std::vector<Verdict> verdicts(mesh.materials.size());
    std::set<std::uint32_t> used;
    for (const std::size_t t : triangles)
        used.insert(mesh.materialOf[t]);
    for (const std::uint32_t m : used)
        if (used.size() > 1)
            verdicts[m] = {readName(mesh.materials[m].name), mesh.materials[m].name};
    return verdicts;
}

std::vector<Verdict> verdictsOfNodes(const GroundMesh& mesh,
                                     const std::vector<std::size_t>& triangles)
{
    std::vector<Verdict> verdicts(mesh.nodes.size());
    std::set<std::uint32_t> used;
    for (const std::size_t t : triangles)
        used.insert(mesh.nodeOf[t]);
    std::vector<std::vector<std::string>> paths;
    for (const std::uint32_t node : used)
        paths.push_back(partsOf(mesh.nodes[node]));
    const std::size_t shared = sharedParts(paths);
    auto path = paths.begin();
    for (const std::uint32_t node : used) {
        for (std::size_t i = path->size(); i > shared; --i)
            if (const NameSays says = readName((*path)[i - 1]); says != NameSays::nothing) {
                verdicts[node] = {says, (*path)[i - 1]};
                break;
            }
        ++path;
    }
    return verdicts;
}

// "a", "b" and 3 more
std::string listOf(const std::set<std::string>& names)
{
    constexpr std::size_t most = 6;
    std::vector<std::string> shown;
    for (const std::string& name : names)
        if (shown.size() < most)
            shown.push_back('"' + name + '"');
    const std::string list = fmt::format("{}", fmt::join(shown, ", "));
    return names.size() > most ? fmt::format("{} and {} more", list, names.size() - most) : list;
}

} // namespace

NameSays readName(const std::string& name)
{
    NameSays says = NameSays::nothing;
    for (const std::string& word : wordsOf(name)) {
        if (holds(grassWords, word))
            return NameSays::grass;
        if (holds(bareWords, word))
            says = NameSays::bare;
    }
    return says;
}

void leaveBareByName(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                     Diagnostics& diagnostics)
{
    std::vector<std::size_t> bearing;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.bears[t] != 0)
            bearing.push_back(t);
    std::vector<Verdict> materials(mesh.materials.size());
    std::vector<Verdict> nodes(mesh.nodes.size());
    if (settings.bearingMaterials.empty())
        materials = verdictsOfMaterials(mesh, bearing);
    if (settings.bearingNodes.empty())
        nodes = verdictsOfNodes(mesh, bearing);

    std::set<std::string> names;
    std::vector<std::size_t> bare;
    double bareArea = 0.0;
    double area = 0.0;
    for (const std::size_t t : bearing) {
        const Verdict& ofMaterial = materials[mesh.materialOf[t]];
        const Verdict& verdict =
            ofMaterial.says != NameSays::nothing ? ofMaterial : nodes[mesh.nodeOf[t]];
        const double own = mesh.area(t);
        area += own;
        if (verdict.says != NameSays::bare)
            continue;
        bare.push_back(t);
        bareArea += own;
        names.insert(verdict.name);
    }
    if (bare.empty() || bare.size() == bearing.size())
        return;
    for (const std::size_t t : bare)
        mesh.bears[t] = 0;
    diagnostics.warn("{}: {:.3g} % of the ground is left bare, since its names say so: {}; "
                     "--bare-names none grows grass there too",
                     place, area > 0.0 ? 100.0 * bareArea / area : 0.0, listOf(names));
}

} // namespace sward::terrain
