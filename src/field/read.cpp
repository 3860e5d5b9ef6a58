#include "field/read.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"
#include "core/uninitialized.h"
#include "field/file/compression.h"
#include "field/file/format.h"
#include "field/file/images.h"
#include "field/file/texts.h"
#include "field/seeds/seeds.h"
#include "field/verify.h"

#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <limits>
#include <memory>
#include <optional>

namespace sward::field {

struct MappedField::Contents {
    std::optional<MappedFile> file; ///< unless the file is held in memory …
    std::vector<std::byte> owned;   ///< … here, or by the caller
    std::span<const std::byte> bytes;
    UninitializedVector<BladeKey> keys;
    std::vector<Species> species;
    DisplayGround ground;
    std::optional<SeedMeadow> meadow;
    SeedsView seeds;
    Defaults defaults;
    std::string provenance = "{}";
    std::string copyright;
    FieldView view;

    void read(const std::string& name, const ReadOptions& options);
};

namespace {

using Bytes = std::span<const std::byte>;

// What a frugal reader has in memory at most [bytes], of a mapped file.
constexpr std::size_t frugalBytes = std::size_t(64) << 20;

// Calls see(piece) for pieces of `bytes`, in order, and leaves each on disk after it.
template <typename T, typename See>
void seeByPieces(std::span<const T> all, See see)
{
    constexpr std::size_t most = frugalBytes / sizeof(T);
    for (std::size_t at = 0; at < all.size(); at += most) {
        const std::span<const T> piece = all.subspan(at, std::min(most, all.size() - at));
        see(piece);
        leaveOnDisk(std::as_bytes(piece));
    }
}

std::uint64_t hashOf(Bytes bytes, bool isFrugal)
{
    if (!isFrugal)
        return XXH3_64bits(bytes.data(), bytes.size());
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    seeByPieces(bytes,
                [&](Bytes piece) { XXH3_64bits_update(state.get(), piece.data(), piece.size()); });
    return XXH3_64bits_digest(state.get());
}

// A file being read: its bytes, header and verified chunk table.
class Reader {
public:
    Reader(Bytes bytes, std::string place, bool isFrugal)
        : bytes_(bytes)
        , place_(std::move(place))
        , isFrugal_(isFrugal)
    {
        readHeader();
        readTable();
    }

    const format::FileHeader& header() const { return header_; }
    const std::string& place() const { return place_; }
    bool isFrugal() const { return isFrugal_; }

    // An array used in place; empty if the chunk is absent and not critical.
    template <typename T>
    std::span<const T> mapped(const format::ChunkId& id, bool required) const
    {
        const format::ChunkEntry* entry = find<T>(id, required);
        if (entry == nullptr)
            return {};
        if ((entry->flags & format::compressed) != 0)
            fail(ErrorKind::unsupported,
                 "{}: chunk {} is compressed, which this version does not map", place_, nameOf(id));
        return {reinterpret_cast<const T*>(bytes_.data() + entry->offset),
                static_cast<std::size_t>(entry->elementCount)};
    }

    // A copy of an array, decompressed if needed.
    template <typename T, typename Array = std::vector<T>>
    Array copied(const format::ChunkId& id, bool required) const
    {
        const format::ChunkEntry* entry = find<T>(id, required);
        if (entry == nullptr)
            return {};
        const Bytes stored = bytes_.subspan(entry->offset, entry->storedBytes);
        if (entry->elementCount == 0)
            return {};
        const bool isCompressed = (entry->flags & format::compressed) != 0;
        const std::string name = fmt::format("{}: chunk {}", place_, nameOf(id));
        if (isCompressed)
            checkClaim(stored, entry->rawBytes, name);
        Array result(entry->elementCount);
        if (isCompressed) {
            decompress(stored, sizeof(T), std::as_writable_bytes(std::span(result)), name);
        } else {
            std::memcpy(result.data(), stored.data(), stored.size());
        }
        return result;
    }

    std::string text(const format::ChunkId& id, bool required) const
    {
        const std::vector<char> chars = copied<char>(id, required);
        return {chars.begin(), chars.end()};
    }

    static std::string nameOf(const format::ChunkId& id)
    {
        std::string name;
        for (const char c : id)
            name += c >= ' ' && c < '\x7f' ? c : '?';
        return name.substr(0, name.find_last_not_of(' ') + 1);
    }

private:
    void readHeader();
    void readTable();
    void checkEntry(const format::ChunkEntry& entry, std::uint64_t& at) const;
    void checkPadding(std::uint64_t from, std::uint64_t to) const;

    template <typename T>
    const format::ChunkEntry* find(const format::ChunkId& id, bool required) const
    {
        for (const format::ChunkEntry& entry : table_) {
            if (entry.id != id)
                continue;
            if (entry.elementBytes != sizeof(T))
                fail(ErrorKind::input, "{}: elements of chunk {} have {} bytes instead of {}",
                     place_, nameOf(id), entry.elementBytes, sizeof(T));
            return &entry;
        }
        if (required)
            fail(ErrorKind::input, "{}: chunk {} is missing", place_, nameOf(id));
        return nullptr;
    }

