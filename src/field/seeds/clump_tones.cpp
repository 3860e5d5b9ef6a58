#include "field/seeds/clump_tones.h"

#include "shaders/shared/look/blade_colors.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace sward::field {

std::vector<std::uint8_t> clumpsByTone()
{
    std::vector<std::uint8_t> numbers(shared::driedClump);
    std::iota(numbers.begin(), numbers.end(), std::uint8_t(0));
    std::stable_sort(numbers.begin(), numbers.end(), [](std::uint8_t a, std::uint8_t b) {
        return shared::clumpTone(a) < shared::clumpTone(b);
    });
    return numbers;
}

std::vector<std::uint8_t> placesByTone()
{
    const std::vector<std::uint8_t> numbers = clumpsByTone();
    std::vector<std::uint8_t> places(numbers.size());
    for (std::size_t place = 0; place < numbers.size(); ++place)
        places[numbers[place]] = static_cast<std::uint8_t>(place);
    return places;
}

std::vector<std::uint32_t> toneWords()
{
    std::vector<std::uint32_t> words(128, 0);
    const auto put = [&](const std::vector<std::uint8_t>& bytes, std::size_t first) {
        for (std::size_t i = 0; i < bytes.size(); ++i)
            words[first + i / 4] |= std::uint32_t(bytes[i]) << 8U * (i % 4);
    };
    put(clumpsByTone(), 0);
    put(placesByTone(), 64);
    return words;
}

} // namespace sward::field
