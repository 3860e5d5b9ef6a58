#include "apps/common/picture/exr_file.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

namespace sward::apps {
namespace {

// The file in memory: it is written whole afterwards.
class MemoryOutput final : public Imf::OStream {
public:
    MemoryOutput()
        : Imf::OStream("picture")
    {
    }

    void write(const char from[], int count) override
    {
        const auto size = static_cast<std::size_t>(std::max(count, 0));
        bytes_.resize(std::max(bytes_.size(), at_ + size));
        std::memcpy(bytes_.data() + at_, from, size);
        at_ += size;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t place) override { at_ = static_cast<std::size_t>(place); }

    const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

Imf::PixelType pixelType(ExrChannel::Type type)
{
    switch (type) {
    case ExrChannel::Type::half:
        return Imf::HALF;
    case ExrChannel::Type::whole:
        return Imf::UINT;
    case ExrChannel::Type::real:
        break;
    }
    return Imf::FLOAT;
}

Imf::Header headerOf(glm::uvec2 size, ExrCompression compression)
{
    Imf::Header header(static_cast<int>(size.x), static_cast<int>(size.y));
    header.compression() =
        compression == ExrCompression::zip ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
    return header;
}

/// Adds channels to a header, and where their numbers are.
Imf::FrameBuffer addChannels(Imf::Header& header, glm::uvec2 size,
                             std::span<const ExrChannel> channels)
{
    Imf::FrameBuffer pixels;
    for (const ExrChannel& channel : channels) {
        const Imf::PixelType type = pixelType(channel.type);
        header.channels().insert(channel.name, Imf::Channel(type));
        // The library only reads what it calls a pointer to characters that may change.
        char* const first = static_cast<char*>(const_cast<void*>(channel.first));
        pixels.insert(channel.name, Imf::Slice(type, first, channel.step, channel.step * size.x));
    }
    return pixels;
}

std::vector<std::byte> encode(glm::uvec2 size, std::span<const ExrPart> parts,
                              ExrCompression compression)
{
    std::vector<Imf::Header> headers;
    std::vector<Imf::FrameBuffer> pixels;
    for (const ExrPart& part : parts) {
        Imf::Header& header = headers.emplace_back(headerOf(size, compression));
        header.setName(part.name);
        header.setType(Imf::SCANLINEIMAGE);
        pixels.push_back(addChannels(header, size, part.channels));
    }
    MemoryOutput output;
    {
        Imf::MultiPartOutputFile file(output, headers.data(), static_cast<int>(headers.size()),
                                      false, 0);
        for (std::size_t i = 0; i < headers.size(); ++i) {
            Imf::OutputPart part(file, static_cast<int>(i));
            part.setFrameBuffer(pixels[i]);
            part.writePixels(static_cast<int>(size.y));
        }
    }
    return output.bytes();
}

std::vector<std::byte> encode(glm::uvec2 size, std::span<const ExrChannel> channels)
{
    Imf::Header header = headerOf(size, ExrCompression::zip);
    const Imf::FrameBuffer pixels = addChannels(header, size, channels);
    MemoryOutput output;
    {
        Imf::OutputFile file(output, header, 0);
        file.setFrameBuffer(pixels);
        file.writePixels(static_cast<int>(size.y));
    }
    return output.bytes();
}

/// Writes what `encoded` returns.
template <typename Encode>
void writeEncoded(const Encode& encoded, glm::uvec2 size, std::size_t channels,
                  const std::filesystem::path& path, bool overwrite)
{
    expect(size.x > 0 && size.y > 0 && channels > 0, "a picture has pixels and channels");
    std::vector<std::byte> bytes;
    try {
        bytes = encoded();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        fail(ErrorKind::runtime, "{}: cannot encode a picture of {}x{} pixels with {} channels",
             path.string(), size.x, size.y, channels);
    }
    AtomicFile file(path, overwrite);
    file.write(bytes);
    file.commit();
}

} // namespace

void writeExr(glm::uvec2 size, std::span<const ExrChannel> channels,
              const std::filesystem::path& path, bool overwrite)
{
    writeEncoded([&] { return encode(size, channels); }, size, channels.size(), path, overwrite);
}

void writeExrParts(glm::uvec2 size, std::span<const ExrPart> parts, ExrCompression compression,
                   const std::filesystem::path& path, bool overwrite)
{
    std::size_t channels = 0;
    for (const ExrPart& part : parts)
        channels += part.channels.size();
    writeEncoded([&] { return encode(size, parts, compression); }, size, channels, path, overwrite);
}

} // namespace sward::apps
