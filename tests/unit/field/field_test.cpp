#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/field.h"
#include "field/file/compression.h"
#include "field/inspect.h"
#include "field/read.h"
#include "field/write.h"
#include "unit/field/sample_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sward::field {
namespace {

template <typename T>
bool sameBytes(std::span<const T> a, std::span<const T> b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

TEST(FieldFile, ReadsBackWhatWasWritten)
{
    const Field field = tests::sampleField();
    const auto path = tests::temporaryFile("identity.sward");
    const std::uint64_t bytes = writeField(field, path, true);
    EXPECT_EQ(bytes, std::filesystem::file_size(path));
    EXPECT_EQ(bytes, fieldBytes(field));

    const MappedField mapped = readField(path);
    const FieldView view = mapped.view();
    EXPECT_EQ(mapped.fileBytes(), bytes);
    EXPECT_EQ(view.origin, field.origin);
    EXPECT_TRUE(sameBytes(view.patches, std::span<const shared::Patch>(field.patches)));
    EXPECT_TRUE(sameBytes(view.blades, std::span<const shared::PackedBlade>(field.blades)));
    EXPECT_TRUE(sameBytes(view.keys, std::span<const BladeKey>(field.keys)));
    EXPECT_EQ(view.species.size(), 2U);
    EXPECT_EQ(view.species[1].name, "clover");
    EXPECT_FLOAT_EQ(view.species[0].look.tipColor.x, 0.3f);
    EXPECT_EQ(view.ground->indices, field.ground.indices);
    EXPECT_EQ(view.ground->images[0].rgba, field.ground.images[0].rgba);
    EXPECT_EQ(view.defaults->cameras[0].eye, field.defaults.cameras[0].eye);
    EXPECT_EQ(*view.provenance, field.provenance);
    EXPECT_EQ(*view.copyright, "CC0");
}

// Hands over a field in pieces of at most `size` blades.
class CutPieces : public BladePieces {
public:
    CutPieces(const Field& field, std::size_t size)
        : field_(field)
        , size_(size)
    {
    }

    std::uint64_t count() const override { return field_.blades.size(); }
    void eachBlade(const TakeBlades& take) const override
    {
        for (std::size_t at = 0; at < field_.blades.size(); at += size_)
            take(std::span(field_.blades).subspan(at, std::min(size_, field_.blades.size() - at)));
    }
    void eachKeyByte(std::size_t byte, const TakeBytes& take) const override
    {
        const std::span<const std::byte> keys = std::as_bytes(std::span(field_.keys));
        for (std::size_t at = 0; at < field_.keys.size(); at += size_) {
            std::vector<std::byte> bytes;
            for (std::size_t i = at; i < std::min(at + size_, field_.keys.size()); ++i)
                bytes.push_back(keys[i * sizeof(BladeKey) + byte]);
            take(bytes);
        }
    }

private:
    const Field& field_;
    std::size_t size_;
};

TEST(FieldFile, HasTheSameBytesHoweverItsBladesAreCut)
{
    Field field = tests::sampleField(shared::maxPatchBlades);
    const std::size_t one = field.blades.size();
    for (std::size_t i = 0; i < field.keys.size(); ++i)
        field.keys[i] = {static_cast<std::uint32_t>(i * i / 7),
                         static_cast<std::uint32_t>(i % 13 * (i % 5))};
    const auto path = tests::temporaryFile("cut.sward");
    writeField(field, path, true);
    const auto contents = [&] {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string whole = contents();
    for (const std::size_t size : {std::size_t(1), std::size_t(7), one}) {
        writeField(field, CutPieces(field, size), path, true);
        EXPECT_TRUE(contents() == whole) << size;
    }
}

TEST(Compression, DependsOnTheBytesAloneAndNotOnHowTheyAreCut)
{
    // Several of zstd's blocks, neither constant nor random.
    std::vector<std::byte> raw(1'000'000);
    for (std::size_t i = 0; i < raw.size(); ++i)
        raw[i] = static_cast<std::byte>(i * i / 70'001 % 251 * (i % 5));
    const UninitializedVector<std::byte> whole = compress(raw, 1);
    EXPECT_LT(whole.size(), raw.size());
    for (const std::size_t size : {1U, 1000U, 65'537U, 131'072U, 1'000'000U}) {
        UninitializedVector<std::byte> cut;
        Compressor compressor(raw.size(), [&](std::span<const std::byte> piece) {
            cut.insert(cut.end(), piece.begin(), piece.end());
        });
        for (std::size_t at = 0; at < raw.size(); at += size)
            compressor.add(
                std::span(raw).subspan(at, std::min<std::size_t>(size, raw.size() - at)));
        compressor.finish();
        EXPECT_TRUE(cut == whole) << size;
    }
}

TEST(FieldFile, IsOfTheFirstVersionUnlessABudgetThinnedIt)
{
    Field field = tests::sampleField();
    const auto path = tests::temporaryFile("thinned.sward");
    for (const double thinned : {1.0, 3.5}) {
        field.thinned = thinned;
        writeField(field, path, true);
        const MappedField read = readField(path);
        EXPECT_EQ(read.view().thinned, thinned);
        std::ifstream file(path, std::ios::binary);
        std::array<char, 12> head = {};
        file.read(head.data(), head.size());
        EXPECT_EQ(head[8], 1);
        EXPECT_EQ(head[10], thinned > 1.0 ? 1 : 0);
        EXPECT_EQ(head[11], 0);
    }
    for (const double impossible : {0.5, -1.0, std::numeric_limits<double>::infinity()}) {
        field.thinned = impossible;
        EXPECT_THROW(writeField(field, path, true), Error) << impossible;
    }
}

TEST(FieldFile, LaysBladesWhereTheGpuCanTakeThem)
{
    const auto path = tests::temporaryFile("aligned.sward");
    writeField(tests::sampleField(), path, true);
    const MappedField mapped = readField(path);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.view().blades.data()) % 64, 0U);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.view().patches.data()) % 64, 0U);
}

