#include "core/error.h"
#include "core/random.h"
#include "terrain/gltf/codecs/meshopt_filters.h"
#include "unit/terrain/gltf/compressed_glb.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sward::terrain {
namespace {

using testing::HasSubstr;

ErrorKind kindOfMeshopt(const GlbBuilder& builder, std::string* message = nullptr)
{
    try {
        loadContent("a.glb", builder.glb());
    } catch (const Error& error) {
        if (message != nullptr)
            *message = error.what();
        return error.kind();
    }
    return ErrorKind::difference;
}

nlohmann::json& extensionOf(GlbBuilder& builder, std::size_t view)
{
    return builder.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

TEST(GltfMeshopt, DecodesEveryModeToTheVeryBytes)
{
    const std::string plain = contentHash(loadContent("a.glb", plainGrid(20).glb()));
    for (const char* name :
         {"EXT_meshopt_compression", "KHR_meshopt_compression", "MESHOPT_compression"})
        for (const char* mode : {"TRIANGLES", "INDICES"})
            for (const bool shortIndices : {false, true}) {
                const GlbBuilder builder = meshoptGrid(
                    20, {.extension = name, .indexMode = mode, .shortIndices = shortIndices});
                // The codec rotates the corners of triangles, so compare the sequence.
                const GroundMesh mesh = loadContent("a.glb", builder.glb());
                EXPECT_EQ(mesh.triangles.size(), 800U);
                if (std::string(mode) == "INDICES") {
                    EXPECT_EQ(contentHash(mesh), plain) << name << shortIndices;
                }
            }
}

TEST(GltfMeshopt, KeepsEveryTriangle)
{
    const GroundMesh plain = loadContent("a.glb", plainGrid(20).glb());
    const GroundMesh mesh = loadContent("a.glb", meshoptGrid(20).glb());
    ASSERT_EQ(mesh.positions, plain.positions);
    ASSERT_EQ(mesh.triangles.size(), plain.triangles.size());
    for (std::size_t i = 0; i < plain.triangles.size(); ++i) {
        // The codec may begin at another corner.
        glm::uvec3 turned = mesh.triangles[i];
        for (int turn = 0; turn < 3 && turned != plain.triangles[i]; ++turn)
            turned = {turned.y, turned.z, turned.x};
        EXPECT_EQ(turned, plain.triangles[i]) << i;
    }
}

TEST(GltfMeshopt, AppliesFilters)
{
    const GroundMesh plain = loadContent("a.glb", plainGrid(20).glb());
    const GroundMesh mesh =
        loadContent("a.glb", meshoptGrid(20, {.indexMode = "INDICES", .filters = true}).glb());
    ASSERT_EQ(mesh.positions.size(), plain.positions.size());
    for (std::size_t i = 0; i < plain.positions.size(); ++i) {
        EXPECT_LT(glm::distance(mesh.positions[i], plain.positions[i]), 1e-4f);
        EXPECT_LT(glm::distance(mesh.normals[i], plain.normals[i]), 0.02f);
    }
}

// Elements of four numbers of random bits.
template <typename Value>
std::vector<Value> randomElements(std::size_t count, std::uint64_t key, int bits)
{
    std::vector<Value> values;
    const double one = (1 << (bits - 1)) - 1;
    for (std::size_t i = 0; i < 4 * count; ++i)
        values.push_back(static_cast<Value>(std::lround((2.0 * uniform(key, i, 0) - 1.0) * one)));
    return values;
}

template <typename Value>
int largestDifference(const std::vector<Value>& a, const std::vector<Value>& b)
{
    int largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(int(a[i]) - int(b[i])));
    return largest;
}

// Compares our filters with the library's, which may err by one unit in the last place.
TEST(GltfMeshopt, FiltersAsTheLibraryDoes)
{
    constexpr std::size_t count = 4096;
    const auto bytesOf = [](auto& values) {
        return std::as_writable_bytes(std::span(values.data(), values.size()));
    };
    for (const int bits : {8, 6, 4}) {
        auto own = randomElements<std::int8_t>(count, 1, bits);
        for (std::size_t i = 0; i < count; ++i)
            own[4 * i + 2] = static_cast<std::int8_t>((1 << (bits - 1)) - 1);
        auto theirs = own;
        decodeOctahedral(bytesOf(own), 4);
        meshopt_decodeFilterOct(theirs.data(), count, 4);
        EXPECT_LE(largestDifference(own, theirs), 1) << bits;
    }
    for (const int bits : {16, 12, 5}) {
        auto own = randomElements<std::int16_t>(count, 2, bits);
        auto quaternions = randomElements<std::int16_t>(count, 3, bits);
        for (std::size_t i = 0; i < count; ++i) {
            const int one = (1 << (bits - 1)) - 1;
            own[4 * i + 2] = static_cast<std::int16_t>(one);
            quaternions[4 * i + 3] = static_cast<std::int16_t>((one & ~3) | int(i % 4));
        }
        auto theirs = own;
        decodeOctahedral(bytesOf(own), 8);
        meshopt_decodeFilterOct(theirs.data(), count, 8);
        EXPECT_LE(largestDifference(own, theirs), 1) << bits;
        theirs = quaternions;
        decodeQuaternions(bytesOf(quaternions));
        meshopt_decodeFilterQuat(theirs.data(), count, 8);
        // Where the three given components are too long for a unit quaternion, both are free.
        for (std::size_t i = 0; i < count; ++i) {
            double squares = 0.0;
            for (std::size_t c = 0; c < 4; ++c)
                squares += std::pow(quaternions[4 * i + c] / 32767.0, 2);
            if (squares > 1.001)
                continue;
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_LE(std::abs(quaternions[4 * i + c] - theirs[4 * i + c]), 1);
        }
    }
    std::vector<std::int32_t> own;
    for (int i = 0; i < 4096; ++i)
        own.push_back(
            static_cast<std::int32_t>((static_cast<std::uint32_t>(i % 200 - 100) << 24) |
                                      (static_cast<std::uint32_t>(i * 4099) & 0xffffffU)));
    auto theirs = own;
    decodeExponential(bytesOf(own));
    meshopt_decodeFilterExp(theirs.data(), theirs.size(), 4);
    EXPECT_EQ(own, theirs);
}

TEST(GltfMeshopt, FiltersWhatIsUnspecifiedToSomethingThatFits)
{
    std::vector<std::int16_t> all;
    for (const int a : {-32768, -1, 0, 3, 32767})
        for (const int b : {-32768, 0, 32767})
            for (const int c : {-32768, -4, 0, 1, 32767})
                for (const int value : {a, b, c, c})
                    all.push_back(static_cast<std::int16_t>(value));
    auto octahedral = all;
    decodeOctahedral(std::as_writable_bytes(std::span(octahedral)), 8);
    auto quaternions = all;
    decodeQuaternions(std::as_writable_bytes(std::span(quaternions)));
    EXPECT_EQ(quaternions.size(), octahedral.size());
}

TEST(GltfMeshopt, TurnsInstancesByFilteredQuaternions)
{
    // A quarter turn about y, and none.
    const float half = std::sqrt(0.5f);
    const std::vector<float> turns = {0, half, 0, half, 0, 0, 0, 1};
    std::vector<std::int16_t> filtered(8);
    meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
    std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(2, 8));
    stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), filtered.data(), 2, 8));

    GlbBuilder builder = triangleGlb();
    builder.view(stream.data(), stream.size());
    nlohmann::json& view = builder.document["bufferViews"].back();
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", view["byteOffset"]},
                                                     {"byteLength", stream.size()},
                                                     {"byteStride", 8},
                                                     {"count", 2},
                                                     {"mode", "ATTRIBUTES"},
                                                     {"filter", "QUATERNION"}};
    view["byteLength"] = 16;
    builder.document["accessors"].push_back({{"bufferView", 3},
                                             {"componentType", 5122},
                                             {"type", "VEC4"},
                                             {"count", 2},
                                             {"normalized", true}});
    builder
        .document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
        3;
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    ASSERT_EQ(mesh.positions.size(), 6U);
    EXPECT_LT(glm::length(worldPosition(mesh, 1) - glm::dvec3(0, 0, -1)), 1e-3);
    EXPECT_LT(glm::length(worldPosition(mesh, 4) - glm::dvec3(1, 0, 0)), 1e-3);
}

