#include "bake/tiles/tile_files.h"

#include "bake/blades/clumps.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "terrain/files/ground_file.h"
#include "terrain/files/record_file.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* planFormat = "sward plan 3";

constexpr std::size_t planLimit = std::size_t(16) << 20;
constexpr std::uint32_t maxTiles = 1'000'000;
constexpr double smallestBladeScale = 1e-6; // of BakeSettings::bladeScale
constexpr double largestBladeScale = 1e5;

// Omits times, so that a tile has the same bytes on every machine.
struct TileNumbers {
    RootCounts counts;
    double spacingMinimum;
};

struct CellHeader {
    CellNumber cell;
    SubtreeDescription::Summary summary;
    std::uint64_t patches;
    std::uint64_t blades;
};

void requireId(const std::string& found, const std::string& wanted, const fs::path& path)
{
    if (found != wanted)
        fail(ErrorKind::input, "{}: belongs to plan {}, not {}", path.string(), found, wanted);
}

json vectorJson(const glm::dvec3& v)
{
    return json::array({v.x, v.y, v.z});
}

glm::dvec3 vectorOf(const json& array)
{
    return {array.at(0).get<double>(), array.at(1).get<double>(), array.at(2).get<double>()};
}

// A number of JSON that is a whole one from 0 up to `high`; others have no value as an integer.
std::uint64_t wholeNumberOf(const json& object, const char* key, const std::string& place,
                            std::uint64_t high = std::numeric_limits<std::uint64_t>::max())
{
    const json& value = object.at(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > high)
        fail(ErrorKind::input, "{}: {} is {}, no whole number in [0, {}]", place, key,
             jsonText(value), high);
    return value.get<std::uint64_t>();
}

json groundJson(const Report& report)
{
    const auto& colors = report.colors;
    return {{"path", bytesToJson(report.input.path)},
            {"triangles", report.input.triangles},
            {"area", report.input.area},
            {"low", vectorJson(report.input.low)},
            {"high", vectorJson(report.input.high)},
            {"altitudes", {report.input.altitudes.low, report.input.altitudes.high}},
            {"hash", report.input.hash},
            {"map_system", report.input.mapSystem},
            {"seed", report.seed},
            {"colors", colors ? json{colors->green, colors->bare} : json()},
            {"chosen_mask", report.maskChosen},
            {"warnings", report.warnings}};
}

Report groundReport(const json& ground, const std::string& place)
{
    Report report;
    report.input.path = bytesFromJson(ground.at("path"), place + ": ground.path");
    report.input.triangles = wholeNumberOf(ground, "triangles", place + ": ground");
    ground.at("area").get_to(report.input.area);
    report.input.low = vectorOf(ground.at("low"));
    report.input.high = vectorOf(ground.at("high"));
    ground.at("altitudes").at(0).get_to(report.input.altitudes.low);
    ground.at("altitudes").at(1).get_to(report.input.altitudes.high);
    ground.at("hash").get_to(report.input.hash);
    report.input.mapSystem = ground.value("map_system", std::string());
    report.seed = wholeNumberOf(ground, "seed", place + ": ground");
    if (const json& colors = ground.at("colors"); !colors.is_null())
        report.colors = GreenShares{colors.at(0).get<double>(), colors.at(1).get<double>()};
    ground.at("chosen_mask").get_to(report.maskChosen);
    ground.at("warnings").get_to(report.warnings);
    return report;
}

// Reads the pixels of images that bearing ground uses.
void readImages(const fs::path& folder, const std::string& id, terrain::GroundMesh& ground)
{
    std::vector<bool> isShown(ground.images.size(), false);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        const std::uint32_t image = ground.materials[ground.materialOf[t]].image;
        if (ground.bears[t] != 0 && image != terrain::GroundMaterial::noImage)
            isShown[image] = true;
    }
    for (std::size_t i = 0; i < ground.images.size(); ++i) {
        if (!isShown[i])
            continue;
        const fs::path path = imagePath(folder, i);
        terrain::RecordReader reader(path, imageKind);
        std::string own;
        reader.read(own);
        requireId(own, id, path);
        terrain::readPixels(reader, ground.images[i], path.string());
    }
}

