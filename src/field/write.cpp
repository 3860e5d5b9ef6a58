#include "field/write.h"

#include "core/atomic_file.h"
#include "core/error.h"
#include "field/compression.h"
#include "field/format.h"
#include "field/images.h"
#include "field/texts.h"
#include "field/verify.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sward::field {
namespace {

// A chunk ready to be written: either its own bytes or a span of the field.
struct Chunk {
    format::ChunkEntry entry = {};
    UninitializedVector<std::byte> owned;
    std::span<const std::byte> stored;
};

std::uint64_t aligned(std::uint64_t offset)
{
    return (offset + format::alignment - 1) / format::alignment * format::alignment;
}

class ChunkList {
public:
    // Stores an array as it is in memory.
    template <typename T>
    void addPlain(format::ChunkId id, std::span<const T> elements, std::uint32_t flags)
    {
        Chunk& chunk = add(id, elements, flags);
        chunk.stored = std::as_bytes(elements);
    }

    // Stores an array compressed, after regrouping the bytes of its elements.
    template <typename T>
    void addCompressed(format::ChunkId id, std::span<const T> elements, std::uint32_t flags)
    {
        add(id, elements, flags | format::compressed).stored = std::as_bytes(elements);
    }

    // Compresses the flagged chunks and hashes all, in parallel.
    void compressAll()
    {
        std::vector<std::future<void>> work;
        for (Chunk& chunk : chunks_)
            work.push_back(std::async(std::launch::async, [&chunk] {
                if ((chunk.entry.flags & format::compressed) != 0) {
                    chunk.owned = compress(chunk.stored, chunk.entry.elementBytes);
                    chunk.stored = chunk.owned;
                }
                chunk.entry.hash = XXH3_64bits(chunk.stored.data(), chunk.stored.size());
            }));
        for (std::future<void>& chunk : work)
            chunk.get();
    }

    std::vector<Chunk>& chunks() { return chunks_; }
    const std::vector<Chunk>& chunks() const { return chunks_; }

private:
    template <typename T>
    Chunk& add(format::ChunkId id, std::span<const T> elements, std::uint32_t flags)
    {
        Chunk& chunk = chunks_.emplace_back();
        chunk.entry.id = id;
        chunk.entry.flags = flags;
        chunk.entry.elementBytes = sizeof(T);
        chunk.entry.elementCount = elements.size();
        chunk.entry.rawBytes = elements.size_bytes();
        return chunk;
    }

    std::vector<Chunk> chunks_;
};

// The oldest version that describes the field: without newer parts a file stays the same bytes.
std::uint16_t minorVersionOf(const Field& field)
{
    const bool hasOrgans = std::any_of(field.species.begin(), field.species.end(),
                                       [](const Species& one) { return !one.organs.empty(); });
    return hasOrgans ? format::minorVersion : field.thinned == 1.0 ? 0 : 1;
}

// Assigns each chunk its offset, and the header its hash.
format::FileHeader layOut(std::vector<Chunk>& chunks, const Field& field)
{
    std::uint64_t offset = sizeof(format::FileHeader) + chunks.size() * sizeof(format::ChunkEntry);
    for (Chunk& chunk : chunks) {
        offset = aligned(offset);
        chunk.entry.offset = offset;
        chunk.entry.storedBytes = chunk.stored.size();
        offset += chunk.stored.size();
    }

    format::FileHeader header = {};
    header.magic = format::magic;
    header.majorVersion = format::majorVersion;
    header.minorVersion = minorVersionOf(field);
    header.endianMark = format::endianMark;
    header.fileBytes = aligned(offset);
    header.chunkCount = static_cast<std::uint32_t>(chunks.size());
    header.origin = {field.origin.x, field.origin.y, field.origin.z};

    std::vector<std::byte> hashed(sizeof header + chunks.size() * sizeof(format::ChunkEntry));
    std::memcpy(hashed.data(), &header, sizeof header);
    for (std::size_t i = 0; i < chunks.size(); ++i)
        std::memcpy(hashed.data() + sizeof header + i * sizeof(format::ChunkEntry),
                    &chunks[i].entry, sizeof(format::ChunkEntry));
    header.tableHash = XXH3_64bits(hashed.data(), hashed.size());
    return header;
}

template <typename T>
std::span<const std::byte> bytesOf(const T& value)
{
    return std::as_bytes(std::span(&value, 1));
}

void writePadding(AtomicFile& file, std::uint64_t& at)
{
    static constexpr std::byte zeros[format::alignment] = {};
    const std::uint64_t count = aligned(at) - at;
    file.write(std::span(zeros).first(count));
    at += count;
}

// All chunks of a field. Texts and images are encoded here; arrays are referenced.
struct Encoded {
    std::string species;
    std::string cover;
    std::string defaults;
    std::vector<std::byte> images;
    ChunkList list;
    format::FileHeader header;

