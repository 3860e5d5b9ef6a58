// Runs every start input and every found input of the fuzzers in the ordinary build.

#include "core/files/mapped_file.h"
#include "fuzz/entries.h"
#include "fuzz/memory_law.h"
#include "fuzz/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace sward::fuzz {
namespace {

constexpr std::chrono::seconds patience{60}; // longest time per input

Bytes bytesOf(const auto& container)
{
    return {reinterpret_cast<const std::uint8_t*>(container.data()), container.size()};
}

class FuzzReplay : public testing::TestWithParam<Entry> {
protected:
    // Of memory for an input of so many bytes. What unpacks has bounds of its own.
    static std::size_t limitOf(std::size_t bytes)
    {
        return GetParam().followsData ? memoryLimit(bytes)
                                      : std::numeric_limits<std::size_t>::max();
    }
};

TEST_P(FuzzReplay, EveryFileOfTheCorpusEndsWell)
{
    std::vector<std::filesystem::path> files;
    for (const auto& file :
         std::filesystem::directory_iterator(std::filesystem::path(SWARD_CORPUS) / GetParam().name))
        files.push_back(file.path());
    std::sort(files.begin(), files.end());
    EXPECT_FALSE(files.empty());
    for (const std::filesystem::path& file : files) {
        SCOPED_TRACE(file.filename());
        const auto start = std::chrono::steady_clock::now();
        const std::vector<std::byte> bytes = readFile(file);
        const MemoryPeak peak;
        GetParam().call(bytesOf(bytes));
        EXPECT_LE(peak.bytes(), limitOf(bytes.size()));
        EXPECT_LT(std::chrono::steady_clock::now() - start, patience);
    }
}

TEST_P(FuzzReplay, EverySampleEndsWell)
{
    std::size_t count = 0;
    for (const Sample& sample : samples())
        if (sample.entry == GetParam().name) {
            SCOPED_TRACE(sample.name);
            const MemoryPeak peak;
            GetParam().call(bytesOf(sample.bytes));
            EXPECT_LE(peak.bytes(), limitOf(sample.bytes.size()));
            ++count;
        }
    EXPECT_GT(count, 0U);
}

// The fuzzer mends hashes, so that each change reaches the seeds.
TEST(FuzzedSeeds, EveryChangedByteEndsWell)
{
    for (const Sample& sample : samples()) {
        if (sample.name != "seeded_mixed.sward")
            continue;
        const std::string& whole = sample.bytes;
        const auto end = [&](const std::string& bytes) {
            const MemoryPeak peak;
            fieldReader(bytesOf(bytes));
            EXPECT_LE(peak.bytes(), memoryLimit(bytes.size()));
        };
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int change : {1, 128, 255}) {
                std::string changed = whole;
                changed[at] = static_cast<char>(changed[at] ^ change);
                end(changed);
            }
        for (std::size_t size = 0; size < whole.size(); size += 7)
            end(whole.substr(0, size));
    }
}

TEST(MemoryPeak, CountsWhatIsHeldAtOneTime)
{
    const MemoryPeak peak;
    for (unsigned char i = 0; i < 3; ++i) {
        const auto block = std::make_unique<std::vector<unsigned char>>(std::size_t(1) << 20, i);
        EXPECT_EQ(block->back(), i);
    }
    EXPECT_GE(peak.bytes(), std::size_t(1) << 20);
    EXPECT_LT(peak.bytes(), std::size_t(2) << 20);
}

INSTANTIATE_TEST_SUITE_P(Entries, FuzzReplay, testing::ValuesIn(entries),
                         [](const auto& entry) { return std::string(entry.param.name); });

} // namespace
} // namespace sward::fuzz
