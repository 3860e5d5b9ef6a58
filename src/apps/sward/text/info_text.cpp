#include "apps/sward/text/info_text.h"

#include "apps/sward/text/bake_summary.h"
#include "apps/sward/text/histogram_text.h"
#include "apps/sward/text/provenance_text.h"
#include "core/json/json_text.h"
#include "field/inspect.h"
#include "field/seeds/seeds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sward::apps {
namespace {

using nlohmann::ordered_json;

ordered_json arrayOf(const glm::dvec3& v)
{
    return ordered_json::array({v.x, v.y, v.z});
}

std::string pointText(const glm::dvec3& v)
{
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", v.x, v.y, v.z);
}

double bytesPerBlade(std::uint64_t fileBytes, std::uint64_t blades)
{
    return blades == 0 ? 0.0 : double(fileBytes) / double(blades);
}

// Levels of detail of the displayed ground.
std::uint32_t groundLevels(const field::DisplayGround& ground)
{
    std::uint32_t levels = 0;
    for (const field::GroundRange& range : ground.ranges)
        levels = std::max(levels, range.level + 1);
    return levels;
}

// "1 level", "2 levels".
std::string counted(std::uint64_t count, const char* noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string groundText(const field::DisplayGround& ground, std::uint64_t triangles)
{
    std::string text = counted(triangles, "triangle") + ", " +
                       counted(groundLevels(ground), "level") + ", " +
                       counted(ground.materials.size(), "material");
    for (const field::Image& image : ground.images)
        text += fmt::format(", image {}x{}", image.width, image.height);
    return text;
}

// Blades or ribbons that grow from seeds in all, told by those that are stored: these are evenly
// spread over all that grow.
double grownInAll(const field::FieldView& field, std::uint64_t stored)
{
    const double share = field.seeds->meadow->stored;
    return share > 0.0 ? double(stored) / share : 0.0;
}

std::string seedsText(const field::FieldView& field, const field::Summary& summary)
{
    const field::SeedMeadow& meadow = *field.seeds->meadow;
    std::string text = fmt::format("about {:.4g} blades", grownInAll(field, summary.blades));
    if (summary.ribbons > 0)
        text += fmt::format(" and {:.4g} ribbons", grownInAll(field, summary.ribbons));
    return text + fmt::format(" grow in {} of 32 m, of {:.4g} roots per m2, {}; {:.3g} of them are "
                              "stored, {:.3g} times as wide",
                              counted(field.seeds->cells.size(), "cell"), meadow.density,
                              sizeText(field.seeds->data.size()), meadow.stored,
                              meadow.storedWidening);
}

ordered_json seedsJson(const field::FieldView& field, const field::Summary& summary)
{
    const field::SeedMeadow& meadow = *field.seeds->meadow;
    return {{"blades", std::round(grownInAll(field, summary.blades))},
            {"ribbons", std::round(grownInAll(field, summary.ribbons))},
            {"density", meadow.density},
            {"cells", field.seeds->cells.size()},
            {"bytes", field.seeds->data.size()},
            {"stored", meadow.stored},
            {"stored_widening", meadow.storedWidening}};
}

ordered_json groundJson(const field::DisplayGround& ground, std::uint64_t triangles)
{
    ordered_json images = ordered_json::array();
    for (const field::Image& image : ground.images)
        images.push_back({image.width, image.height});
    return {{"triangles", triangles},
            {"levels", groundLevels(ground)},
            {"materials", ground.materials.size()},
            {"images", images}};
}

} // namespace

std::string infoText(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes, const field::Distributions* distributions)
{
    const field::Summary summary = field::summarise(field);
    std::string text = file + "\n";
    const auto row = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<20}{}\n", name, value);
    };
    row("blades", fmt::format("{}", summary.blades));
    if (summary.ribbons > 0)
        row("ribbons", fmt::format("{} on the stalks of plants", summary.ribbons));
    row("patches", fmt::format("{} in {}; {} leaves of {:.1f} blades on average", summary.patches,
                               counted(std::uint64_t(summary.levels), "level"), summary.leaves,
                               summary.bladesPerLeaf));
    if (!summary.bounds.isEmpty())
        row("bounds",
            fmt::format("{} to {} m", pointText(field.origin + glm::dvec3(summary.bounds.low)),
                        pointText(field.origin + glm::dvec3(summary.bounds.high))));
    row("bytes", fmt::format("{} ({}), {:.2f} per {}blade", fileBytes, sizeText(fileBytes),
                             bytesPerBlade(fileBytes, summary.blades),
                             field.seeds != nullptr ? "stored " : ""));
    row("height", fmt::format("{:.3f} to {:.3f} m, mean {:.3f} m", summary.heightLow,
                              summary.heightHigh, summary.heightMean));
    row("width", fmt::format("mean {:.4f} m", summary.widthMean));
    for (std::size_t i = 0; i < field.species.size(); ++i)
        row("species", fmt::format("{}: {} blades", field.species[i].name, summary.perSpecies[i]));
    if (field.seeds != nullptr)
        row("seeds", seedsText(field, summary));
    row("ground", groundText(*field.ground, summary.groundTriangles));
    for (const field::Camera& camera : field.defaults->cameras)
        row("camera", fmt::format("{}: from {} to {}", camera.name, pointText(camera.eye),
                                  pointText(camera.target)));
    if (!field.copyright->empty())
        row("copyright", *field.copyright);
    text += provenanceText(*field.provenance);
    return distributions == nullptr ? text : text + histogramText(*distributions);
}