TEST(GltfMeshopt, RefusesCodecsAndFiltersOfTheFutureByName)
{
    GlbBuilder next = meshoptGrid(4, {.extension = "KHR_meshopt_compression"});
    std::string file = next.glb();
    const std::size_t stream = file.find('\xa0', file.find("BIN"));
    file[stream] = '\xa1';
    try {
        loadContent("a.glb", file);
        ADD_FAILURE() << "a codec that the library does not have";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_THAT(error.what(), HasSubstr("KHR_meshopt_compression"));
        EXPECT_THAT(error.what(), HasSubstr("version 1"));
    }
    GlbBuilder color = meshoptGrid(4);
    extensionOf(color, 0)["filter"] = "COLOR";
    EXPECT_EQ(kindOfMeshopt(color), ErrorKind::unsupported);
}

TEST(GltfMeshopt, RefusesWhatDoesNotFit)
{
    const std::vector<std::pair<const char*, nlohmann::json>> wrong = {
        {"mode", "SOMETHING"},     {"mode", 3},       {"filter", "OCTAHEDRAL"},
        {"filter", "WAVES"},       {"count", 24},     {"count", 0},
        {"count", 1ULL << 40},     {"byteStride", 8}, {"byteStride", 0},
        {"byteStride", 1000},      {"buffer", 1},     {"buffer", 9},
        {"byteLength", 0},         {"byteLength", 1}, {"byteLength", 1ULL << 50},
        {"byteOffset", 1ULL << 50}};
    for (const auto& [key, value] : wrong) {
        GlbBuilder builder = meshoptGrid(4);
        extensionOf(builder, 0)[key] = value;
        std::string message;
        EXPECT_EQ(kindOfMeshopt(builder, &message), ErrorKind::input) << key << " = " << value;
        EXPECT_THAT(message, HasSubstr("bufferView 0")) << key << " = " << value;
    }
}

