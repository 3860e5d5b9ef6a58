#include "terrain/files/record_file.h"

#include "core/error.h"
#include "core/expect.h"

#include <xxhash.h>

#include <cstring>
#include <string>

namespace sward::terrain {
namespace {

constexpr std::size_t kindBytes = 8;

struct ArrayHeader {
    std::uint64_t count;
    std::uint64_t elementBytes;
};

} // namespace

struct RecordWriter::Hash {
    XXH3_state_t* state = XXH3_createState();

    Hash() { expect(XXH3_64bits_reset(state) == XXH_OK, "XXH3 starts"); }
    Hash(const Hash&) = delete;
    Hash& operator=(const Hash&) = delete;
    ~Hash() { XXH3_freeState(state); }
};

RecordWriter::RecordWriter(const std::filesystem::path& path, std::string_view kind, bool overwrite)
    : file_(path, overwrite)
    , hash_(std::make_unique<Hash>())
{
    expect(kind.size() == kindBytes, "a kind has eight letters");
    const auto bytes = std::as_bytes(std::span(kind));
    file_.write(bytes);
    XXH3_64bits_update(hash_->state, bytes.data(), bytes.size());
}

RecordWriter::~RecordWriter() = default;

void RecordWriter::addBytes(std::span<const std::byte> bytes, std::size_t elementBytes)
{
    begin(bytes.size() / elementBytes, elementBytes);
    addPart(bytes);
}

void RecordWriter::begin(std::uint64_t count, std::uint64_t elementBytes)
{
    const ArrayHeader header{count, elementBytes};
    addPart(std::as_bytes(std::span(&header, 1)));
}

void RecordWriter::addPart(std::span<const std::byte> bytes)
{
    if (bytes.empty())
        return;
    file_.write(bytes);
    XXH3_64bits_update(hash_->state, bytes.data(), bytes.size());
}

void RecordWriter::commit()
{
    const std::uint64_t digest = XXH3_64bits_digest(hash_->state);
    file_.write(std::as_bytes(std::span(&digest, 1)));
    file_.flush();
    file_.commit();
}

RecordReader::RecordReader(const std::filesystem::path& path, std::string_view kind)
    : name_(path.string())
    , file_(path)
{
    const std::span<const std::byte> bytes = file_.bytes();
    std::uint64_t digest = 0;
    if (bytes.size() < kindBytes + sizeof digest)
        fail(ErrorKind::input, "{}: truncated: {} bytes", name_, bytes.size());
    if (std::memcmp(bytes.data(), kind.data(), kindBytes) != 0)
        fail(ErrorKind::input, "{}: does not begin with \"{}\"", name_, kind);
    end_ = bytes.size() - sizeof digest;
    std::memcpy(&digest, bytes.data() + end_, sizeof digest);
    if (XXH3_64bits(bytes.data(), end_) != digest)
        fail(ErrorKind::input, "{}: damaged: its {} bytes do not match the hash at its end", name_,
             bytes.size());
    at_ = kindBytes;
}

std::span<const std::byte> RecordReader::next(std::size_t elementBytes)
{
    ArrayHeader header = {};
    if (end_ - at_ < sizeof header)
        fail(ErrorKind::input, "{}: ends at byte {}, before its last array", name_, end_);
    std::memcpy(&header, file_.bytes().data() + at_, sizeof header);
    at_ += sizeof header;
    if (header.elementBytes != elementBytes || header.count > (end_ - at_) / elementBytes)
        fail(ErrorKind::input,
             "{}: at byte {}, {} elements of {} bytes where {} bytes each are expected", name_, at_,
             header.count, header.elementBytes, elementBytes);
    const std::span<const std::byte> bytes =
        file_.bytes().subspan(at_, header.count * elementBytes);
    at_ += bytes.size();
    return bytes;
}

void RecordReader::read(std::string& text)
{
    const std::span<const std::byte> bytes = next(1);
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

RecordReader::ArrayPlace RecordReader::skip(std::size_t elementBytes)
{
    const std::span<const std::byte> bytes = next(elementBytes);
    return {at_ - bytes.size(), bytes.size() / elementBytes};
}

void RecordReader::requireOne(std::size_t count) const
{
    if (count != 1)
        fail(ErrorKind::input, "{}: {} values where one is expected", name_, count);
}

void RecordReader::copy(std::span<const std::byte> from, void* to)
{
    if (!from.empty())
        std::memcpy(to, from.data(), from.size());
}

} // namespace sward::terrain