TEST(FieldFile, IsReadFromMemoryAsFromItsFile)
{
    const auto path = tests::temporaryFile("memory.sward");
    writeField(tests::sampleField(), path, true);
    std::vector<std::byte> bytes = readFile(path);
    const MappedField mapped = readField(path);
    const MappedField held = readField(bytes, "archive/lawn");
    EXPECT_EQ(held.fileBytes(), bytes.size());
    EXPECT_TRUE(sameBytes(held.view().blades, mapped.view().blades));
    EXPECT_TRUE(sameBytes(held.view().patches, mapped.view().patches));
    EXPECT_GE(static_cast<const void*>(held.view().blades.data()), bytes.data());
    EXPECT_LT(static_cast<const void*>(held.view().blades.data()), bytes.data() + bytes.size());

    std::vector<std::byte> damaged = bytes;
    const MappedField owner = readField(std::move(bytes), "archive/lawn");
    EXPECT_EQ(owner.fileBytes(), damaged.size());
    EXPECT_TRUE(sameBytes(owner.view().blades, mapped.view().blades));
    damaged[damaged.size() / 2] ^= std::byte{1};
    try {
        readField(damaged, "archive/lawn");
        FAIL() << "damage was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("archive/lawn"), std::string::npos);
    }
}

TEST(FieldFile, WithoutBladesIsValid)
{
    Field field = tests::sampleField();
    field.patches.clear();
    field.blades.clear();
    field.keys.clear();
    const auto path = tests::temporaryFile("empty.sward");
    writeField(field, path, true);
    const MappedField read = readField(path);
    EXPECT_TRUE(read.view().blades.empty());
    EXPECT_FALSE(read.view().bounds().isEmpty());
}

TEST(FieldFile, IsNotReplacedWithoutPermission)
{
    const auto path = tests::temporaryFile("kept.sward");
    writeField(tests::sampleField(), path, true);
    EXPECT_THROW(writeField(tests::sampleField(7), path, false), Error);
    MappedField kept = readField(path);
    EXPECT_EQ(kept.view().blades.size(), 15U);
    const MappedField moved = std::move(kept);
    EXPECT_EQ(moved.view().blades.size(), 15U);
    EXPECT_THROW(kept.view(), Error); // NOLINT(bugprone-use-after-move): that is what is tested
}

