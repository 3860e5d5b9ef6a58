#include "core/error.h"
#include "terrain/heightmap/height_samples.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

// Bytes of a block of rows, or of a row of tiles, that OpenEXR buffers, besides `bufferRatio` for
// each byte of the file.
constexpr std::uint64_t bufferLimit = std::uint64_t(24) << 20;
constexpr std::uint64_t bufferRatio = 16;
constexpr std::uint64_t bytesOfSample = 4;
constexpr std::size_t samplesAtOnce = std::size_t(1) << 20;
constexpr unsigned tileLimit = 4096;     // samples on a side of a tile
constexpr std::size_t channelLimit = 1024;
constexpr std::size_t bytesOfOffset = 8; // of a block of rows or a tile, in the table of offsets

// Attributes that are read. Others only count by their sizes: to OpenEXR they are of an unknown
// type, so that it does not unpack what they hold.
constexpr std::array<std::string_view, 14> readTypes{
    "box2i", "box2f", "chlist", "compression", "double", "envmap", "float",
    "int",   "lineOrder", "string", "tiledesc", "v2f", "v2i", "v3f"};

// OpenEXR stream over bytes in memory, with a header of its own.
class MemoryStream final : public Imf::IStream {
public:
    MemoryStream(std::span<const std::byte> file, const std::string& place)
        : Imf::IStream(place.c_str())
        , file_(file)
        , place_(place)
        , header_(checkedHeader())
    {
    }

    std::size_t fileBytes() const { return file_.size(); }
    std::size_t headerBytes() const { return header_.size(); }

    bool read(char to[], int size) override
    {
        const auto wanted = static_cast<std::size_t>(std::max(size, 0));
        requireBytes(at_, wanted);
        for (std::size_t i = 0; i < wanted;) {
            const bool isHeader = at_ < header_.size();
            const std::span<const std::byte> rest =
                isHeader ? std::span<const std::byte>(header_).subspan(at_) : file_.subspan(at_);
            const std::size_t taken = std::min(wanted - i, rest.size());
            std::memcpy(to + i, rest.data(), taken);
            i += taken;
            at_ += taken;
        }
        return at_ < file_.size();
    }

    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = at; }

private:
    void requireBytes(std::uint64_t at, std::uint64_t wanted) const
    {
        if (at > file_.size() || wanted > file_.size() - at)
            fail(ErrorKind::input, "{}: truncated: ends after {} bytes", place_, file_.size());
    }

    // A text that ends with a zero.
    std::string_view textAt(std::size_t at) const
    {
        constexpr std::size_t longest = 255;
        std::size_t end = at;
        while (end < file_.size() && end - at <= longest && file_[end] != std::byte(0))
            ++end;
        requireBytes(end, 1);
        if (end - at > longest)
            fail(ErrorKind::input, "{}: damaged: a name in its header has no end", place_);
        return {reinterpret_cast<const char*>(file_.data()) + at, end - at};
    }

    // Walks through the attributes: names, types and sizes that fit the file.
    std::vector<std::byte> checkedHeader() const
    {
        std::size_t at = 8; // behind magic number and version
        requireBytes(0, at);
        std::vector<std::size_t> foreign; // places of types that are not read
        while (true) {
            const std::string_view name = textAt(at);
            at += name.size() + 1;
            if (name.empty())
                break;
            const std::string_view type = textAt(at);
            if (std::find(readTypes.begin(), readTypes.end(), type) == readTypes.end())
                foreign.push_back(at);
            at += type.size() + 1;
            requireBytes(at, 4);
            std::int32_t size = 0;
            std::memcpy(&size, file_.data() + at, sizeof size);
            at += 4;
            if (size < 0)
                fail(ErrorKind::input, "{}: damaged: its attribute {} has {} bytes", place_, name,
                     size);
            requireBytes(at, static_cast<std::uint64_t>(size));
            at += static_cast<std::size_t>(size);
        }
        std::vector<std::byte> header(file_.begin(),
                                      file_.begin() + static_cast<std::ptrdiff_t>(at));
        for (const std::size_t place : foreign)
            if (header[place] != std::byte(0))
                header[place] = std::byte('_');
        return header;
    }

    std::span<const std::byte> file_;
    const std::string& place_;
    std::vector<std::byte> header_;
    std::uint64_t at_ = 0;
};

// Rows that a compression takes at once.
std::uint64_t rowsOfBlock(Imf::Compression compression)
{
    switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
        return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
        return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
        return 32;
    default:
        return 256;
    }
}

