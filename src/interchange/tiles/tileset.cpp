#include "interchange/tiles/tileset.h"

#include "core/files/atomic_file.h"
#include "core/json/json_text.h"
#include "interchange/compact/compact_glb.h"
#include "interchange/compact/morton_order.h"
#include "interchange/gltf/glb_container.h"
#include "interchange/gltf/gltf_species.h"
#include "interchange/tiles/earth_bend.h"
#include "interchange/tiles/subtree_files.h"
#include "interchange/tiles/tile_folders.h"
#include "interchange/tiles/tile_tree.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Levels are not divided below this size [m], however many blades a cube holds.
constexpr double smallestTile = 0.5;

// A share above all ranks.
constexpr float allBlades = 2.0f;

// The bend of a field that lies on a map.
std::optional<EarthBend> bendOf(const field::FieldView& field, const ExportSettings& settings)
{
    if (!settings.map)
        return std::nullopt;
    return EarthBend(*settings.map, field.origin, rootBounds(field));
}

// From the axes of tiles to those of the field.
glm::dmat4 fieldAxes()
{
    return glm::dmat4(glm::dmat3(fieldPlace({1.0, 0.0, 0.0}), fieldPlace({0.0, 1.0, 0.0}),
                                 fieldPlace({0.0, 0.0, 1.0})));
}

class Tileset {
public:
    Tileset(const field::FieldView& field, const std::filesystem::path& folder,
            const ExportSettings& settings, Progress& progress)
        : field_(field)
        , folder_(folder)
        , settings_(settings)
        , progress_(progress)
        , bend_(bendOf(field, settings))
        , tree_(field, bend_ ? &*bend_ : nullptr)
        , means_(meanBlades(field, settings.rest))
        , counter_(settings.rest)
    {
    }

    TilesetSummary run()
    {
        progress_.begin("export", field_.blades.size());
        const Tile root = tree_.root();
        if (!field_.blades.empty())
            write(root, tree_.bladesIn(root));
        else
            available_.add(root.number, false);
        available_.write(folder_);
        writeTextFile(folder_ / "tileset.json", jsonText(description(root)), false);
        return summary_;
    }

private:
    // Writes a tile that holds `blades`, and those below it.
    void write(const Tile& tile, std::uint64_t blades)
    {
        // Tiles with children count no progress.
        progress_.throwIfCancelled();
        const bool isLeaf = blades <= largestTile || tile.size <= smallestTile;
        const float share =
            isLeaf ? allBlades : float(tileRepresentatives) / static_cast<float>(blades);
        const bool hasContent = writeContent(tile, share, isLeaf);
        available_.add(tile.number, hasContent);
        counter_.add(isLeaf ? blades : tileRepresentatives);
        if (isLeaf) {
            progress_.advance(blades);
            return;
        }
        if (tile.number.level >= deepestLevel_) {
            shareSum_ = tile.number.level > deepestLevel_ ? 0.0 : shareSum_;
            shareCount_ = tile.number.level > deepestLevel_ ? 0 : shareCount_;
            deepestLevel_ = tile.number.level;
            shareSum_ += double(share);
            ++shareCount_;
        }
        for (const Tile& child : tree_.childrenOf(tile))
            if (const std::uint64_t below = tree_.bladesIn(child); below > 0)
                write(child, below);
    }

    // Writes the .glb of a tile. Returns whether it has one.
    bool writeContent(const Tile& tile, float share, bool isLeaf)
    {
        const glm::dvec3 place = fieldPlace(tile.low + 0.5 * tile.size);
        std::vector<Instance> instances = tree_.instancesIn(tile, share, place, settings_.source);
        if (instances.empty())
            return false;

        // Only species that grow here; they get numbers of their own.
        std::vector<std::uint32_t> numbers(field_.species.size(), 0);
        for (const Instance& i : instances)
            numbers[i.blade.species] = 1;
        std::vector<field::Species> species;
        std::vector<MeanBlade> means;
        for (std::size_t s = 0; s < numbers.size(); ++s)
            if (std::exchange(numbers[s], static_cast<std::uint32_t>(species.size())) != 0) {
                species.push_back(field_.species[s]);
                means.push_back(means_[s]);
            }
        field::FieldView own = field_;
        own.species = species;
        Aabb bounds;
        const float widening = isLeaf ? 1.0f : std::min(1.0f / share, largestWidening);
        for (Instance& i : instances) {
            i.blade.species = numbers[i.blade.species];
            // The mesh of a plant holds its leaves, which keep their form.
            if (species[i.blade.species].organs.empty())
                i.scale.x *= widening;
            const float reach = std::max(i.scale.x, i.scale.y);
            bounds.add(i.place - reach);
            bounds.add(i.place + reach);
        }
        sortForCompression(instances, std::ldexp(1.0f, compactPlaceExponent));
        const CompactInstances compact = compressInstances(instances, settings_.withIds);

        GltfDocument document(settings_.generator, *field_.copyright);
        addSpecies(document, own, means, isLeaf ? SpeciesLevels::full : SpeciesLevels::coarse);
        document.require(instancingExtension);
        document.require(settings_.meshoptExtension);
        const std::vector<std::size_t> nodes = addCompactNodes(
            document, own, compact,
            {.name = "tile", .place = place, .bounds = bounds, .firstMesh = 0}, settings_);
        document.setScene(
            document.add("nodes", {{"name", "tile"}, {"children", ordered_json(nodes)}}));

        const auto& [level, at] = tile.number;
        const std::filesystem::path path =
            folder_ / fmt::format("content/{}/{}/{}/{}.glb", level, at[0], at[1], at[2]);
        makeFolderFor(path);
        AtomicFile file(path, false);
        const std::string text = document.text();
        writeGlbHeader(file, text, document.binaryBytes());
        file.write(document.fixedBytes());
        file.write(streamBytes(compact));
        file.commit(false);
        ++summary_.tiles;
        summary_.blades += compact.count;
        summary_.bytes += glbHeaderBytes + text.size() + document.binaryBytes();
        return true;
    }