// Checks that children and blades of each patch follow those of the patches before.
void checkTree(const CellTree& cell, std::uint64_t blades, const fs::path& path)
{
    std::size_t nextChild = 1;
    std::size_t nextBlade = 0;
    for (std::size_t i = 0; i < cell.patches.size(); ++i) {
        const shared::Patch& patch = cell.patches[i];
        if (patch.firstBlade != nextBlade || patch.bladeCount > blades - nextBlade ||
            (patch.childCount > 0 && (patch.firstChild != nextChild || patch.firstChild <= i)) ||
            patch.childCount > cell.patches.size() - nextChild)
            fail(ErrorKind::input,
                 "{}: patch {} of a cell says {} blades from {} and {} children from {}; of {} and "
                 "{} the next are {} and {}",
                 path.string(), i, patch.bladeCount, patch.firstBlade, patch.childCount,
                 patch.firstChild, blades, cell.patches.size(), nextBlade, nextChild);
        nextBlade += patch.bladeCount;
        nextChild += patch.childCount;
    }
    if (cell.patches.empty() || nextBlade != blades || nextChild != cell.patches.size())
        fail(ErrorKind::input, "{}: a cell's patches have {} of {} blades and {} of {} patches",
             path.string(), nextBlade, blades, nextChild, cell.patches.size());
}

void checkSpecies(std::span<const std::byte> blades, std::size_t species, const fs::path& path)
{
    for (std::size_t at = 0; at < blades.size(); at += sizeof(shared::PackedBlade)) {
        shared::PackedBlade blade;
        std::memcpy(&blade, blades.data() + at, sizeof blade);
        if (const std::uint32_t own = blade.look >> 21U & 7U; own >= species)
            fail(ErrorKind::input, "{}: blade {} has species {}; there are {}", path.string(),
                 at / sizeof blade, own, species);
    }
}

// Checks that the frames of cells follow one another.
void checkSeeds(std::span<const field::SeedEntry> cells, std::uint64_t bytes, const fs::path& path)
{
    std::uint64_t at = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].offset != at || cells[i].bytes > bytes - at ||
            (i > 0 && !(cells[i - 1].cell < cells[i].cell)))
            fail(ErrorKind::input, "{}: cell {} of the seeds, {} bytes at {}, does not fit",
                 path.string(), i, cells[i].bytes, cells[i].offset);
        at += cells[i].bytes;
    }
    if (at != bytes)
        fail(ErrorKind::input, "{}: {} bytes of seeds instead of {}", path.string(), bytes, at);
}

} // namespace

void writePlan(const fs::path& path, const TilePlan& plan, bool overwrite)
{
    json arguments = json::array();
    for (const std::string& argument : plan.arguments)
        arguments.push_back(bytesToJson(argument));
    json files = json::array();
    for (const PlanFile& file : plan.files)
        files.push_back({{"name", bytesToJson(file.name)}, {"hash", file.hash}});
    json object = {{"format", planFormat},
                   {"id", plan.id},
                   {"tiles", plan.tiles},
                   {"arguments", arguments},
                   {"folder", bytesToJson(plan.folder)},
                   {"paint", plan.paint},
                   {"files", files},
                   {"windows", plan.hasWindows},
                   {"ground", groundJson(plan.report)},
                   {"resolved",
                    {{"scale", plan.plan.plan.scale},
                     {"density", plan.plan.plan.density},
                     {"expected", plan.plan.plan.expected},
                     {"spacing", plan.plan.plan.spacing},
                     {"widening", plan.plan.plan.widening},
                     {"thinned", plan.plan.plan.thinned},
                     {"closed_density", plan.plan.plan.closedDensity},
                     {"clump_spacing", plan.plan.plan.clumpSpacing},
                     {"area", plan.plan.plan.area},
                     {"root_density", plan.plan.roots.amount.density},
                     {"root_priority", plan.plan.roots.amount.priority},
                     {"root_last_key", plan.plan.roots.amount.lastKey},
                     {"root_spacing", plan.plan.roots.spacing},
                     {"root_filtered", plan.plan.roots.filtered}}}};
    if (plan.plan.seeds)
        object["seeds"] = json::parse(field::seedMeadowText(*plan.plan.seeds));
    if (plan.plan.roots.bearing)
        object["resolved"]["root_bearing"] = *plan.plan.roots.bearing;
    writeTextFile(path, jsonText(object, 2) + "\n", overwrite);
}

namespace {

// Names the missing key that the parser's message has in single quotes.
std::string troubleOf(std::string_view theirs)
{
    const std::size_t begin = theirs.find('\'');
    const std::size_t end = theirs.rfind('\'');
    if (begin == std::string_view::npos || end <= begin)
        return "a key is missing";
    return fmt::format("the key \"{}\" is missing", theirs.substr(begin + 1, end - begin - 1));
}

} // namespace

