#include "terrain/gltf/file/container.h"

#include "core/error.h"

#include <cstdint>
#include <cstring>

namespace sward::terrain {
namespace {

// glTF 2.0 specification, 4.4 "Binary glTF Layout".
constexpr std::uint32_t glbMagic = 0x46546c67;    // "glTF"
constexpr std::uint32_t jsonChunk = 0x4e4f534a;   // "JSON"
constexpr std::uint32_t binaryChunk = 0x004e4942; // "BIN\0"
constexpr std::size_t headerSize = 12;
constexpr std::size_t chunkHeaderSize = 8;

std::uint32_t readWord(std::span<const std::byte> file, std::size_t offset)
{
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + offset, sizeof word);
    return word;
}

void writeWord(std::vector<unsigned char>& file, std::size_t word)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        file.push_back(static_cast<unsigned char>((word >> shift) & 0xffU));
}

std::string_view asText(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

GltfParts splitGlb(std::span<const std::byte> file, const std::string& place)
{
    if (file.size() < headerSize + chunkHeaderSize)
        fail(ErrorKind::input, "{}: ends after {} bytes, inside the GLB header", place,
             file.size());
    const std::uint32_t version = readWord(file, 4);
    if (version != 2)
        fail(ErrorKind::unsupported, "{}: GLB version {}; only version 2 is read", place, version);
    const std::size_t length = readWord(file, 8);
    if (length > file.size())
        fail(ErrorKind::input, "{}: truncated: the header says {} bytes, the file has {}", place,
             length, file.size());

    // Visit the chunks; skip unknown kinds, as the specification requires.
    GltfParts parts;
    bool hasJson = false;
    std::size_t offset = headerSize;
    for (int chunk = 0; offset + chunkHeaderSize <= length; ++chunk) {
        const std::size_t size = readWord(file, offset);
        const std::uint32_t kind = readWord(file, offset + 4);
        offset += chunkHeaderSize;
        if (size > length - offset)
            fail(ErrorKind::input, "{}: chunk {} says {} bytes, but only {} are left", place, chunk,
                 size, length - offset);
        const auto bytes = file.subspan(offset, size);
        if (chunk == 0 && kind == jsonChunk) {
            parts.json = asText(bytes);
            hasJson = true;
        } else if (chunk == 1 && kind == binaryChunk) {
            parts.binary = bytes;
            parts.hasBinary = true;
        }
        offset += size;
    }
    if (!hasJson)
        fail(ErrorKind::input, "{}: the first chunk is not JSON", place);
    return parts;
}

} // namespace

GltfParts splitGltf(std::span<const std::byte> file, const std::string& place)
{
    if (file.size() >= 4 && readWord(file, 0) == glbMagic)
        return splitGlb(file, place);
    if (file.empty())
        fail(ErrorKind::input, "{}: empty", place);
    return {.json = asText(file), .binary = {}, .hasBinary = false};
}

std::vector<unsigned char> joinGlb(std::string_view json, std::span<const std::byte> binary)
{
    const std::size_t jsonSize = (json.size() + 3) / 4 * 4;
    const std::size_t binarySize = (binary.size() + 3) / 4 * 4;
    const std::size_t total = headerSize + chunkHeaderSize + jsonSize +
                              (binary.empty() ? 0 : chunkHeaderSize + binarySize);
    std::vector<unsigned char> file;
    file.reserve(total);
    writeWord(file, glbMagic);
    writeWord(file, 2);
    writeWord(file, total);
    writeWord(file, jsonSize);
    writeWord(file, jsonChunk);
    file.insert(file.end(), json.begin(), json.end());
    file.resize(headerSize + chunkHeaderSize + jsonSize, ' ');
    if (!binary.empty()) {
        writeWord(file, binarySize);
        writeWord(file, binaryChunk);
        const auto* const bytes = reinterpret_cast<const unsigned char*>(binary.data());
        file.insert(file.end(), bytes, bytes + binary.size());
        file.resize(total, 0);
    }
    return file;
}

} // namespace sward::terrain
