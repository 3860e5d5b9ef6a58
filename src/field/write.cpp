#include "field/write.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"
#include "field/file/compression.h"
#include "field/file/format.h"
#include "field/file/images.h"
#include "field/file/texts.h"
#include "field/seeds/seeds.h"
#include "field/verify.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sward::field {
namespace {

using Put = std::function<void(std::uint64_t at, std::span<const std::byte>)>;

class Hash {
public:
    Hash() { XXH3_64bits_reset(state_.get()); }

    void add(std::span<const std::byte> bytes)
    {
        XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
    }

    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_{XXH3_createState(),
                                                                    XXH3_freeState};
};

// A chunk and its bytes: own ones, or a span of the field. Those of blades and keys come in pieces.
struct Chunk {
    format::ChunkEntry entry = {};
    UninitializedVector<std::byte> owned;
    std::span<const std::byte> stored;
    const SeedPieces* pieces = nullptr; // instead of stored bytes
};

std::uint64_t aligned(std::uint64_t offset)
{
    return (offset + format::alignment - 1) / format::alignment * format::alignment;
}

// The oldest version that describes the field: without newer parts a file stays the same bytes.
std::uint16_t minorVersionOf(const Field& field)
{
    const bool hasOrgans = std::any_of(field.species.begin(), field.species.end(),
                                       [](const Species& one) { return !one.organs.empty(); });
    if (field.seeds)
        return 3;
    return hasOrgans ? 2 : field.thinned == 1.0 ? 0 : 1;
}

template <typename T>
std::span<const std::byte> bytesOf(const T& value)
{
    return std::as_bytes(std::span(&value, 1));
}

// All chunks of a field. Texts and images are encoded here; arrays are referenced.
class Encoded {
public:
    Encoded(const Field& field, const BladePieces& pieces, const SeedPieces* seeds = nullptr)
        : pieces_(pieces)
        , species_(speciesText(field.species))
        , cover_(coverText(field.thinned))
        , seeds_(field.seeds ? seedMeadowText(*field.seeds->view.meadow) : std::string())
        , defaults_(defaultsText(field.defaults, field.copyright))
        , images_(imagesBytes(field.ground.images))
    {
        const DisplayGround& ground = field.ground;
        add(format::patches, std::span(field.patches), format::critical);
        addPieces(format::blades, sizeof(shared::PackedBlade), format::critical);
        addPieces(format::keys, sizeof(BladeKey), format::compressed);
        add(format::species, std::span(std::as_const(species_)), format::critical);
        add(format::groundVertices, std::span(ground.vertices), format::compressed);
        add(format::groundIndices, std::span(ground.indices), format::compressed);
        add(format::groundRanges, std::span(ground.ranges), 0);
        add(format::groundMaterials, std::span(ground.materials), 0);
        add(format::groundImages, std::span(std::as_const(images_)), format::compressed);
        add(format::defaults, std::span(std::as_const(defaults_)), format::critical);
        if (!cover_.empty())
            add(format::cover, std::span(std::as_const(cover_)), 0);
        if (field.seeds) {
            add(format::seeds, std::span(std::as_const(seeds_)), 0);
            add(format::seedCells, field.seeds->view.cells, 0);
            add(format::seedData, field.seeds->view.data, 0);
            if (seeds != nullptr) {
                format::ChunkEntry& entry = chunks_.back().entry;
                entry.elementCount = entry.rawBytes = field.seeds->view.bytes();
                chunks_.back().pieces = seeds;
            }
        }
        add(format::provenance, std::span(field.provenance), 0);
        header_.magic = format::magic;
        header_.majorVersion = format::majorVersion;
        header_.minorVersion = minorVersionOf(field);
        header_.endianMark = format::endianMark;
        header_.chunkCount = static_cast<std::uint32_t>(chunks_.size());
        header_.origin = {field.origin.x, field.origin.y, field.origin.z};
    }
    Encoded(const Encoded&) = delete;
    Encoded& operator=(const Encoded&) = delete;

    // Throws unless what was encoded reads back.
    void parse(const std::string& place) const
    {
        std::string copyright;
        parseSpecies(species_, place + ": species");
        parseDefaults(defaults_, place + ": defaults", copyright);
        if (!seeds_.empty())
            parseSeedMeadow(seeds_, place + ": seeds");
    }