TilePlan readPlan(const fs::path& path)
{
    const std::vector<std::byte> bytes = readFile(path, planLimit);
    const std::string name = path.string();
    const json object =
        parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
    try {
        if (object.at("format") != planFormat)
            fail(ErrorKind::unsupported, "{}: is {}, not \"{}\"; plan again", name,
                 jsonText(object.at("format")), planFormat);
        TilePlan plan;
        plan.id = object.at("id").get<std::string>();
        plan.tiles = static_cast<std::uint32_t>(wholeNumberOf(object, "tiles", name, maxTiles));
        if (!object.at("arguments").is_array())
            fail(ErrorKind::input, "{}: arguments is not a list", name);
        for (const json& argument : object.at("arguments"))
            plan.arguments.push_back(bytesFromJson(argument, name + ": arguments"));
        plan.folder = bytesFromJson(object.at("folder"), name + ": folder");
        plan.paint = object.value("paint", "");
        for (const json& file : object.at("files"))
            plan.files.push_back({bytesFromJson(file.at("name"), name + ": files"),
                                  file.at("hash").get<std::string>()});
        plan.hasWindows = object.value("windows", false);
        plan.report = groundReport(object.at("ground"), name);
        const json& resolved = object.at("resolved");
        const auto number = [&](const char* key, double low = 0.0, double high = 1e300) {
            const auto value = resolved.at(key).get<double>();
            if (!(value >= low && value <= high))
                fail(ErrorKind::input, "{}: resolved: {} is {:.6g}, outside [{:.6g}, {:.6g}]", name,
                     key, value, low, high);
            return value;
        };
        plan.plan.plan.scale = number("scale", smallestBladeScale, largestBladeScale);
        plan.plan.plan.density = number("density");
        plan.plan.plan.expected = number("expected");
        plan.plan.plan.spacing = number("spacing");
        plan.plan.plan.widening = number("widening", 1.0, 2.0);
        plan.plan.plan.thinned = number("thinned", 1.0, field::maxThinned);
        plan.plan.plan.closedDensity = number("closed_density");
        plan.plan.plan.area = number("area");
        // Closer ones are never planned: there would be too many.
        const double closest =
            clumpSpacing(smallestBladeScale, std::max(plan.plan.plan.area, plan.report.input.area));
        plan.plan.plan.clumpSpacing = number("clump_spacing");
        if (plan.plan.plan.clumpSpacing > 0.0)
            number("clump_spacing", 0.99 * std::min(closest, 1e9));
        plan.plan.roots.amount.density = number("root_density");
        plan.plan.roots.amount.priority = number("root_priority");
        plan.plan.roots.amount.lastKey =
            wholeNumberOf(resolved, "root_last_key", name + ": resolved");
        plan.plan.roots.spacing = number("root_spacing");
        plan.plan.roots.filtered = resolved.at("root_filtered").get<bool>();
        if (resolved.contains("root_bearing"))
            plan.plan.roots.bearing = number("root_bearing");
        if (object.contains("seeds"))
            plan.plan.seeds =
                field::parseSeedMeadow(jsonText(object.at("seeds")), name + ": seeds");
        if (plan.tiles == 0)
            fail(ErrorKind::input, "{}: 0 tiles, outside [1, {}]", name, maxTiles);
        return plan;
    } catch (const json::out_of_range& missing) {
        fail(ErrorKind::input, "{}: {}", name, troubleOf(missing.what()));
    } catch (const json::exception&) {
        fail(ErrorKind::input, "{}: a value has another type than in a plan", name);
    }
}

fs::path partsFolder(const fs::path& plan)
{
    return fs::path(plan).replace_extension(".parts");
}

fs::path partPath(const fs::path& folder, std::uint32_t tile)
{
    return folder / fmt::format("part-{:06}.ground", tile);
}

fs::path imagePath(const fs::path& folder, std::size_t image)
{
    return folder / fmt::format("image-{:03}.pixels", image);
}

fs::path barePath(const fs::path& folder)
{
    return folder / "bare.sward";
}

void writePart(const fs::path& path, const std::string& id, const TilePart& part)
{
    terrain::RecordWriter writer(path, partKind, true);
    writer.add(std::string_view(id));
    writer.add(part.cells);
    writer.add(part.features.curvature);
    writer.add(part.features.islandArea);
    writer.add(part.features.borders);
    writer.add(part.features.bareEdges);
    writer.add(part.features.creases);
    terrain::write(writer, part.ground);
    writer.commit();
}

void writeImages(const fs::path& folder, const std::string& id, const terrain::GroundMesh& ground)
{
    for (std::size_t i = 0; i < ground.images.size(); ++i) {
        terrain::RecordWriter writer(imagePath(folder, i), imageKind, true);
        writer.add(std::string_view(id));
        terrain::writePixels(writer, ground.images[i]);
        writer.commit();
    }
}

