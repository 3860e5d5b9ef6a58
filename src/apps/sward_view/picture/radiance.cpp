#include "apps/sward_view/picture/radiance.h"

#include "apps/common/picture/exr_file.h"
#include "core/expect.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace sward::view {
namespace {

std::size_t numbersOf(glm::uvec2 size)
{
    return 4 * std::size_t(size.x) * size.y;
}

} // namespace

RadianceMean::RadianceMean(glm::uvec2 size)
    : size_(size)
    , sums_(numbersOf(size))
{
}

void RadianceMean::add(const Radiance& picture)
{
    expect(picture.size == size_ && picture.rgba.size() == sums_.size(), "pictures of one size");
    for (std::size_t i = 0; i < sums_.size(); ++i)
        sums_[i] += glm::unpackHalf1x16(picture.rgba[i]);
    ++count_;
}

Radiance RadianceMean::mean() const
{
    expect(count_ > 0, "a mean is of something");
    Radiance picture{size_, {}};
    picture.rgba.reserve(sums_.size());
    for (const float sum : sums_)
        picture.rgba.push_back(glm::packHalf1x16(sum / static_cast<float>(count_)));
    return picture;
}

void writeExr(const Radiance& picture, const std::filesystem::path& path, bool overwrite)
{
    expect(picture.rgba.size() == numbersOf(picture.size), "a picture has four numbers a pixel");
    using apps::ExrChannel;
    std::array<ExrChannel, 3> channels;
    for (std::size_t i = 0; i < channels.size(); ++i)
        channels[i] = {.name = std::string(1, "RGB"[i]),
                       .type = ExrChannel::Type::half,
                       .first = picture.rgba.data() + i,
                       .step = 4 * sizeof(std::uint16_t)};
    apps::writeExr(picture.size, channels, path, overwrite);
}

} // namespace sward::view
