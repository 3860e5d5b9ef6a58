#include "apps/sward/files/poster.h"

#include "apps/common/picture/jpeg_file.h"
#include "core/files/mapped_file.h"
#include "terrain/image/image_decode.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sward::apps {
namespace {

/// The picture with fewer pixels: each is the mean of those that it stands for, as they are
/// encoded.
std::vector<std::uint8_t> shrunk(const terrain::GroundImage& image, glm::uvec2 size)
{
    std::vector<std::uint8_t> rgb(std::size_t(3) * size.x * size.y);
    for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const auto from = [](std::uint32_t i, std::uint32_t of, std::uint32_t all) {
                return static_cast<std::uint32_t>(std::uint64_t(i) * all / of);
            };
            std::uint64_t sums[3] = {};
            std::uint64_t count = 0;
            const std::uint32_t endY =
                std::max(from(y + 1, size.y, image.height), from(y, size.y, image.height) + 1);
            const std::uint32_t endX =
                std::max(from(x + 1, size.x, image.width), from(x, size.x, image.width) + 1);
            for (std::uint32_t row = from(y, size.y, image.height); row < endY; ++row)
                for (std::uint32_t column = from(x, size.x, image.width); column < endX;
                     ++column, ++count)
                    for (std::size_t c = 0; c < 3; ++c)
                        sums[c] += image.rgba[4 * (std::size_t(row) * image.width + column) + c];
            for (std::size_t c = 0; c < 3; ++c)
                rgb[3 * (std::size_t(y) * size.x + x) + c] =
                    static_cast<std::uint8_t>((sums[c] + count / 2) / count);
        }
    return rgb;
}

} // namespace

std::string readPoster(const std::filesystem::path& path)
{
    const MappedFile file(path);
    const terrain::GroundImage image = terrain::decodeNeededImage(file.bytes(), path.string());
    glm::uvec2 size(image.width, image.height);
    for (unsigned side = maxPosterSide;; side = side * 3 / 4) {
        const unsigned longest = std::max(image.width, image.height);
        if (longest > side)
            size = glm::max(glm::uvec2(std::uint64_t(image.width) * side / longest,
                                       std::uint64_t(image.height) * side / longest),
                            glm::uvec2(1));
        const std::vector<std::uint8_t> rgb = shrunk(image, size);
        // Grass takes many bytes: below this quality fewer pixels look better.
        for (const int quality : {85, 70, 55, 40}) {
            std::string jpeg = jpegOf(size, rgb, quality);
            if (jpeg.size() <= maxPosterBytes)
                return jpeg;
        }
    }
}

} // namespace sward::apps