TilePart readPart(const fs::path& folder, std::uint32_t tile, const std::string& id)
{
    const fs::path path = partPath(folder, tile);
    terrain::RecordReader reader(path, partKind);
    std::string own;
    reader.read(own);
    requireId(own, id, path);
    TilePart part;
    reader.read(part.cells);
    reader.read(part.features.curvature);
    reader.read(part.features.islandArea);
    reader.read(part.features.borders);
    reader.read(part.features.bareEdges);
    reader.read(part.features.creases);
    part.ground = terrain::readGround(reader, path.string());
    const auto fits = [](std::size_t features, std::size_t all) {
        return features == 0 || features == all;
    };
    if (!fits(part.features.curvature.size(), part.ground.positions.size()) ||
        !fits(part.features.islandArea.size(), part.ground.triangles.size()))
        fail(ErrorKind::input, "{}: what is said of the surface does not fit its mesh",
             path.string());
    readImages(folder, id, part.ground);
    return part;
}

fs::path tilePath(const fs::path& folder, std::uint32_t tile)
{
    return folder / fmt::format("tile-{:06}.blades", tile);
}

void writeTile(const fs::path& path, const std::string& id, const TileResult& tile)
{
    terrain::RecordWriter writer(path, tileKind, true);
    writer.add(std::string_view(id));
    writer.addOne(TileNumbers{tile.counts, tile.spacingMinimum});
    writer.addOne(static_cast<std::uint64_t>(tile.cells.size()));
    std::uint64_t blades = 0;
    for (const CellTree& cell : tile.cells) {
        writer.addOne(CellHeader{cell.cell, cell.summary, cell.patches.size(), cell.blades.size()});
        writer.add(cell.patches);
        blades += cell.blades.size();
    }
    writer.begin(blades, sizeof(shared::PackedBlade));
    eachStoredBlade(tile.cells, [&](std::span<const shared::PackedBlade> part) {
        writer.addPart(std::as_bytes(part));
    });
    writer.begin(blades * sizeof(field::BladeKey), 1);
    eachStoredKeyByte(tile.cells, [&](std::span<const std::byte> part) { writer.addPart(part); });
    writer.add(tile.seeds.cells);
    writer.add(tile.seeds.data);
    writer.commit();
}

std::string tileId(const TilePlan& plan, std::uint32_t tile)
{
    return fmt::format("{}, tile {}", plan.id, tile);
}

std::string idOfTile(const fs::path& path)
{
    terrain::RecordReader reader(path, tileKind);
    std::string id;
    reader.read(id);
    return id;
}

StoredTile readTile(const fs::path& path, const std::string& id, std::size_t species)
{
    terrain::RecordReader reader(path, tileKind);
    std::string own;
    reader.read(own);
    requireId(own, id, path);
    StoredTile stored;
    TileResult& tile = stored.tile;
    TileNumbers numbers = {};
    reader.readOne(numbers);
    tile.counts = numbers.counts;
    tile.spacingMinimum = numbers.spacingMinimum;
    std::uint64_t cells = 0;
    for (reader.readOne(cells); cells > 0; --cells) {
        CellTree& cell = tile.cells.emplace_back();
        CellHeader header = {};
        reader.readOne(header);
        cell.cell = header.cell;
        cell.summary = header.summary;
        reader.read(cell.patches);
        if (cell.patches.size() != header.patches)
            fail(ErrorKind::input, "{}: a cell has {} patches instead of {}", path.string(),
                 cell.patches.size(), header.patches);
        checkTree(cell, header.blades, path);
        stored.stretch.count += header.blades;
    }
    const auto blades = reader.skip(sizeof(shared::PackedBlade));
    const auto keys = reader.skip(1);
    stored.stretch.blades = blades.at;
    stored.stretch.keys = keys.at;
    if (blades.count != stored.stretch.count ||
        keys.count != stored.stretch.count * sizeof(field::BladeKey))
        fail(ErrorKind::input, "{}: {} blades and {} bytes of keys for cells of {} blades",
             path.string(), blades.count, keys.count, stored.stretch.count);
    checkSpecies(reader.bytesOf(blades, sizeof(shared::PackedBlade)), species, path);
    reader.read(tile.seeds.cells);
    const auto seeds = reader.skip(1);
    stored.seedBytes = seeds.at;
    checkSeeds(tile.seeds.cells, seeds.count, path);
    return stored;
}

} // namespace sward::bake