TEST(FieldFile, ThatWouldNotReadBackIsNotWritten)
{
    Field field = tests::sampleField();
    field.patches[1].boundsLow.x = std::numeric_limits<float>::quiet_NaN();
    const auto path = tests::temporaryFile("refused.sward");
    EXPECT_THROW(writeField(field, path, true), Error);
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Compression, RestoresBytesAndRefusesOtherSizes)
{
    // More than one block of regrouped bytes.
    std::vector<std::byte> raw(600'000);
    for (std::size_t i = 0; i < raw.size(); ++i)
        raw[i] = std::byte(i * i % 251);
    for (const std::size_t elementBytes : {std::size_t(1), std::size_t(8), std::size_t(32)}) {
        const auto stored = compress(raw, elementBytes);
        std::vector<std::byte> restored(raw.size());
        decompress(stored, elementBytes, restored, "x");
        EXPECT_EQ(restored, raw);
    }
    const auto stored = compress(raw, 8);
    const std::span<const std::byte> whole(stored);
    std::vector<std::byte> longer(raw.size() + 8);
    EXPECT_THROW(decompress(whole, 8, longer, "x"), Error);
    EXPECT_THROW(decompress(whole.first(whole.size() / 2), 8, raw, "x"), Error);
    EXPECT_THROW(checkClaim(whole, raw.size() - 1, "x"), Error);
    auto followed = stored;
    followed.push_back(std::byte{0});
    EXPECT_THROW(decompress(followed, 8, raw, "x"), Error);
}

// A zstd frame that claims `size` bytes and holds `blocks` blocks of 128 KB that are all zero.
std::vector<std::byte> claimingFrame(std::uint64_t size, int blocks)
{
    // Magic number, a descriptor of 8 bytes of size, a window of 128 KB.
    std::vector<std::byte> frame;
    for (const unsigned byte : {0x28U, 0xb5U, 0x2fU, 0xfdU, 0xc0U, 0x38U})
        frame.push_back(std::byte(byte));
    for (int i = 0; i < 8; ++i)
        frame.push_back(std::byte(size >> (8 * i) & 0xffU));
    for (int i = 0; i < blocks; ++i) {
        // Whether it is the last, a repeated byte, its count.
        const unsigned header = (i + 1 == blocks ? 1U : 0U) | 1U << 1 | (1U << 17) << 3;
        for (int k = 0; k < 3; ++k)
            frame.push_back(std::byte(header >> (8 * k) & 0xffU));
        frame.push_back(std::byte(0));
    }
    return frame;
}

TEST(Compression, BelievesASizeOnlyAsFarAsDataFollow)
{
    constexpr std::uint64_t block = std::uint64_t(1) << 17;
    EXPECT_NO_THROW(checkClaim(claimingFrame(16 * block, 16), 16 * block, "x"));
    std::vector<std::byte> raw(16 * block, std::byte(1));
    decompress(claimingFrame(16 * block, 16), 8, raw, "x");
    EXPECT_EQ(raw, std::vector<std::byte>(16 * block));
    // Less than it claims, by one byte or by much, and more than any frame may hold.
    EXPECT_THROW(checkClaim(claimingFrame(16 * block + 1, 16), 16 * block + 1, "x"), Error);
    EXPECT_THROW(checkClaim(claimingFrame(16 * block - 1, 16), 16 * block - 1, "x"), Error);
    EXPECT_THROW(checkClaim(claimingFrame(200'000'000, 1), 200'000'000, "x"), Error);
    EXPECT_THROW(checkClaim(claimingFrame(std::uint64_t(1) << 50, 1), std::size_t(1) << 50, "x"),
                 Error);
}

TEST(Summary, CountsWhatTheFieldHolds)
{
    const Field field = tests::sampleField();
    const Summary summary = summarise(viewOf(field));
    EXPECT_EQ(summary.blades, 15U);
    EXPECT_EQ(summary.patches, 3U);
    EXPECT_EQ(summary.leaves, 2U);
    EXPECT_EQ(summary.levels, 2);
    EXPECT_EQ(summary.bladesPerLeaf, 5.0);
    EXPECT_EQ(summary.groundTriangles, 2U);
    EXPECT_EQ(summary.perSpecies[0] + summary.perSpecies[1], 15U);
    EXPECT_GE(summary.heightLow, 0.2 - 1e-6);
    EXPECT_LE(summary.heightHigh, 0.6 + 1e-6);
}

TEST(BladeId, FitsIntoADoubleAndDiffersForNeighbours)
{
    std::vector<std::uint64_t> ids;
    for (std::uint32_t triangle = 0; triangle < 300; ++triangle)
        for (std::uint32_t candidate = 0; candidate < 300; ++candidate) {
            ids.push_back(bladeId({triangle, candidate}));
            ASSERT_LT(ids.back(), 1ULL << 53);
        }
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

} // namespace
} // namespace sward::field
