// A device sows the bytes that the CPU sows.
#include "core/random.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/exact_arithmetic.h"
#include "gpu/recording/commands.h"
#include "shaders/shared/sow/sown_blade.h"
#include "support/gpu/gpu_fixture.h"
#include "test_shaders.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>
#include <vector>

namespace sward::gpu {
namespace {

constexpr VkBufferUsageFlags sowUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr std::uint32_t sownPieces = 4;
constexpr std::uint32_t candidatesOfPiece = 20'000;

struct SowPush {
    VkDeviceAddress meadow, piece, vertices, conditions, waves, words, tones, blades;
};

std::vector<shared::SowSpecies> sownSpecies()
{
    std::vector<shared::SowSpecies> species(3);
    for (std::uint32_t i = 0; i < species.size(); ++i) {
        shared::SowSpecies& one = species[i];
        one.heightLow = 0.2f;
        one.heightRange = 0.3f;
        one.widthLow = 0.003f;
        one.widthRange = 0.011f;
        one.stiffnessLow = 0.3f;
        one.stiffnessRange = 0.4f;
        one.clumping = 0.3f + 0.2f * float(i);
        one.facing = i; // outward, shared, free
        one.ribbons = i == 2 ? 5 : 0;
    }
    return species;
}

shared::SowMeadow sownMeadow()
{
    shared::SowMeadow meadow = {};
    meadow.seed = 0x123456789abcdefULL;
    meadow.clumpKey = 99;
    meadow.unitBits = 16;
    meadow.levels = 6;
    meadow.speciesCount = 3;
    meadow.isMixed = 1;
    meadow.heightWaves = 0.15f;
    meadow.drifts = 0.8f;
    meadow.sparseHeight = 0.6f;
    meadow.clumpReach = 1 << 16;
    meadow.wideVariation = 0.9f;
    meadow.windX = 0.6f;
    meadow.windZ = 0.8f;
    meadow.creaseReach = 6.0f;
    meadow.creaseBlend = 0.8f;
    meadow.vertical = 0.2f;
    meadow.metresPerUnit = 1.0f / 65536.0f;
    meadow.room = 0.8f;
    meadow.heightsPerMetre = 255.0f / 0.8f;
    meadow.widthsPerMetre = 63.0f / 0.03f;
    return meadow;
}

std::uint32_t anyWord(std::uint64_t number)
{
    return static_cast<std::uint32_t>(hashBits(17, number));
}

// Whole triangles and parts, near and far from level.
shared::SeedPiece pieceOf(std::uint32_t number)
{
    shared::SeedPiece piece = {};
    piece.corners[0] = 3 * number;
    piece.corners[1] = 3 * number + 1;
    piece.corners[2] = 3 * number + 2;
    piece.source = anyWord(number) >> 4U;
    piece.count = candidatesOfPiece;
    piece.expected = 30'000.0f;
    const std::uint32_t p = number % 3;
    const std::uint32_t q = number / 2;
    piece.form = p | q << 5U | 3U << 10U | 2U << 18U;
    piece.low = anyWord(100 + number) & ((1U << p) - 1);
    piece.target = anyWord(200 + number) & ((1U << q) - 1);
    piece.sScale = 3U << 16U;
    piece.creases = number % 2 == 0 ? 0 : shared::noSeedBits;
    return piece;
}

std::vector<shared::SeedVertex> cornersOfPieces()
{
    std::vector<shared::SeedVertex> vertices;
    for (std::uint64_t i = 0; i < 3 * sownPieces; ++i) {
        const auto coordinate = [&](std::uint64_t axis) {
            return static_cast<int>(anyWord(1000 + 3 * i + axis) % (32U << 16U));
        };
        vertices.push_back({coordinate(0), coordinate(1), coordinate(2), anyWord(2000 + i) >> 2U});
    }
    return vertices;
}

std::vector<shared::SeedConditions> anyConditions()
{
    std::vector<shared::SeedConditions> list(12);
    auto* const words = reinterpret_cast<std::uint32_t*>(list.data());
    for (std::size_t i = 0; i < list.size() * sizeof list[0] / 4; ++i)
        words[i] = anyWord(3000 + i);
    return list;
}

std::vector<shared::SowWave> anyWaves()
{
    std::vector<shared::SowWave> waves(shared::sowSpeciesWaves + 4 * 3);
    for (std::uint64_t i = 0; i < waves.size(); ++i) {
        waves[i].step = (1ULL << 32U) / (2 + i);
        for (std::uint64_t axis = 0; axis < 3; ++axis) {
            waves[i].cell[axis] = anyWord(4000 + 3 * i + axis);
            waves[i].fraction[axis] = anyWord(5000 + 3 * i + axis);
        }
    }
    return waves;
}

// A list of two creases, and those.
std::vector<std::uint32_t> anyCreases()
{
    std::vector<std::uint32_t> words{2, 3, 11};
    for (std::uint64_t i = 0; i < 16; ++i)
        words.push_back(i % 8 < 6 ? anyWord(6000 + i) % (32U << 16U) : anyWord(6000 + i) >> 2U);
    return words;
}

// Any order of numbers, and any places.
std::vector<std::uint32_t> anyTones()
{
    std::vector<std::uint32_t> words(128);
    for (std::uint64_t i = 0; i < words.size(); ++i)
        words[i] = anyWord(7000 + i);
    return words;
}

// The ground's up-vector, from a centre 3 m beside the cell's corner.
constexpr shared::SowGround sownGround{{3.0f, 2.0f, -1.0f}, 1};

// The steps of sow.comp.
std::vector<shared::PackedBlade> sownOnTheCpu(const shared::SeedPiece& piece)
{
    using namespace shared;
    SowMeadow meadow = sownMeadow();
    const std::vector<SowSpecies> speciesList = sownSpecies();
    meadow.species.at = speciesList.data();
    const std::vector<SeedVertex> vertices = cornersOfPieces();
    const std::vector<SeedConditions> conditions = anyConditions();
    const std::vector<SowWave> waveList = anyWaves();
    SowWaves waves = {};
    waves.at = waveList.data();
    const std::vector<std::uint32_t> wordList = anyCreases();
    SowWords words = {};
    words.at = wordList.data();
    const std::vector<std::uint32_t> toneList = anyTones();
    SowTones tones = {};
    tones.at = toneList.data();
    const SeedVertex& a = vertices[piece.corners[0]];
    const SeedVertex& b = vertices[piece.corners[1]];
    const SeedVertex& c = vertices[piece.corners[2]];
    std::vector<PackedBlade> blades;
    for (std::uint32_t j = 0; j < piece.count; ++j) {
        const std::uint32_t candidate = sowCandidate(piece, j);
        const SowPoint point = sowPoint(sowSequence(meadow.seed, piece.source, 0), candidate);
        const glm::uvec2 weights = sowWeights(point);
        const std::uint64_t key = std::uint64_t(piece.source) << 32U | candidate;
        SowRoot root = {};
        root.own = sowHash(meadow.seed, key);
        root.hash = static_cast<std::uint32_t>(sowHash(meadow.seed + 1, key) & 15U);
        root.place = sowPlace(a, b, c, weights);
        root.up = sowUpAt(meadow, piece, glm::uvec3(a.up, b.up, c.up), weights, root.place, words,
                          sownGround);
        sowEdges(a, b, c, root.first, root.second);
        root.level = sowLevel(sowRank(candidate, sowRounding(meadow.seed, piece.source, 0),
                                      sowDivide(1.0f, piece.expected)),
                              meadow.levels);
        SowClump clump = {};
        clump.key = root.own;
        if ((candidate & 3U) != 0) {
            clump.key = sowClumpKey(meadow.clumpKey, piece.source, candidate & 3U);
            const glm::ivec3 centre = sowClumpPlace(a, b, c, clump.key);
            clump.offset = root.place - centre;
            const SeedClump seed = {0, 0, int(candidate & 0x3fffU) - 8192};
            clump.wide = sowClumpTraits(meadow, seed, centre, root.first, root.second, sownGround,
                                        waves);
            clump.along = sowClumpDirection(root.first, root.second, clump.key);
            clump.isAny = 1;
        }
        const SowGridPlace grid = sowGridPlace(piece, point);
        const SeedConditions found =
            sowConditions(conditions[grid.records[0]], conditions[grid.records[1]],
                          conditions[grid.records[2]], conditions[grid.records[3]], grid);
        const SownBlade blade = sowBlade(meadow, root, clump, found, waves, tones);
        blades.push_back(sowRibbon(meadow, blade, 1, 0.5f, 0.25f));
        if (!sowGrows(found, root.own))
            blades.back().look = 0xffffffffU;
        blades.push_back(blade.bits);
    }
    return blades;
}

class SowOnDevice : public test::GpuTest {};

template <typename T>
Buffer bufferOf(const DeviceContext& context, Uploader& uploader, const std::vector<T>& list)
{
    Buffer buffer(context, {.name = "seeds", .bytes = list.size() * sizeof(T), .usage = sowUsage});
    uploader.toBuffer(buffer, std::span(list));
    return buffer;
}

TEST_F(SowOnDevice, HasTheBytesOfTheCpu)
{
    const ComputePipeline pipeline(
        context(), test::testShaders(),
        {.name = "sow",
         .shader = "sow.comp",
         .pushConstantBytes = sizeof(SowPush),
         .isExact = true});
    for (std::uint32_t number = 0; number < sownPieces; ++number) {
        const shared::SeedPiece piece = pieceOf(number);
        const std::vector<shared::PackedBlade> expected = sownOnTheCpu(piece);
        Uploader uploader(context());
        const Buffer species = bufferOf(context(), uploader, sownSpecies());
        shared::SowMeadow onDevice = sownMeadow();
        onDevice.species.address = species.address();
        const Buffer meadow = bufferOf(context(), uploader, std::vector{onDevice});
        const Buffer pieces = bufferOf(context(), uploader, std::vector{piece});
        const Buffer vertices = bufferOf(context(), uploader, cornersOfPieces());
        const Buffer conditions = bufferOf(context(), uploader, anyConditions());
        const Buffer waves = bufferOf(context(), uploader, anyWaves());
        const Buffer words = bufferOf(context(), uploader, anyCreases());
        const Buffer tones = bufferOf(context(), uploader, anyTones());
        const Buffer blades =
            bufferOf(context(), uploader, std::vector<shared::PackedBlade>(expected.size()));
        uploader.finish();
        submitAndWait(context(), [&](VkCommandBuffer commands) {
            pipeline.bind(commands);
            pipeline.push(commands,
                          SowPush{meadow.address(), pieces.address(), vertices.address(),
                                  conditions.address(), waves.address(), words.address(),
                                  tones.address(), blades.address()});
            vkCmdDispatch(commands, (piece.count + 63) / 64, 1, 1);
        });
        const auto found = readBufferAs<shared::PackedBlade>(context(), blades);
        ASSERT_EQ(found.size(), expected.size());
        std::size_t differ = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            differ += std::memcmp(&found[i], &expected[i], sizeof found[i]) != 0 ? 1U : 0U;
        EXPECT_EQ(differ, 0U) << "of " << found.size() << ", piece " << number;
    }
}

// Float operations of a module, and those of them that must not be contracted.
struct Operations {
    std::size_t all = 0;
    std::size_t alone = 0;
};

Operations operationsOf(std::span<const std::uint32_t> words)
{
    std::set<std::uint32_t> alone;
    Operations found;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16U) {
        const std::uint32_t opcode = words[at] & 0xffffU;
        if (opcode == 71 && words[at + 2] == 42) // OpDecorate NoContraction
            alone.insert(words[at + 1]);
        // OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpVectorTimesScalar, OpDot
        for (const std::uint32_t one : {127U, 129U, 131U, 133U, 136U, 142U, 148U})
            if (opcode == one) {
                ++found.all;
                found.alone += alone.contains(words[at + 2]) ? 1U : 0U;
            }
    }
    return found;
}

TEST(ExactArithmetic, RoundsEveryOperationByItself)
{
    const auto words = test::testShaders().code("sow.comp");
    const Operations free = operationsOf(words);
    EXPECT_GT(free.all, 300U);
    EXPECT_EQ(free.alone, 0U) << "as it is compiled, a driver may contract";
    const Operations exact = operationsOf(withoutContraction(words));
    EXPECT_EQ(exact.all, free.all);
    EXPECT_EQ(exact.alone, free.all);
}

} // namespace
} // namespace sward::gpu
