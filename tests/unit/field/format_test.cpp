#include "core/files/mapped_file.h"
#include "field/file/format.h"
#include "field/write.h"
#include "shaders/shared/blade.h"
#include "unit/field/sample_field.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>

namespace sward::field {
namespace {

// The layout that docs/field_format.md states; a change needs a new version.
TEST(FieldFormat, HasTheDocumentedOffsets)
{
    EXPECT_EQ(offsetof(format::FileHeader, majorVersion), 8U);
    EXPECT_EQ(offsetof(format::FileHeader, minorVersion), 10U);
    EXPECT_EQ(offsetof(format::FileHeader, endianMark), 12U);
    EXPECT_EQ(offsetof(format::FileHeader, fileBytes), 16U);
    EXPECT_EQ(offsetof(format::FileHeader, chunkCount), 24U);
    EXPECT_EQ(offsetof(format::FileHeader, origin), 32U);
    EXPECT_EQ(offsetof(format::FileHeader, tableHash), 56U);
    EXPECT_EQ(offsetof(format::ChunkEntry, offset), 8U);
    EXPECT_EQ(offsetof(format::ChunkEntry, hash), 32U);
    EXPECT_EQ(offsetof(format::ChunkEntry, flags), 40U);
    EXPECT_EQ(offsetof(format::ChunkEntry, elementCount), 48U);
    EXPECT_EQ(offsetof(shared::Patch, firstBlade), 12U);
    EXPECT_EQ(offsetof(shared::Patch, rootLow), 32U);
    EXPECT_EQ(offsetof(shared::Patch, rootStep), 44U);
    EXPECT_EQ(offsetof(shared::Patch, heightLow), 64U);
    EXPECT_EQ(offsetof(shared::Patch, parent), 80U);
    EXPECT_EQ(offsetof(shared::Patch, rankLow), 96U);
}

TEST(FieldFormat, VersionOneBeginsWithTheseBytes)
{
    const auto path = tests::temporaryFile("literal.sward");
    writeField(tests::sampleField(), path, true);
    const std::vector<std::byte> bytes = readFile(path);
    const unsigned char expected[] = {'S', 'W', 'A', 'R', 'D', '\r', '\n', 0x1a,
                                      1,   0,   0,   0,   4,   3,    2,    1};
    ASSERT_GE(bytes.size(), sizeof expected);
    EXPECT_EQ(std::memcmp(bytes.data(), expected, sizeof expected), 0);
}

TEST(FieldFormat, VersionOnePacksThisBladeIntoTheseWords)
{
    shared::Patch patch = {};
    patch.rootLow = glm::vec3(-1, 2, 3);
    patch.rootStep = 1.0f / 1024.0f;
    patch.heightLow = 0.25f;
    patch.heightStep = 1.0f / 512.0f;
    patch.widthLow = 0.0f;
    patch.widthStep = 1.0f / 4096.0f;
    shared::Blade blade = {};
    blade.root = glm::vec3(0.5f, 3.0f, 3.25f); // 1536, 1024, 256 steps
    blade.facing = shared::twoPi / 4.0f;       // 64
    blade.up = glm::vec3(0, 1, 0);             // 127, 254
    blade.stiffness = 21.0f / 63.0f;
    blade.height = 0.5f; // 128
    blade.width = 9.0f / 4096.0f;
    blade.exposure = 1.0f; // 31
    blade.species = 5;
    blade.tint = glm::vec3(1.0f, 0.0f, 16.0f / 31.0f);
    blade.clump = 0xab;
    blade.hash = 0xc;
    const shared::PackedBlade bits = shared::packBlade(blade, patch);
    EXPECT_EQ(bits.rootXY, 0x04000600U);
    EXPECT_EQ(bits.rootZUp, 0xfe7f0100U);
    EXPECT_EQ(bits.shape, 0xc0000000U | 21U << 22 | 9U << 16 | 128U << 8 | 64U);
    EXPECT_EQ(bits.look, 0xab000000U | 5U << 21 | 31U << 16 | 16U << 11 | 31U);
}

} // namespace
} // namespace sward::field