    explicit Encoded(const Field& field)
        : species(speciesText(field.species))
        , cover(coverText(field.thinned))
        , defaults(defaultsText(field.defaults, field.copyright))
        , images(imagesBytes(field.ground.images))
    {
        const DisplayGround& ground = field.ground;
        list.addPlain(format::patches, std::span(field.patches), format::critical);
        list.addPlain(format::blades, std::span(field.blades), format::critical);
        list.addCompressed(format::keys, std::span(field.keys), 0);
        list.addPlain(format::species, std::span(std::as_const(species)), format::critical);
        list.addCompressed(format::groundVertices, std::span(ground.vertices), 0);
        list.addCompressed(format::groundIndices, std::span(ground.indices), 0);
        list.addPlain(format::groundRanges, std::span(ground.ranges), 0);
        list.addPlain(format::groundMaterials, std::span(ground.materials), 0);
        list.addCompressed(format::groundImages, std::span(std::as_const(images)), 0);
        list.addPlain(format::defaults, std::span(std::as_const(defaults)), format::critical);
        if (!cover.empty())
            list.addPlain(format::cover, std::span(std::as_const(cover)), 0);
        list.addPlain(format::provenance, std::span(field.provenance), 0);
        list.compressAll();
        header = layOut(list.chunks(), field);
    }
    Encoded(const Encoded&) = delete;
    Encoded& operator=(const Encoded&) = delete;
};

// Reads a file from front to back in blocks: mapped, its pages would count as memory.
class Rereading {
public:
    explicit Rereading(const std::filesystem::path& path)
        : file_(path, std::ios::binary)
        , block_(std::size_t(1) << 20)
    {
    }

    // Whether the next bytes equal `meant`.
    bool matches(std::span<const std::byte> meant)
    {
        return eachBlock(meant.size(), [&](std::span<const std::byte> block, std::size_t at) {
            return std::memcmp(block.data(), meant.data() + at, block.size()) == 0;
        });
    }

    // Whether the next bytes have this hash.
    bool matches(std::size_t bytes, std::uint64_t hash)
    {
        const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                             XXH3_freeState);
        XXH3_64bits_reset(state.get());
        return eachBlock(bytes,
                         [&](std::span<const std::byte> block, std::size_t) {
                             XXH3_64bits_update(state.get(), block.data(), block.size());
                             return true;
                         }) &&
               XXH3_64bits_digest(state.get()) == hash;
    }

    bool isAtEnd() { return file_.peek() == std::ifstream::traits_type::eof(); }

private:
    template <typename Check>
    bool eachBlock(std::size_t bytes, Check check)
    {
        for (std::size_t at = 0; at < bytes;) {
            const std::size_t size = std::min(block_.size(), bytes - at);
            if (!file_.read(reinterpret_cast<char*>(block_.data()),
                            static_cast<std::streamsize>(size)) ||
                !check(std::span<const std::byte>(block_.data(), size), at))
                return false;
            at += size;
        }
        return true;
    }

    std::ifstream file_;
    std::vector<std::byte> block_;
};

// Throws Error{io} unless the file holds this header and these chunks.
void checkWritten(const std::filesystem::path& written, const std::filesystem::path& path,
                  const format::FileHeader& header, const std::vector<Chunk>& chunks)
{
    static constexpr std::byte zeros[format::alignment] = {};
    Rereading file(written);
    bool isWhole = file.matches(bytesOf(header));
    std::uint64_t at = sizeof header;
    for (const Chunk& chunk : chunks) {
        isWhole = isWhole && file.matches(bytesOf(chunk.entry));
        at += sizeof chunk.entry;
    }
    for (const Chunk& chunk : chunks) {
        isWhole = isWhole && file.matches(std::span(zeros).first(chunk.entry.offset - at)) &&
                  file.matches(chunk.entry.storedBytes, chunk.entry.hash);
        at = chunk.entry.offset + chunk.entry.storedBytes;
    }
    isWhole =
        isWhole && file.matches(std::span(zeros).first(header.fileBytes - at)) && file.isAtEnd();
    if (!isWhole)
        fail(ErrorKind::io, "{}: the file differs from what was written; the disk may be damaged",
             path.string());
}

} // namespace

std::uint64_t fieldBytes(const Field& field)
{
    return Encoded(field).header.fileBytes;
}

std::uint64_t writeField(const Field& field, const std::filesystem::path& path, bool overwrite)
{
    requireUsage(field.keys.size() == field.blades.size(), "{}: {} keys for {} blades",
                 path.string(), field.keys.size(), field.blades.size());
    verify(viewOf(field), path.string());
    AtomicFile file(path, overwrite);

    const Encoded encoded(field);
    std::string copyright;
    parseSpecies(encoded.species, fmt::format("{}: species", path.string()));
    parseDefaults(encoded.defaults, fmt::format("{}: defaults", path.string()), copyright);
    const std::vector<Chunk>& chunks = encoded.list.chunks();
    file.write(bytesOf(encoded.header));
    for (const Chunk& chunk : chunks)
        file.write(bytesOf(chunk.entry));
    std::uint64_t at = sizeof encoded.header + chunks.size() * sizeof(format::ChunkEntry);
    for (const Chunk& chunk : chunks) {
        writePadding(file, at);
        file.write(chunk.stored);
        at += chunk.stored.size();
    }
    writePadding(file, at);

    // Verify the bytes on the disk before the file gets its name.
    file.flush();
    checkWritten(file.temporaryPath(), path, encoded.header, chunks);
    file.commit();
    return encoded.header.fileBytes;
}

} // namespace sward::field