std::string infoJson(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes, const field::Distributions* distributions)
{
    const field::Summary summary = field::summarise(field);
    ordered_json all;
    all["file"] = file;
    all["bytes"] = fileBytes;
    all["blades"] = summary.blades;
    all["ribbons"] = summary.ribbons;
    all["bytes_per_blade"] = bytesPerBlade(fileBytes, summary.blades);
    all["patches"] = summary.patches;
    all["leaves"] = summary.leaves;
    all["blades_per_leaf"] = summary.bladesPerLeaf;
    all["levels"] = summary.levels;
    all["origin"] = arrayOf(field.origin);
    all["bounds"] =
        summary.bounds.isEmpty()
            ? ordered_json(nullptr)
            : ordered_json::array({arrayOf(field.origin + glm::dvec3(summary.bounds.low)),
                                   arrayOf(field.origin + glm::dvec3(summary.bounds.high))});
    all["height_m"] = {
        {"low", summary.heightLow}, {"mean", summary.heightMean}, {"high", summary.heightHigh}};
    all["width_m"] = {{"mean", summary.widthMean}};
    all["species"] = ordered_json::array();
    for (std::size_t i = 0; i < field.species.size(); ++i)
        all["species"].push_back(
            {{"name", field.species[i].name}, {"blades", summary.perSpecies[i]}});
    if (field.seeds != nullptr)
        all["seeds"] = seedsJson(field, summary);
    all["ground"] = groundJson(*field.ground, summary.groundTriangles);
    all["cameras"] = ordered_json::array();
    for (const field::Camera& camera : field.defaults->cameras)
        all["cameras"].push_back({{"name", camera.name},
                                  {"eye", arrayOf(camera.eye)},
                                  {"target", arrayOf(camera.target)},
                                  {"up", arrayOf(glm::dvec3(camera.up))},
                                  {"fov_y_deg", camera.fovY}});
    all["copyright"] = *field.copyright;
    // Embed provenance as JSON; keep text that is not JSON as text.
    ordered_json provenance = ordered_json::parse(*field.provenance, nullptr, false);
    all["provenance"] = provenance.is_discarded() ? ordered_json(*field.provenance) : provenance;
    if (distributions != nullptr)
        all["histogram"] = histogramJson(*distributions);
    return jsonText(all, 2);
}

} // namespace sward::apps
