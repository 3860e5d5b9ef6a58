#include "apps/sward/options/growth_options.h"

#include "apps/common/parse_text.h"
#include "core/error.h"
#include "core/log.h"
#include "field/seeds/seeds.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace sward::apps {
namespace {

constexpr double widestPlace = 1e12; // [m]

} // namespace

void GrowthOptions::add(CLI::App& app, const char* group)
{
    CLI::Option* const region =
        app.add_option("--region", region_,
                       "Only blades whose roots lie from X0 up to X1 and from Z0 up to Z1, in "
                       "metres of the world")
            ->type_name("X0:X1,Z0:Z1");
    CLI::Option* const around =
        app.add_option("--around", around_,
                       "Only blades whose roots lie within R metres of a place of the world")
            ->type_name("X,Y,Z,R")
            ->excludes(region);
    CLI::Option* const share =
        app.add_option("--share", share_,
                       "Only blades of ranks below this share, 0 to 1: evenly spread everywhere")
            ->type_name("S")
            ->check(CLI::Range(0.0, 1.0).description(""));
    CLI::Option* const most =
        app.add_option("--max-blades", maxBlades_,
                       "Limit on the number of blades, ribbons included; more are an error")
            ->type_name("N")
            ->capture_default_str();
    if (group == nullptr) {
        region->default_str("everywhere");
        around->default_str("everywhere");
        share->default_str("1");
        return;
    }
    for (CLI::Option* const option : {region, around, share, most})
        option->group(group);
}

bake::Growth GrowthOptions::growthIn(const glm::dvec3& origin) const
{
    bake::Growth growth;
    growth.maxBlades = maxBlades_;
    field::SowRegion& region = growth.region;
    region.share = static_cast<float>(share_.value_or(1.0));
    if (!region_.empty()) {
        const std::vector<std::string_view> parts = splitText(region_, ',');
        if (parts.size() != 2)
            fail(ErrorKind::usage, "--region is \"{}\"; expected X0:X1,Z0:Z1", region_);
        const auto [lowX, highX] = parseRange("--region", parts[0]);
        const auto [lowZ, highZ] = parseRange("--region", parts[1]);
        region.low.x = lowX - origin.x;
        region.high.x = highX - origin.x;
        region.low.z = lowZ - origin.z;
        region.high.z = highZ - origin.z;
    }
    if (!around_.empty()) {
        const std::vector<std::string_view> parts = splitText(around_, ',');
        if (parts.size() != 4)
            fail(ErrorKind::usage, "--around is \"{}\"; expected X,Y,Z,R", around_);
        glm::dvec3 centre;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            centre[axis] =
                parseNumber("--around", parts[std::size_t(axis)], -widestPlace, widestPlace);
        region.centre = centre - origin;
        region.radius = parseNumber("--around", parts[3], 0.0, widestPlace);
    }
    return growth;
}

std::optional<field::Field> GrowthOptions::grownOf(const field::FieldView& field, int threads,
                                                   const std::string& file, const char* done,
                                                   Progress& progress) const
{
    if (saysAnything())
        return bake::growField(field, growthIn(field.origin), threads, file, progress);
    if (field.seeds != nullptr && field.seeds->meadow->stored < 1.0)
        log::warn("{}: only the stored blades are {}, {:.3g} of those that grow from its seeds; "
                  "--around, --region or --share grows the others, as 'sward grow' does",
                  file, done, field.seeds->meadow->stored);
    return {};
}

} // namespace sward::apps