    // Mean width of all blades [m].
    double meanWidth() const
    {
        double sum = 0.0;
        for (const shared::Patch& patch : field_.patches)
            sum += double(patch.bladeCount) * double(patch.widthLow + 31.5f * patch.widthStep);
        return sum / std::max(1.0, double(field_.blades.size()));
    }

    // Error of the root [m]. Each level has half of that above it. On the deepest level with
    // children a tile is refined where its blades are a pixel wide.
    double rootError() const
    {
        if (shareCount_ == 0)
            return viewerErrorPixels * meanWidth();
        const double widened = meanWidth() * double(shareCount_) / shareSum_;
        return viewerErrorPixels * widened * std::exp2(double(deepestLevel_));
    }

    // The field's origin in the world, and the world's on the Earth.
    glm::dmat4 rootTransform() const
    {
        if (bend_)
            return bend_->toEarth() * fieldAxes();
        glm::dmat4 transform(1.0);
        transform[3] = glm::dvec4(tilePlace(field_.origin), 1.0);
        return settings_.at ? eastNorthUp(*settings_.at) * transform : transform;
    }

    ordered_json description(const Tile& root) const
    {
        const double half = 0.5 * root.size;
        const glm::dvec3 centre = root.low + half;
        ordered_json asset = {{"version", "1.1"}, {"generator", settings_.generator}};
        if (!field_.copyright->empty())
            asset["copyright"] = *field_.copyright;
        const glm::dmat4 transform = rootTransform();
        ordered_json numbers = ordered_json::array();
        for (glm::length_t column = 0; column < 4; ++column)
            for (glm::length_t row = 0; row < 4; ++row)
                numbers.push_back(transform[column][row]);
        ordered_json tile = {
            {"transform", std::move(numbers)},
            {"boundingVolume",
             {{"box",
               {centre.x, centre.y, centre.z, half, 0.0, 0.0, 0.0, half, 0.0, 0.0, 0.0, half}}}},
            {"refine", "REPLACE"},
            {"geometricError", rootError()},
            {"content", {{"uri", "content/{level}/{x}/{y}/{z}.glb"}}},
            {"implicitTiling",
             {{"subdivisionScheme", "OCTREE"},
              {"availableLevels", available_.levels()},
              {"subtreeLevels", subtreeLevels},
              {"subtrees", {{"uri", "subtrees/{level}/{x}/{y}/{z}.subtree"}}}}}};
        return {{"asset", std::move(asset)},
                {"geometricError", 2.0 * rootError()},
                {"root", std::move(tile)}};
    }

    const field::FieldView& field_;
    const std::filesystem::path& folder_;
    const ExportSettings& settings_;
    Progress& progress_;
    std::optional<EarthBend> bend_;
    TileTree tree_;
    std::vector<MeanBlade> means_;
    BladeCounter counter_;
    TileAvailability available_;
    TilesetSummary summary_;
    std::uint32_t deepestLevel_ = 0; ///< of a tile with children
    double shareSum_ = 0.0;          ///< of tiles on this level
    std::uint64_t shareCount_ = 0;
};

} // namespace

TilesetSummary writeTiles(const field::FieldView& field, const std::filesystem::path& folder,
                          const ExportSettings& settings, Progress& progress)
{
    return Tileset(field, folder, settings, progress).run();
}

} // namespace sward::interchange