    Bytes bytes_;
    std::string place_;
    bool isFrugal_;
    format::FileHeader header_ = {};
    std::vector<format::ChunkEntry> table_;
};

void Reader::readHeader()
{
    if (bytes_.size() < sizeof header_)
        fail(ErrorKind::input, "{}: {} bytes, too short for the header of a field ({})", place_,
             bytes_.size(), sizeof header_);
    std::memcpy(&header_, bytes_.data(), sizeof header_);
    if (header_.magic != format::magic)
        fail(ErrorKind::input, "{}: not a field file (it does not begin with \"SWARD\")", place_);
    if (header_.endianMark != format::endianMark)
        fail(ErrorKind::input, "{}: the byte order mark is {:#010x} instead of {:#010x}", place_,
             header_.endianMark, format::endianMark);
    if (header_.majorVersion > format::majorVersion)
        fail(ErrorKind::unsupported,
             "{}: field format version {}.{}; this program reads up to version {}.{}", place_,
             header_.majorVersion, header_.minorVersion, format::majorVersion,
             format::minorVersion);
    if (header_.majorVersion == 0)
        fail(ErrorKind::input, "{}: field format version 0 does not exist", place_);
    if (header_.fileBytes != bytes_.size())
        fail(ErrorKind::input, "{}: {} bytes instead of {}: {}", place_, bytes_.size(),
             header_.fileBytes,
             bytes_.size() < header_.fileBytes ? "truncated" : "bytes follow its end");
    if (header_.chunkCount > format::maxChunks)
        fail(ErrorKind::input, "{}: {} chunks, more than {}", place_, header_.chunkCount,
             format::maxChunks);
}

void Reader::readTable()
{
    const std::uint64_t tableBytes = header_.chunkCount * sizeof(format::ChunkEntry);
    if (header_.chunkCount == 0)
        fail(ErrorKind::input, "{}: no chunks", place_);
    if (sizeof header_ + tableBytes > bytes_.size())
        fail(ErrorKind::input, "{}: the table of {} chunks does not fit into {} bytes", place_,
             header_.chunkCount, bytes_.size());
    table_.resize(header_.chunkCount);
    std::memcpy(table_.data(), bytes_.data() + sizeof header_, tableBytes);

    // Header and table are hashed together.
    std::vector<std::byte> hashed(
        bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(sizeof header_ + tableBytes));
    format::FileHeader cleared = header_;
    cleared.tableHash = 0;
    std::memcpy(hashed.data(), &cleared, sizeof cleared);
    if (XXH3_64bits(hashed.data(), hashed.size()) != header_.tableHash)
        fail(ErrorKind::input, "{}: header or chunk table is damaged (hash differs)", place_);

    std::uint64_t at = sizeof header_ + tableBytes;
    for (const format::ChunkEntry& entry : table_)
        checkEntry(entry, at);
    checkPadding(at, bytes_.size());
}

void Reader::checkEntry(const format::ChunkEntry& entry, std::uint64_t& at) const
{
    const std::string name = nameOf(entry.id);
    // Chunks lie in the order of the table, with less than one alignment between them.
    if (entry.offset % format::alignment != 0 || entry.offset < at ||
        entry.offset - at >= format::alignment || entry.offset > bytes_.size() ||
        entry.storedBytes > bytes_.size() - entry.offset)
        fail(ErrorKind::input, "{}: chunk {} at {} with {} bytes does not fit", place_, name,
             entry.offset, entry.storedBytes);
    if ((entry.flags & ~format::knownFlags) != 0)
        fail(ErrorKind::unsupported, "{}: chunk {} has unknown flags {:#x}", place_, name,
             entry.flags);
    const bool isCompressed = (entry.flags & format::compressed) != 0;
    if (entry.elementBytes == 0 ||
        entry.elementCount > std::numeric_limits<std::uint64_t>::max() / entry.elementBytes ||
        entry.elementCount * entry.elementBytes != entry.rawBytes ||
        (!isCompressed && entry.rawBytes != entry.storedBytes))
        fail(ErrorKind::input, "{}: chunk {} has {} elements of {} bytes in {} bytes", place_, name,
             entry.elementCount, entry.elementBytes, entry.rawBytes);
    checkPadding(at, entry.offset);
    if (hashOf(bytes_.subspan(entry.offset, entry.storedBytes), isFrugal_) != entry.hash)
        fail(ErrorKind::input, "{}: chunk {} is damaged (hash differs)", place_, name);
    static constexpr format::ChunkId known[] = {
        format::patches,      format::blades,          format::keys,
        format::species,      format::groundVertices,  format::groundIndices,
        format::groundRanges, format::groundMaterials, format::groundImages,
        format::defaults,     format::cover,           format::seeds,
        format::seedCells,    format::seedData,        format::provenance};
    if ((entry.flags & format::critical) != 0 &&
        std::find(std::begin(known), std::end(known), entry.id) == std::end(known))
        fail(ErrorKind::unsupported, "{}: needs chunk {}, which this version does not know", place_,
             name);
    at = entry.offset + entry.storedBytes;
}

void Reader::checkPadding(std::uint64_t from, std::uint64_t to) const
{
    for (std::uint64_t i = from; i < to; ++i)
        if (bytes_[i] != std::byte{0})
            fail(ErrorKind::input, "{}: byte {} between chunks is not zero", place_, i);
}

} // namespace

MappedField::MappedField(std::unique_ptr<Contents> contents)
    : contents_(std::move(contents))
{
}
MappedField::MappedField(MappedField&&) noexcept = default;
MappedField& MappedField::operator=(MappedField&&) noexcept = default;
MappedField::~MappedField() = default;

FieldView MappedField::view() const&
{
    requireUsage(contents_ != nullptr, "MappedField::view(): the field has been moved away");
    return contents_->view;
}

std::uint64_t MappedField::fileBytes() const
{
    return contents_->bytes.size();
}

void MappedField::leaveOnDisk() const noexcept
{
    if (contents_ != nullptr && contents_->file)
        sward::leaveOnDisk(contents_->file->bytes());
}

void MappedField::Contents::read(const std::string& name, const ReadOptions& options)
{
    const Reader reader(bytes, name, options.isFrugal && file.has_value());
    const std::string& place = reader.place();

    // Keys take as long as all the rest.
    std::future<UninitializedVector<BladeKey>> readKeys;
    if (options.withKeys)
        readKeys = std::async(std::launch::async, [&] {
            return reader.copied<BladeKey, UninitializedVector<BladeKey>>(format::keys, false);
        });
    species = parseSpecies(reader.text(format::species, true), fmt::format("{}: species", place));
    defaults = parseDefaults(reader.text(format::defaults, true),
                             fmt::format("{}: defaults", place), copyright);
    view.thinned = parseCover(reader.text(format::cover, false), fmt::format("{}: cover", place));
    if (const std::string text = reader.text(format::seeds, false); !text.empty()) {
        meadow = parseSeedMeadow(text, fmt::format("{}: seeds", place));
        seeds.meadow = &*meadow;
        seeds.cells = reader.mapped<SeedEntry>(format::seedCells, true);
        seeds.data = reader.mapped<std::byte>(format::seedData, true);
        view.seeds = &seeds;
    }
    provenance = reader.text(format::provenance, false);
    if (provenance.empty())
        provenance = "{}";
    parseJson(provenance, fmt::format("{}: provenance", place));

    ground.vertices = reader.copied<shared::GroundVertex>(format::groundVertices, false);
    ground.indices = reader.copied<std::uint32_t>(format::groundIndices, false);
    ground.ranges = reader.copied<GroundRange>(format::groundRanges, false);
    ground.materials = reader.copied<shared::GroundMaterial>(format::groundMaterials, false);
    const std::vector<std::byte> images = reader.copied<std::byte>(format::groundImages, false);
    ground.images = parseImages(images, fmt::format("{}: ground images", place));

    const auto& origin = reader.header().origin;
    view.origin = glm::dvec3(origin[0], origin[1], origin[2]);
    view.patches = reader.mapped<shared::Patch>(format::patches, true);
    view.blades = reader.mapped<shared::PackedBlade>(format::blades, true);
    view.species = species;
    view.ground = &ground;
    view.defaults = &defaults;
    view.provenance = &provenance;
    view.copyright = &copyright;
    verifyWithoutBlades(view, view.blades.size(), place);
    BladeVerifier verifier(view, place);
    if (reader.isFrugal())
        seeByPieces(view.blades, [&](auto piece) { verifier.add(piece); });
    else
        verifier.add(view.blades);
    if (options.withKeys)
        keys = readKeys.get();
    view.keys = keys;
    verifyKeys(view, place);
}

MappedField readField(const std::filesystem::path& path, const ReadOptions& options)
{
    auto contents = std::make_unique<MappedField::Contents>();
    contents->bytes = contents->file.emplace(path).bytes();
    contents->read(path.string(), options);
    return MappedField(std::move(contents));
}

MappedField readField(std::span<const std::byte> bytes, const std::string& name)
{
    requireUsage(reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(shared::Patch) == 0,
                 "{}: the bytes of a field start at a multiple of {}", name,
                 alignof(shared::Patch));
    auto contents = std::make_unique<MappedField::Contents>();
    contents->bytes = bytes;
    contents->read(name, {});
    return MappedField(std::move(contents));
}

MappedField readField(std::vector<std::byte>&& bytes, const std::string& name)
{
    auto contents = std::make_unique<MappedField::Contents>();
    contents->owned = std::move(bytes);
    contents->bytes = contents->owned;
    contents->read(name, {});
    return MappedField(std::move(contents));
}

} // namespace sward::field
