// Reading a field file gives a verified view or an Error. Hashes are repaired first; otherwise
// every change would fail the hash check.

#include "core/error.h"
#include "field/file/format.h"
#include "field/inspect.h"
#include "field/read.h"
#include "field/seeds/sower.h"
#include "fuzz/memory_file.h"

#include <xxhash.h>

#include <cstring>
#include <vector>

namespace sward::fuzz {
namespace {

namespace format = field::format;

void mendHashes(std::vector<std::uint8_t>& bytes)
{
    format::FileHeader header = {};
    if (bytes.size() < sizeof header)
        return;
    std::memcpy(&header, bytes.data(), sizeof header);
    header.fileBytes = bytes.size();
    header.tableHash = 0;
    const std::size_t table = std::size_t(header.chunkCount) * sizeof(format::ChunkEntry);
    if (table > bytes.size() - sizeof header)
        return;
    for (std::uint32_t i = 0; i < header.chunkCount; ++i) {
        std::uint8_t* const place = bytes.data() + sizeof header + i * sizeof(format::ChunkEntry);
        format::ChunkEntry entry = {};
        std::memcpy(&entry, place, sizeof entry);
        if (entry.offset <= bytes.size() && entry.storedBytes <= bytes.size() - entry.offset)
            entry.hash = XXH3_64bits(bytes.data() + entry.offset, entry.storedBytes);
        std::memcpy(place, &entry, sizeof entry);
    }
    std::memcpy(bytes.data(), &header, sizeof header);
    header.tableHash = XXH3_64bits(bytes.data(), sizeof header + table);
    std::memcpy(bytes.data(), &header, sizeof header);
}

// Reads all cells, and sows those whose candidates are few enough for a fuzzer.
void growSeeds(const field::SeedsView& seeds, const field::FieldView& view)
{
    constexpr std::uint64_t fewCandidates = 20'000;
    const field::Sower sower(*seeds.meadow, view.species, view.origin);
    for (std::size_t i = 0; i < seeds.cells.size(); ++i) {
        const field::SeedCell cell = field::readSeedCell(seeds, i, "fuzz");
        std::uint64_t candidates = 0;
        for (const shared::SeedPiece& piece : cell.pieces)
            candidates += piece.count;
        if (candidates < fewCandidates)
            sower.sow(cell, {});
    }
}

} // namespace

void fieldReader(Bytes bytes)
{
    std::vector<std::uint8_t> mended(bytes.begin(), bytes.end());
    mendHashes(mended);
    try {
        const field::MappedField field = field::readField(memoryFile().hold(mended, ".sward"));
        field::summarise(field.view());
        if (const field::SeedsView* const seeds = field.view().seeds)
            growSeeds(*seeds, field.view());
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
