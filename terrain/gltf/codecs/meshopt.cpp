#include "terrain/gltf/codecs/meshopt.h"

#include "terrain/gltf/codecs/meshopt_filters.h"
#include "terrain/gltf/file/json.h"

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace sward::terrain {
namespace {

using nlohmann::json;

// Most decoded bytes of all views of a file [bytes].
constexpr std::uint64_t decodedLimit = std::uint64_t(2) << 30;

// Most decoded bytes per compressed byte. 256 bytes that stay equal between elements need 4 bytes
// in an attribute stream; three indices need one in a triangle stream.
constexpr std::uint64_t attributeGain = 64;

// First byte of a stream: format and version.
constexpr unsigned attributeStream = 0xa0;
constexpr unsigned triangleStream = 0xe0;
constexpr unsigned indexStream = 0xd0;
constexpr unsigned versionBits = 0x0f;

struct Stream {
    const GltfObject& view;
    std::string_view name;
    std::string mode;
    std::string filter;
    std::uint64_t count = 0;
    std::uint64_t stride = 0; // [bytes]
    std::span<const std::byte> bytes;
};

Stream streamOf(const GltfObject& view, const json& extension, std::string_view name,
                const GltfBuffers& buffers)
{
    const GltfObject o = view.part(extension);
    Stream stream{.view = view, .name = name, .mode = {}, .filter = {}, .bytes = {}};
    o.text("mode");
    o.text("filter");
    stream.mode = extension.value("mode", "");
    stream.filter = extension.value("filter", "NONE");
    stream.count = o.requiredCount("count", std::uint64_t(1) << 32);
    stream.stride = o.requiredCount("byteStride", 257);
    const std::uint64_t buffer = o.requiredCount("buffer", buffers.count());
    const std::uint64_t offset = o.count("byteOffset").value_or(0);
    const std::uint64_t length = o.requiredCount("byteLength");
    const auto bytes = buffers.bytes(buffer);
    if (length == 0)
        view.failHere("{}: byteLength is 0: a view has one byte or more", name);
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.failHere("{}: {} bytes from byte {} on are not inside buffer {} of {} bytes", name,
                      length, offset, buffer, bytes.size());
    stream.bytes = bytes.subspan(offset, length);

    if (stream.count == 0 || stream.stride == 0)
        view.failHere("{}: {} elements of {} bytes", name, stream.count, stream.stride);
    if (view.requiredCount("byteLength") != stream.count * stream.stride)
        view.failHere("{}: {} elements of {} bytes do not make its byteLength {}", name,
                      stream.count, stream.stride, view.requiredCount("byteLength"));
    if (const auto stride = view.count("byteStride"); stride && *stride != stream.stride)
        view.failHere("{}: byteStride is {} here and {} there", name, stream.stride, *stride);
    return stream;
}

// Checks that the first byte names the format, in a known version.
void requireFormat(const Stream& s, unsigned format, unsigned newest)
{
    const auto first = std::to_integer<unsigned>(s.bytes[0]);
    if ((first & ~versionBits) != format)
        s.view.failHere("{}: its bytes do not begin like mode {}", s.name, s.mode);
    if ((first & versionBits) > newest)
        fail(ErrorKind::unsupported,
             "{}: bufferView {}: {}: version {} of the codec of mode {} is not supported; versions "
             "up to {} are",
             s.view.file, s.view.index, s.name, first & versionBits, s.mode, newest);
}

void requireFilter(const Stream& s)
{
    const std::uint64_t stride = s.stride;
    if (s.filter == "OCTAHEDRAL"   ? stride == 4 || stride == 8
        : s.filter == "QUATERNION" ? stride == 8
                                   : s.filter == "EXPONENTIAL" || s.filter == "NONE")
        return;
    if (s.filter == "COLOR")
        fail(ErrorKind::unsupported, "{}: bufferView {}: {}: filter COLOR is not supported",
             s.view.file, s.view.index, s.name);
    s.view.failHere("{}: filter {} with elements of {} bytes", s.name, s.filter.substr(0, 16),
                    stride);
}

// Checks the stream's declarations before memory is allocated.
void check(const Stream& s)
{
    const std::uint64_t size = s.bytes.size();
    if (s.mode == "ATTRIBUTES") {
        requireFormat(s, attributeStream, 0);
        requireFilter(s);
        if (s.stride % 4 != 0)
            s.view.failHere("{}: byteStride is {}, not a multiple of 4", s.name, s.stride);
        if (s.count * s.stride > attributeGain * size)
            s.view.failHere("{}: {} bytes cannot hold {} elements of {} bytes", s.name, size,
                            s.count, s.stride);
        return;
    }
    const bool isTriangles = s.mode == "TRIANGLES";
    if (!isTriangles && s.mode != "INDICES")
        s.view.failHere("{}: mode \"{}\" is not known", s.name, s.mode.substr(0, 16));
    requireFormat(s, isTriangles ? triangleStream : indexStream, 1);
    if (s.filter != "NONE")
        s.view.failHere("{}: a filter in mode {}", s.name, s.mode);
    if (s.stride != 2 && s.stride != 4)
        s.view.failHere("{}: byteStride is {}, neither 2 nor 4", s.name, s.stride);
    if (isTriangles && s.count % 3 != 0)
        s.view.failHere("{}: {} indices do not make triangles", s.name, s.count);
    if ((isTriangles ? s.count / 3 : s.count) > size)
        s.view.failHere("{}: {} bytes cannot hold {} indices", s.name, size, s.count);
}

std::vector<std::byte> decode(const Stream& s)
{
    std::vector<std::byte> decoded(s.count * s.stride);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(s.bytes.data());
    int damage = 0;
    if (s.mode == "ATTRIBUTES")
        damage =
            meshopt_decodeVertexBuffer(decoded.data(), s.count, s.stride, bytes, s.bytes.size());
    else if (s.mode == "TRIANGLES")
        damage =
            meshopt_decodeIndexBuffer(decoded.data(), s.count, s.stride, bytes, s.bytes.size());
    else
        damage =
            meshopt_decodeIndexSequence(decoded.data(), s.count, s.stride, bytes, s.bytes.size());
    if (damage != 0)
        s.view.failHere("{}: its {} bytes are damaged (mode {}, code {})", s.name, s.bytes.size(),
                        s.mode, damage);

    if (s.filter == "OCTAHEDRAL")
        decodeOctahedral(decoded, s.stride);
    else if (s.filter == "QUATERNION")
        decodeQuaternions(decoded);
    else if (s.filter == "EXPONENTIAL")
        decodeExponential(decoded);
    return decoded;
}

} // namespace

void decompressMeshopt(json& document, GltfBuffers& buffers, const std::string& place)
{
    const auto views = document.find("bufferViews");
    if (views == document.end() || !views->is_array())
        return;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < views->size(); ++i) {
        json& entry = (*views)[i];
        if (!entry.is_object() || !entry.contains("extensions"))
            continue;
        const GltfObject view{entry, place, "bufferView", i};
        const json& extensions = *view.object("extensions");
        for (const std::string_view name : meshoptNames) {
            const json* const extension = view.part(extensions).object(std::string(name).c_str());
            if (extension == nullptr)
                continue;
            const Stream stream = streamOf(view, *extension, name, buffers);
            check(stream);
            total += stream.count * stream.stride;
            if (total > decodedLimit)
                view.failHere("{}: more than {} bytes of decoded views", name, decodedLimit);
            entry["buffer"] = buffers.add(decode(stream));
            entry["byteOffset"] = 0U;
            break;
        }
        entry.erase("extensions");
    }
}

} // namespace sward::terrain
