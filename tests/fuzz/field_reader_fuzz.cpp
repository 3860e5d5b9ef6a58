// Whatever bytes a field file holds, reading it yields a verified view or an Error, nothing else.
// Hashes are mended first, or no change would ever come past them.

#include "core/error.h"
#include "field/format.h"
#include "field/inspect.h"
#include "field/read.h"
#include "fuzz/memory_file.h"

#include <xxhash.h>

#include <cstring>
#include <vector>

namespace {

namespace format = sward::field::format;

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

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::vector<std::uint8_t> bytes(data, data + size);
    mendHashes(bytes);
    const sward::tests::MemoryFile file(bytes.data(), bytes.size());
    try {
        const sward::field::MappedField field = sward::field::readField(file.path());
        sward::field::summarise(field.view());
    } catch (const sward::Error&) {
        // The one way in which a bad file may end.
    }
    return 0;
}
