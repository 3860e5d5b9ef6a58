#include "interchange/tiles/subtree_files.h"

#include "core/files/atomic_file.h"
#include "core/json/json_text.h"
#include "interchange/tiles/tile_folders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Tiles of an octree with `levels` levels.
constexpr std::size_t tilesOf(std::uint32_t levels)
{
    return ((std::size_t(1) << (3U * levels)) - 1) / 7;
}

// Bits, the first one lowest.
class Bits {
public:
    explicit Bits(std::size_t count)
        : bytes_((count + 7) / 8)
    {
    }
    void set(std::size_t bit) { bytes_[bit / 8] |= static_cast<std::uint8_t>(1U << bit % 8); }
    std::size_t ones() const
    {
        std::size_t sum = 0;
        for (const std::uint8_t byte : bytes_)
            sum += static_cast<std::size_t>(std::popcount(byte));
        return sum;
    }
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

// What a subtree knows of its tiles.
struct Subtree {
    Bits tiles{tilesOf(subtreeLevels)};
    Bits contents{tilesOf(subtreeLevels)};
    Bits children{std::size_t(1) << (3U * subtreeLevels)};
};

// Morton number of a tile `below` levels below the root of its subtree.
std::size_t mortonIn(const std::array<std::uint32_t, 4>& tile, std::uint32_t below)
{
    std::size_t number = 0;
    for (std::uint32_t bit = 0; bit < below; ++bit)
        for (std::size_t axis = 0; axis < 3; ++axis)
            number |= std::size_t(tile[axis + 1] >> bit & 1U) << (3U * bit + axis);
    return number;
}

// An availability as JSON; appends its bits to `binary`, at a multiple of eight bytes.
ordered_json availability(const Bits& bits, ordered_json& views, std::string& binary)
{
    if (bits.ones() == 0)
        return {{"constant", 0}};
    const std::size_t offset = binary.size();
    binary.append(bits.bytes().begin(), bits.bytes().end());
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bits.bytes().size()}});
    binary.resize((binary.size() + 7) / 8 * 8, '\0');
    return {{"bitstream", views.size() - 1}, {"availableCount", bits.ones()}};
}

std::string fileOf(const Subtree& subtree)
{
    ordered_json views = ordered_json::array();
    std::string binary;
    ordered_json json;
    const ordered_json tiles = availability(subtree.tiles, views, binary);
    const ordered_json contents = availability(subtree.contents, views, binary);
    const ordered_json children = availability(subtree.children, views, binary);
    json["buffers"] = ordered_json::array({{{"byteLength", binary.size()}}});
    json["bufferViews"] = std::move(views);
    json["tileAvailability"] = tiles;
    json["contentAvailability"] = ordered_json::array({contents});
    json["childSubtreeAvailability"] = children;
    std::string text = jsonText(json);
    text.resize((text.size() + 7) / 8 * 8, ' ');

    const std::uint32_t front[] = {0x74627573U /* subt */, 1};
    const std::uint64_t lengths[] = {text.size(), binary.size()};
    std::string file(sizeof front + sizeof lengths, '\0');
    std::memcpy(file.data(), front, sizeof front);
    std::memcpy(file.data() + sizeof front, lengths, sizeof lengths);
    return file + text + binary;
}

} // namespace

void TileAvailability::add(const TileNumber& tile, bool hasContent)
{
    tiles_[{tile.level, tile.at[0], tile.at[1], tile.at[2]}] = hasContent;
    levels_ = std::max(levels_, tile.level + 1);
}

void TileAvailability::write(const std::filesystem::path& folder) const
{
    std::map<Key, Subtree> subtrees;
    for (const auto& [tile, hasContent] : tiles_) {
        const std::uint32_t below = tile[0] % subtreeLevels;
        const auto above = [&](std::uint32_t levels) {
            return Key{tile[0] - levels, tile[1] >> levels, tile[2] >> levels, tile[3] >> levels};
        };
        Subtree& own = subtrees[above(below)];
        const std::size_t bit = tilesOf(below) + mortonIn(tile, below);
        own.tiles.set(bit);
        if (hasContent)
            own.contents.set(bit);
        // The root of a subtree is a child of the subtree above.
        if (below == 0 && tile[0] > 0)
            subtrees[above(subtreeLevels)].children.set(mortonIn(tile, subtreeLevels));
    }
    for (const auto& [root, subtree] : subtrees) {
        const std::filesystem::path path = folder / fmt::format("subtrees/{}/{}/{}/{}.subtree",
                                                                root[0], root[1], root[2], root[3]);
        makeFolderFor(path);
        AtomicFile file(path, false);
        file.write(fileOf(subtree));
        file.commit(false);
    }
}

} // namespace sward::interchange
