#include "field/organs.h"

#include "core/error.h"
#include "core/json/settings_json.h"
#include "field/field.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>
#include <string_view>

namespace sward::field {
namespace {

using nlohmann::json;

// Shortest decimal that reads back as the same float: 0.45, not 0.44999998807907104.
double shortestOf(float value)
{
    return std::stod(fmt::format("{}", value));
}

json arrayOf(const glm::vec2& v)
{
    return json::array({shortestOf(v.x), shortestOf(v.y)});
}

std::string_view nameOfShape(std::uint32_t shape)
{
    return shapeNames[shape == shared::shapeStalkLeaf ? shared::shapeTriangleTip : shape];
}

json arrayOf(const glm::vec3& v)
{
    return json::array({shortestOf(v.x), shortestOf(v.y), shortestOf(v.z)});
}

Organ parseOrgan(const json& object, const std::string& place)
{
    Organ organ;
    shared::Species& look = organ.look;
    look.rootColor = glm::vec3(0.05f, 0.09f, 0.02f);
    look.tipColor = glm::vec3(0.2f, 0.3f, 0.06f);
    look.tipThreshold = 0.5f;
    look.colorVariation = 0.15f;
    look.translucency = 0.4f;
    look.gloss = 0.2f;
    look.shape = shared::shapeLeaf;

    SettingsReader reader(object, place);
    auto count = static_cast<int>(organ.count);
    reader.read("name", organ.name);
    reader.read("count", count, 1, static_cast<int>(shared::maxRibbons));
    organ.count = static_cast<std::uint32_t>(count);
    reader.readEnds("place", organ.place, 0.0, 1.0);
    reader.readEnds("pitch_deg", organ.pitch, 0.0, 180.0);
    reader.readEnds("length", organ.length, 1e-4, 1.0);
    reader.read("width", organ.width, 1e-4, 2.0);
    reader.read("azimuth_deg", organ.azimuth, -360.0, 360.0);
    reader.read("turn_deg", organ.turn, -360.0, 360.0);
    reader.read("bend_deg", organ.bend, -180.0, 180.0);
    reader.read("variation", organ.variation, 0.0, 1.0);
    reader.readColor("root_color", look.rootColor, 0.0, 1.0);
    reader.readColor("tip_color", look.tipColor, 0.0, 1.0);
    reader.read("tip_threshold", look.tipThreshold, 0.0, 0.99);
    reader.read("ground_tint", look.groundTint, 0.0, 1.0);
    reader.read("color_variation", look.colorVariation, 0.0, 1.0);
    reader.read("translucency", look.translucency, 0.0, 1.0);
    reader.read("gloss", look.gloss, 0.0, 1.0);
    reader.read("dryness", look.dryness, 0.0, 1.0);
    look.shape = reader.readWord("shape", shapeNames, look.shape);
    // Beside its stalk a leaf does not begin with its whole width.
    if (look.shape == shared::shapeTriangleTip)
        look.shape = shared::shapeStalkLeaf;
    reader.read("fold", look.fold, 0.0, 1.0);
    reader.finish();
    return organ;
}

bool havePlants(const FieldView& field)
{
    return std::any_of(field.species.begin(), field.species.end(),
                       [](const Species& one) { return !one.organs.empty(); });
}

} // namespace

bool areAlike(const Organ& a, const Organ& b)
{
    return organsJson({a}) == organsJson({b});
}

shared::Organ deviceOrgan(const Organ& organ)
{
    shared::Organ result;
    result.look = organ.look;
    result.count = organ.count;
    result.place = organ.place;
    result.pitch = glm::radians(organ.pitch);
    result.size = organ.length;
    result.width = organ.width;
    result.azimuth = glm::radians(organ.azimuth);
    result.turn = glm::radians(organ.turn);
    result.bend = glm::radians(organ.bend);
    result.leg = shared::legLength(result.bend);
    result.variation = organ.variation;
    return result;
}

std::vector<Organ> parseOrgans(const json& list, const std::string& place)
{
    if (!list.is_array() || list.size() > shared::maxOrganKinds)
        fail(ErrorKind::input, "{}: expected an array of at most {} organs", place,
             shared::maxOrganKinds);
    std::vector<Organ> organs;
    for (const json& entry : list)
        organs.push_back(parseOrgan(entry, fmt::format("{}[{}]", place, organs.size())));
    if (ribbonsOf(organs) > shared::maxRibbons)
        fail(ErrorKind::input, "{}: {} ribbons on a stalk, more than {}", place, ribbonsOf(organs),
             shared::maxRibbons);
    return organs;
}

json organsJson(const std::vector<Organ>& organs)
{
    json list = json::array();
    for (const Organ& organ : organs)
        list.push_back({{"name", organ.name},
                        {"count", organ.count},
                        {"place", arrayOf(organ.place)},
                        {"pitch_deg", arrayOf(organ.pitch)},
                        {"length", arrayOf(organ.length)},
                        {"width", shortestOf(organ.width)},
                        {"azimuth_deg", shortestOf(organ.azimuth)},
                        {"turn_deg", shortestOf(organ.turn)},
                        {"bend_deg", shortestOf(organ.bend)},
                        {"variation", shortestOf(organ.variation)},
                        {"root_color", arrayOf(organ.look.rootColor)},
                        {"tip_color", arrayOf(organ.look.tipColor)},
                        {"tip_threshold", shortestOf(organ.look.tipThreshold)},
                        {"ground_tint", shortestOf(organ.look.groundTint)},
                        {"color_variation", shortestOf(organ.look.colorVariation)},
                        {"translucency", shortestOf(organ.look.translucency)},
                        {"gloss", shortestOf(organ.look.gloss)},
                        {"dryness", shortestOf(organ.look.dryness)},
                        {"shape", nameOfShape(organ.look.shape)},
                        {"fold", shortestOf(organ.look.fold)}});
    return list;
}

std::uint32_t ribbonsOf(const std::vector<Organ>& organs)
{
    return std::accumulate(organs.begin(), organs.end(), 0U,
                           [](std::uint32_t sum, const Organ& organ) { return sum + organ.count; });
}

void numberOrgans(std::vector<Species>& species, const std::string& place)
{
    std::uint32_t next = 0;
    for (Species& one : species) {
        one.look.organKinds = static_cast<std::uint32_t>(one.organs.size());
        one.look.firstOrgan = one.organs.empty() ? 0 : next;
        next += one.look.organKinds;
    }
    if (next > shared::maxOrganKinds)
        fail(ErrorKind::input, "{}: {} organs of all species, more than {}", place, next,
             shared::maxOrganKinds);
}

std::vector<shared::Organ> organTable(std::span<const Species> species)
{
    std::vector<shared::Organ> table;
    for (const Species& one : species)
        for (const Organ& organ : one.organs)
            table.push_back(deviceOrgan(organ));
    return table;
}

shared::OrganTable viewOf(const std::vector<shared::Organ>& organs)
{
    shared::OrganTable table;
    table.at = organs.data();
    return table;
}

BladePart partOf(const Species& species, const shared::Blade& blade)
{
    std::uint32_t left = shared::ribbonNumber(species.look, blade);
    for (const Organ& organ : species.organs) {
        if (left == 0)
            break;
        if (left <= organ.count) {
            const float share = organ.count > 1 ? float(left - 1) / float(organ.count - 1) : 0.0f;
            return {&organ.look, blade.height * glm::mix(organ.length.x, organ.length.y, share)};
        }
        left -= organ.count;
    }
    return {&species.look, blade.height};
}

std::uint64_t rootedBlades(const FieldView& field)
{
    std::uint64_t ribbons = 0;
    for (std::size_t b = 0; havePlants(field) && b < field.blades.size(); ++b)
        ribbons += field.isRibbon(b) ? 1U : 0U;
    return field.blades.size() - ribbons;
}

float areaFactor(const FieldView& field)
{
    constexpr std::size_t sampledPatches = 2000;
    const bool hasPlants = havePlants(field);
    double area = 0.0;
    double expected = 0.0;
    const std::size_t stride = field.patches.size() / sampledPatches + 1;
    for (std::size_t p = 0; hasPlants && p < field.patches.size(); p += stride) {
        const shared::Patch& cell = field.patches[p];
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[cell.firstBlade + i], cell);
            area +=
                double(partOf(field.species[blade.species], blade).length) * double(blade.width);
        }
        expected += double(cell.bladeCount) * double(cell.heightLow + 127.5f * cell.heightStep) *
                    double(cell.widthLow + 31.5f * cell.widthStep);
    }
    return expected > 0.0 ? static_cast<float>(area / expected) : 1.0f;
}

} // namespace sward::field