TEST(GltfMeshopt, MakesNoRoomForMoreThanTheBytesCanHold)
{
    // 25 elements become 3 · 2³⁰: the view says so, too.
    for (const std::size_t view : {0U, 3U}) {
        GlbBuilder builder = meshoptGrid(4);
        const std::uint64_t count = 3ULL << 30;
        extensionOf(builder, view)["count"] = count;
        builder.document["bufferViews"][view]["byteLength"] =
            count * extensionOf(builder, view)["byteStride"].get<std::uint64_t>();
        std::string message;
        EXPECT_EQ(kindOfMeshopt(builder, &message), ErrorKind::input);
        EXPECT_THAT(message, HasSubstr("cannot hold"));
    }
}

TEST(GltfMeshopt, RefusesAPlaceholderThatNothingIsDecodedInto)
{
    GlbBuilder builder = meshoptGrid(4);
    builder.document["bufferViews"][2].erase("extensions");
    std::string message;
    EXPECT_EQ(kindOfMeshopt(builder, &message), ErrorKind::input);
    EXPECT_THAT(message, HasSubstr("buffer 1"));
}

TEST(GltfMeshopt, SurvivesEveryFlippedByteAndEveryTruncation)
{
    const GlbBuilder builder = meshoptGrid(4, {.filters = true});
    const std::string file = builder.glb();
    for (std::size_t at = file.find("BIN"); at < file.size(); ++at)
        for (const unsigned mask : {0x01U, 0x10U, 0x80U, 0xffU}) {
            std::string damaged = file;
            damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ mask);
            try {
                loadContent("a.glb", damaged);
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("a.glb"));
            }
        }
    for (std::size_t view = 0; view < 4; ++view) {
        GlbBuilder cut = builder;
        const auto whole = extensionOf(cut, view)["byteLength"].get<std::size_t>();
        for (std::size_t length = 1; length < whole; ++length) {
            extensionOf(cut, view)["byteLength"] = length;
            EXPECT_EQ(kindOfMeshopt(cut), ErrorKind::input) << view << ": " << length;
        }
    }
}

} // namespace
} // namespace sward::terrain
