#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/random.h"
#include "field/file/format.h"
#include "field/read.h"
#include "field/write.h"
#include "unit/field/sample_field.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <fstream>

namespace sward::field {
namespace {

std::vector<std::byte> sampleBytes()
{
    const auto path = tests::temporaryFile("whole.sward");
    writeField(tests::sampleField(), path, true);
    return readFile(path);
}

void writeBytes(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
}

// Reads a damaged file: it must be refused by an Error that names it.
void expectRefused(const std::filesystem::path& path, const std::string& what)
{
    try {
        readField(path);
        FAIL() << what << " was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos)
            << what;
        EXPECT_TRUE(error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported)
            << what;
    }
}

TEST(DamagedField, EveryTruncationIsACleanError)
{
    const std::vector<std::byte> bytes = sampleBytes();
    const auto path = tests::temporaryFile("truncated.sward");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        writeBytes(path, std::span(bytes).first(length));
        expectRefused(path, "length " + std::to_string(length));
    }
}

TEST(DamagedField, EveryFlippedByteIsACleanError)
{
    const std::vector<std::byte> bytes = sampleBytes();
    const auto path = tests::temporaryFile("flipped.sward");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::vector<std::byte> damaged = bytes;
        damaged[at] ^= std::byte(1 + hashBits(3, at) % 255);
        writeBytes(path, damaged);
        expectRefused(path, "byte " + std::to_string(at));
    }
}

TEST(DamagedField, SomethingBehindTheEndIsACleanError)
{
    std::vector<std::byte> bytes = sampleBytes();
    bytes.resize(bytes.size() + 64);
    const auto path = tests::temporaryFile("longer.sward");
    writeBytes(path, bytes);
    expectRefused(path, "64 more bytes");
}

// Replaces bytes and repairs all hashes, as a malicious author would.
std::vector<std::byte> forge(std::vector<std::byte> bytes, std::size_t at, std::byte value)
{
    bytes[at] = value;
    format::FileHeader header = {};
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::size_t tableBytes = header.chunkCount * sizeof(format::ChunkEntry);
    if (sizeof header + tableBytes > bytes.size())
        return bytes;
    for (std::uint32_t i = 0; i < header.chunkCount; ++i) {
        const std::size_t place = sizeof header + i * sizeof(format::ChunkEntry);
        format::ChunkEntry entry = {};
        std::memcpy(&entry, bytes.data() + place, sizeof entry);
        if (entry.offset <= bytes.size() && entry.storedBytes <= bytes.size() - entry.offset)
            entry.hash = XXH3_64bits(bytes.data() + entry.offset, entry.storedBytes);
        std::memcpy(bytes.data() + place, &entry, sizeof entry);
    }
    header.tableHash = 0;
    std::memcpy(bytes.data(), &header, sizeof header);
    header.tableHash = XXH3_64bits(bytes.data(), sizeof header + tableBytes);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

TEST(ForgedField, NeverCrashesTheReader)
{
    // With correct hashes, the content itself is validated. Some bytes may change freely (a
    // colour). Changes that make indices, counts or numbers invalid must be refused. Nothing may
    // crash.
    const std::vector<std::byte> bytes = sampleBytes();
    const auto path = tests::temporaryFile("forged.sward");
    int refused = 0;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        static constexpr std::byte values[] = {std::byte(0x00), std::byte(0x7f), std::byte(0xff)};
        writeBytes(path, forge(bytes, at, values[at % 3]));
        try {
            const MappedField field = readField(path);
            // A returned view can be traversed without leaving it.
            for (const shared::Patch& patch : field.view().patches)
                ASSERT_LE(std::uint64_t(patch.firstBlade) + patch.bladeCount,
                          field.view().blades.size());
            ASSERT_EQ(patchOfBlades(field.view()).size(), field.view().blades.size());
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 500);
}

TEST(FieldVersion, NewerThanThisIsUnsupportedAndNamesBoth)
{
    std::vector<std::byte> bytes = sampleBytes();
    bytes[offsetof(format::FileHeader, majorVersion)] = std::byte(2);
    const auto path = tests::temporaryFile("newer.sward");
    writeBytes(path, bytes);
    try {
        readField(path);
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        const std::string text = error.what();
        EXPECT_NE(text.find("version 2."), std::string::npos) << text;
        const std::string newest = "version " + std::to_string(format::majorVersion) + "." +
                                   std::to_string(format::minorVersion);
        EXPECT_NE(text.find(newest), std::string::npos) << text;
    }
}

} // namespace
} // namespace sward::field