    // Puts every byte of the file in its place, several threads at once. `check` sees all blades.
    void put(const Put& put, const BladePieces::TakeBlades& check)
    {
        // Only the beginning of the keys is known before they are compressed. All chunks after them
        // are compressed meanwhile.
        std::uint64_t at = sizeof header_ + chunks_.size() * sizeof(format::ChunkEntry);
        for (std::size_t i = 0; i <= keysIndex; ++i) {
            chunks_[i].entry.offset = aligned(at);
            at = chunks_[i].entry.offset + chunks_[i].entry.rawBytes;
        }
        std::vector<std::future<void>> work;
        work.push_back(std::async(std::launch::async, [&] { putKeys(put); }));
        for (std::size_t i = 0; i < chunks_.size(); ++i)
            if (i != bladesIndex && i != keysIndex)
                work.push_back(std::async(std::launch::async, finish, std::ref(chunks_[i])));
        putBlades(put, check);
        for (std::future<void>& one : work)
            one.get();

        at = chunks_[keysIndex].entry.offset + chunks_[keysIndex].entry.storedBytes;
        for (std::size_t i = keysIndex + 1; i < chunks_.size(); ++i) {
            chunks_[i].entry.offset = aligned(at);
            at = chunks_[i].entry.offset + chunks_[i].entry.storedBytes;
        }
        for (Chunk& chunk : chunks_)
            if (chunk.pieces != nullptr)
                putSeeds(put, chunk);
            else
                put(chunk.entry.offset, chunk.stored);
        static constexpr std::byte zeros[format::alignment] = {};
        put(at, std::span(zeros).first(aligned(at) - at));
        putTable(put, aligned(at));
    }

    const format::FileHeader& header() const { return header_; }
    const std::vector<Chunk>& chunks() const { return chunks_; }

private:
    static constexpr std::size_t bladesIndex = 1;
    static constexpr std::size_t keysIndex = 2;

    template <typename T>
    void add(format::ChunkId id, std::span<const T> elements, std::uint32_t flags)
    {
        addEntry(id, flags, sizeof(T), elements.size()).stored = std::as_bytes(elements);
    }

    void addPieces(format::ChunkId id, std::uint32_t elementBytes, std::uint32_t flags)
    {
        addEntry(id, flags, elementBytes, pieces_.count());
    }

    Chunk& addEntry(format::ChunkId id, std::uint32_t flags, std::uint32_t elementBytes,
                    std::uint64_t count)
    {
        Chunk& chunk = chunks_.emplace_back();
        chunk.entry.id = id;
        chunk.entry.flags = flags;
        chunk.entry.elementBytes = elementBytes;
        chunk.entry.elementCount = count;
        chunk.entry.rawBytes = elementBytes * count;
        return chunk;
    }

    // Compresses a chunk that is flagged so, and hashes it.
    static void finish(Chunk& chunk)
    {
        if (chunk.pieces != nullptr) {
            chunk.entry.storedBytes = chunk.entry.rawBytes;
            return;
        }
        if ((chunk.entry.flags & format::compressed) != 0) {
            chunk.owned = compress(chunk.stored, chunk.entry.elementBytes);
            chunk.stored = chunk.owned;
        }
        chunk.entry.storedBytes = chunk.stored.size();
        chunk.entry.hash = XXH3_64bits(chunk.stored.data(), chunk.stored.size());
    }

    void putBlades(const Put& put, const BladePieces::TakeBlades& check)
    {
        format::ChunkEntry& entry = chunks_[bladesIndex].entry;
        Hash hash;
        pieces_.eachBlade([&](std::span<const shared::PackedBlade> blades) {
            const std::span<const std::byte> bytes = std::as_bytes(blades);
            expect(bytes.size() <= entry.rawBytes - entry.storedBytes, "as many blades as counted");
            check(blades);
            put(entry.offset + entry.storedBytes, bytes);
            hash.add(bytes);
            entry.storedBytes += bytes.size();
        });
        expect(entry.storedBytes == entry.rawBytes, "as many blades as counted");
        entry.hash = hash.digest();
    }

