// Reading the files between plan, tile and merge gives an accepted object or an Error. Hashes are
// repaired first; otherwise every change would fail the hash check.

#include "bake/tiles/tile_files.h"

#include "core/error.h"
#include "core/expect.h"
#include "fuzz/memory_file.h"
#include "terrain/files/ground_file.h"

#include <xxhash.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace sward::fuzz {
namespace {

// The first byte chooses the kind of file; the file's magic is then set correctly.
constexpr std::array<const char*, 3> kinds = {bake::partKind, bake::tileKind, bake::imageKind};
constexpr std::size_t kindBytes = 8;

std::vector<std::uint8_t> mended(Bytes bytes, std::size_t kind)
{
    std::vector<std::uint8_t> file(bytes.begin(), bytes.end());
    if (file.size() < kindBytes + sizeof(std::uint64_t))
        return file;
    std::memcpy(file.data(), kinds[kind], kindBytes);
    const std::size_t end = file.size() - sizeof(std::uint64_t);
    const std::uint64_t digest = XXH3_64bits(file.data(), end);
    std::memcpy(file.data() + end, &digest, sizeof digest);
    return file;
}

void readPart(Bytes file)
{
    const std::filesystem::path path = memoryFile().hold(file, ".ground", "part-000000");
    const bake::TilePart part = bake::readPart(path.parent_path(), 0, tileFilesId);
    if (!part.ground.triangles.empty())
        terrain::validate(part.ground, path.string());
}

void joinTile(Bytes file)
{
    const std::filesystem::path path = memoryFile().hold(file, ".blades");
    bake::StoredTile stored = bake::readTile(path, tileFilesId);
    bake::StoredCells cells;
    cells.add(std::move(stored.tile.cells), stored.stretch, path);
    field::Field field;
    cells.layOut(field);
    cells.eachBlade([](std::span<const shared::PackedBlade>) {});
    cells.eachKeyByte(sizeof(field::BladeKey) - 1, [](std::span<const std::byte>) {});
}

void readImage(Bytes file)
{
    const std::filesystem::path path = memoryFile().hold(file, ".pixels");
    terrain::RecordReader reader(path, kinds[2]);
    std::string id;
    reader.read(id);
    terrain::GroundImage image;
    image.width = 2;
    image.height = 1;
    terrain::readPixels(reader, image, path.string());
    expect(image.rgba.size() == 8, "an image of its size");
}

} // namespace

void tileFiles(Bytes bytes)
{
    if (bytes.empty())
        return;
    const std::size_t kind = bytes[0] % (kinds.size() + 1);
    const Bytes rest = bytes.subspan(1);
    try {
        if (kind == 0)
            readPart(mended(rest, kind));
        else if (kind == 1)
            joinTile(mended(rest, kind));
        else if (kind == 2)
            readImage(mended(rest, kind));
        else
            bake::readPlan(memoryFile().hold(rest, ".json"));
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