// Checks that the table of offsets and the buffers fit the file, before OpenEXR makes them.
void checkBlocks(const Imf::Header& header, bool isTiled, std::uint64_t width,
                 std::uint64_t height, std::uint64_t channels, const MemoryStream& stream,
                 const std::string& place)
{
    std::uint64_t blocks = 0;
    std::uint64_t buffered = 0;
    if (isTiled && header.hasTileDescription()) {
        const std::uint64_t tileWidth = header.tileDescription().xSize;
        const std::uint64_t tileHeight = header.tileDescription().ySize;
        if (tileWidth == 0 || tileHeight == 0 || std::max(tileWidth, tileHeight) > tileLimit)
            fail(ErrorKind::input, "{}: tiles of {}x{} samples, outside 1 to {} a side", place,
                 tileWidth, tileHeight, tileLimit);
        const std::uint64_t across = (width + tileWidth - 1) / tileWidth;
        blocks = across * ((height + tileHeight - 1) / tileHeight);
        buffered = (across + 1) * tileWidth * tileHeight;
    } else {
        const std::uint64_t rows = rowsOfBlock(header.compression());
        blocks = (height + rows - 1) / rows;
        buffered = 2 * width * rows;
    }
    if (blocks * bytesOfOffset > stream.fileBytes() - stream.headerBytes())
        fail(ErrorKind::input, "{}: truncated: it has {} bytes for {} blocks of samples", place,
             stream.fileBytes(), blocks);
    if (buffered * channels * bytesOfSample >
        std::max(bufferLimit, bufferRatio * stream.fileBytes()))
        fail(ErrorKind::input,
             "{}: its blocks take {} bytes in memory, too many for a file of {} bytes", place,
             buffered * channels * bytesOfSample, stream.fileBytes());
}

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
    const std::uint64_t height = length(window.min.y, window.max.y);
    requireHeightmapSize(width, height, place);
    std::size_t channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        ++channels;
    if (channels == 0 || channels > channelLimit)
        fail(ErrorKind::input, "{}: {} channels, outside 1 to {}", place, channels, channelLimit);
    checkBlocks(header, isTiled, width, height, channels, stream, place);
}

std::string heightChannel(const Imf::ChannelList& channels)
{
    for (const char* const name : {"Y", "Z", "R", "height", "Height"})
        if (channels.findChannel(name) != nullptr)
            return name;
    return channels.begin().name();
}

// Makes holes of what is transparent, unless all is.
void dropTransparent(const std::vector<bool>& isTransparent, HeightSamples& samples,
                     const std::string& place, Diagnostics& diagnostics)
{
    if (isTransparent.empty())
        return;
    if (std::find(isTransparent.begin(), isTransparent.end(), false) == isTransparent.end()) {
        diagnostics.warn("{}: all samples are transparent; their transparency is ignored", place);
        return;
    }
    for (std::size_t i = 0; i < samples.values.size(); ++i)
        if (isTransparent[i])
            samples.values[i] = std::numeric_limits<float>::quiet_NaN();
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

    if (name != "Y" && name != "Z" && name != "height" && name != "Height")
        diagnostics.warn("{}: has no channel Y; its channel {} is taken as the height", place,
                         name);
    const Imf::Channel* const alpha = file.header().channels().findChannel("A");
    const bool hasAlpha =
        name != "A" && alpha != nullptr && alpha->xSampling == 1 && alpha->ySampling == 1;

    HeightSamples samples;
    samples.isMetric = true;
    samples.size = {static_cast<unsigned>(window.max.x - window.min.x + 1),
                    static_cast<unsigned>(window.max.y - window.min.y + 1)};
    // Some rows at a time: memory grows as they are unpacked.
    const std::size_t width = samples.size.x;
    const auto rows =
        static_cast<int>(std::clamp<std::size_t>(samplesAtOnce / width, 1, samples.size.y));
    std::vector<float> alphas;
    std::vector<bool> isTransparent;
    for (int first = window.min.y; first <= window.max.y; first += rows) {
        const int last = std::min(window.max.y, first + rows - 1);
        const std::size_t before = samples.values.size();
        samples.values.resize(before + width * static_cast<std::size_t>(last - first + 1));
        alphas.assign(hasAlpha ? samples.values.size() - before : 0, 1.0f);
        const Imath::Box2i part({window.min.x, first}, {window.max.x, last});
        Imf::FrameBuffer buffer;
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, samples.values.data() + before, part));
        if (hasAlpha)
            buffer.insert("A", Imf::Slice::Make(Imf::FLOAT, alphas.data(), part));
        file.setFrameBuffer(buffer);
        file.readPixels(first, last);
        for (const float one : alphas)
            isTransparent.push_back(one < 0.5f);
    }
    dropTransparent(isTransparent, samples, place, diagnostics);
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
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        fail(ErrorKind::input,
             "{}: not an OpenEXR image that can be read: its header or a block of samples is "
             "damaged",
             place);
    }

    dropNoData(samples, place, diagnostics);
    return samples;
}

} // namespace sward::terrain