    void putKeys(const Put& put)
    {
        format::ChunkEntry& entry = chunks_[keysIndex].entry;
        Hash hash;
        Compressor compressor(entry.rawBytes, [&](std::span<const std::byte> bytes) {
            put(entry.offset + entry.storedBytes, bytes);
            hash.add(bytes);
            entry.storedBytes += bytes.size();
        });
        for (std::size_t byte = 0; byte < entry.elementBytes; ++byte)
            pieces_.eachKeyByte(byte,
                                [&](std::span<const std::byte> bytes) { compressor.add(bytes); });
        compressor.finish();
        entry.hash = hash.digest();
    }

    static void putSeeds(const Put& put, Chunk& chunk)
    {
        Hash hash;
        std::uint64_t at = 0;
        chunk.pieces->eachSeedByte([&](std::span<const std::byte> bytes) {
            expect(bytes.size() <= chunk.entry.storedBytes - at, "as many seeds as counted");
            put(chunk.entry.offset + at, bytes);
            hash.add(bytes);
            at += bytes.size();
        });
        expect(at == chunk.entry.storedBytes, "as many seeds as counted");
        chunk.entry.hash = hash.digest();
    }

    // Header and table, which hold the hashes of all others.
    void putTable(const Put& put, std::uint64_t fileBytes)
    {
        header_.fileBytes = fileBytes;
        std::vector<std::byte> bytes(sizeof header_ + chunks_.size() * sizeof(format::ChunkEntry));
        std::memcpy(bytes.data(), &header_, sizeof header_);
        for (std::size_t i = 0; i < chunks_.size(); ++i)
            std::memcpy(bytes.data() + sizeof header_ + i * sizeof(format::ChunkEntry),
                        &chunks_[i].entry, sizeof(format::ChunkEntry));
        header_.tableHash = XXH3_64bits(bytes.data(), bytes.size());
        std::memcpy(bytes.data(), &header_, sizeof header_);
        put(0, bytes);
    }

    const BladePieces& pieces_;
    std::string species_;
    std::string cover_;
    std::string seeds_;
    std::string defaults_;
    std::vector<std::byte> images_;
    std::vector<Chunk> chunks_;
    format::FileHeader header_ = {};
};

// Blades and keys of a field in memory.
class WholePieces : public BladePieces {
public:
    explicit WholePieces(const Field& field)
        : field_(field)
    {
    }

    std::uint64_t count() const override { return field_.blades.size(); }
    void eachBlade(const TakeBlades& take) const override { take(field_.blades); }
    void eachKeyByte(std::size_t byte, const TakeBytes& take) const override
    {
        regroup(std::as_bytes(std::span(field_.keys)), sizeof(BladeKey), byte, take);
    }

private:
    const Field& field_;
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
        Hash found;
        return eachBlock(bytes,
                         [&](std::span<const std::byte> block, std::size_t) {
                             found.add(block);
                             return true;
                         }) &&
               found.digest() == hash;
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
    const WholePieces pieces(field);
    Encoded encoded(field, pieces);
    encoded.put([](std::uint64_t, std::span<const std::byte>) {},
                [](std::span<const shared::PackedBlade>) {});
    return encoded.header().fileBytes;
}

std::uint64_t writeField(const Field& field, const BladePieces& pieces,
                         const std::filesystem::path& path, bool overwrite, const SeedPieces* seeds)
{
    verifyWithoutBlades(viewOf(field), pieces.count(), path.string());
    BladeVerifier verifier(viewOf(field), path.string());
    AtomicFile file(path, overwrite);
    Encoded encoded(field, pieces, seeds);
    encoded.parse(path.string());
    encoded.put(
        [&](std::uint64_t at, std::span<const std::byte> bytes) { file.writeAt(at, bytes); },
        [&](std::span<const shared::PackedBlade> blades) { verifier.add(blades); });

    // Verify the bytes on the disk before the file gets its name.
    file.flush();
    checkWritten(file.temporaryPath(), path, encoded.header(), encoded.chunks());
    file.commit();
    return encoded.header().fileBytes;
}

std::uint64_t writeField(const Field& field, const std::filesystem::path& path, bool overwrite)
{
    requireUsage(field.keys.size() == field.blades.size(), "{}: {} keys for {} blades",
                 path.string(), field.keys.size(), field.blades.size());
    return writeField(field, WholePieces(field), path, overwrite);
}

} // namespace sward::field
