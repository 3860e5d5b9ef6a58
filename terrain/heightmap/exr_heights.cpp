#include "core/error.h"
#include "terrain/heightmap/height_samples.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace sward::terrain {
namespace {

// Channels times width. OpenEXR buffers up to 256 rows of all channels, 4 bytes each.
constexpr std::size_t rowLimit = std::size_t(1) << 18;
constexpr unsigned tileLimit = 4096; // samples on a side of a tile

// OpenEXR stream over bytes in memory.
class MemoryStream final : public Imf::IStream {
public:
    MemoryStream(std::span<const std::byte> file, const std::string& place)
        : Imf::IStream(place.c_str())
        , file_(file)
        , place_(place)
    {
    }

    bool read(char to[], int size) override
    {
        const auto wanted = static_cast<std::size_t>(std::max(size, 0));
        if (at_ > file_.size() || wanted > file_.size() - at_)
            fail(ErrorKind::input, "{}: truncated: ends after {} bytes", place_, file_.size());
        std::memcpy(to, file_.data() + at_, wanted);
        at_ += wanted;
        return at_ < file_.size();
    }

    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = at; }

private:
    std::span<const std::byte> file_;
    const std::string& place_;
    std::uint64_t at_ = 0;
};

// Rejects unsupported files before memory of the declared size is allocated.
void checkHeader(MemoryStream& stream, const std::string& place)
{
    bool isTiled = false;
    bool isDeep = false;
    bool hasParts = false;
    if (!Imf::isOpenExrFile(stream, isTiled, isDeep, hasParts))
        fail(ErrorKind::input, "{}: not an OpenEXR file", place);
    if (isDeep || hasParts)
        fail(ErrorKind::unsupported, "{}: {} are not read; save one flat image", place,
             isDeep ? "deep images" : "images of several parts");

    // Magic number and version come before the header.
    std::array<char, 8> start{};
    stream.read(start.data(), static_cast<int>(start.size()));
    int version = 0;
    std::memcpy(&version, start.data() + 4, sizeof version);
    Imf::Header header;
    header.readFrom(stream, version);
    stream.seekg(0);

    const Imath::Box2i& window = header.dataWindow();
    const auto length = [](int low, int high) {
        return static_cast<std::uint64_t>(std::max<std::int64_t>(0, 1 + std::int64_t(high) - low));
    };
    const std::uint64_t width = length(window.min.x, window.max.x);
    requireHeightmapSize(width, length(window.min.y, window.max.y), place);
    std::size_t channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        ++channels;
    if (channels == 0 || channels * width > rowLimit)
        fail(ErrorKind::input, "{}: {} channels of {} samples a row, outside 1 to {} in all", place,
             channels, width, rowLimit);
    if (isTiled && header.hasTileDescription() &&
        std::max(header.tileDescription().xSize, header.tileDescription().ySize) > tileLimit)
        fail(ErrorKind::input, "{}: tiles of {}x{} samples, more than {} a side", place,
             header.tileDescription().xSize, header.tileDescription().ySize, tileLimit);
}

std::string heightChannel(const Imf::ChannelList& channels)
{
    for (const char* const name : {"Y", "Z", "R", "height", "Height"})
        if (channels.findChannel(name) != nullptr)
            return name;
    return channels.begin().name();
}

HeightSamples readSamples(MemoryStream& stream, const std::string& place, Diagnostics& diagnostics)
{
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const std::string name = heightChannel(file.header().channels());
    const Imf::Channel& channel = file.header().channels()[name.c_str()];
    if (channel.xSampling != 1 || channel.ySampling != 1)
        fail(ErrorKind::unsupported, "{}: channel {} has one sample for {}x{} pixels", place, name,
             channel.xSampling, channel.ySampling);

    HeightSamples samples;
    samples.isMetric = true;
    samples.size = {static_cast<unsigned>(window.max.x - window.min.x + 1),
                    static_cast<unsigned>(window.max.y - window.min.y + 1)};
    samples.values.resize(std::size_t(samples.size.x) * samples.size.y);
    Imf::FrameBuffer buffer;
    if (name != "Y" && name != "Z" && name != "height" && name != "Height")
        diagnostics.warn("{}: has no channel Y; its channel {} is taken as the height", place,
                         name);
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, samples.values.data(), window));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return samples;
}

} // namespace

HeightSamples readExrHeights(std::span<const std::byte> file, const std::string& place,
                             Diagnostics& diagnostics)
{
    HeightSamples samples;
    try {
        MemoryStream stream(file, place);
        checkHeader(stream, place);
        samples = readSamples(stream, place, diagnostics);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(ErrorKind::input, "{}: not an OpenEXR image that can be read: {}", place,
             error.what());
    }

    dropNoData(samples, place, diagnostics);
    return samples;
}

} // namespace sward::terrain
