#include "terrain/gltf/file/buffers.h"

#include "terrain/files/near_file.h"
#include "terrain/gltf/file/json.h"
#include "terrain/gltf/file/uri.h"

#include <nlohmann/json.hpp>

namespace sward::terrain {
namespace {

// Cuts the bytes to the document's length; a file may be longer.
std::span<const std::byte> take(std::span<const std::byte> bytes, std::uint64_t length,
                                const GltfObject& buffer, const std::string& source)
{
    if (length > bytes.size())
        buffer.failHere("byteLength is {}, but {} has {} bytes", length, source, bytes.size());
    return bytes.first(length);
}

} // namespace

GltfBuffers::GltfBuffers(nlohmann::json& document, const GltfParts& parts,
                         const std::filesystem::path& gltf, Diagnostics& diagnostics)
{
    const std::string place = gltf.string();
    const auto found = document.find("buffers");
    if (found == document.end())
        return;
    if (!found->is_array())
        fail(ErrorKind::input, "{}: buffers is not an array", place);

    std::uint64_t total = 0;
    for (std::size_t i = 0; i < found->size(); ++i) {
        nlohmann::json& entry = (*found)[i];
        if (!entry.is_object())
            fail(ErrorKind::input, "{}: buffer {} is not an object", place, i);
        const GltfObject buffer{entry, place, "buffer", i};
        const std::uint64_t length = buffer.requiredCount("byteLength");
        if (length == 0)
            buffer.failHere("byteLength is 0");
        buffer.text("uri");

        std::span<const std::byte> bytes;
        if (buffer.find("uri") == nullptr) {
            if (i == 0 && parts.hasBinary)
                bytes = take(parts.binary, length, buffer, "the BIN chunk");
        } else {
            auto& uri = entry["uri"].get_ref<std::string&>();
            if (isDataUri(uri)) {
                auto decoded = decodeDataUri(uri);
                if (!decoded)
                    buffer.failHere("its data URI is damaged");
                own_.push_back(std::move(*decoded));
                bytes = take(own_.back(), length, buffer, "its data URI");
                uri = "data:";
                uri.shrink_to_fit();
            } else if (isOnNetwork(uri)) {
                fail(ErrorKind::io,
                     "{}: buffer {} is on the network: {}; nothing is fetched: save it beside the "
                     "file and name it there",
                     place, i, uri);
            } else {
                const std::filesystem::path file =
                    fileBeside(gltf, uri, buffer.name(), diagnostics);
                std::error_code error;
                if (!std::filesystem::is_regular_file(file, error))
                    fail(ErrorKind::io, "{}: the file {} that buffer {} names is not there{}",
                         place, file.string(), i, nearFileHint(file));
                files_.emplace_back(file);
                bytes = take(files_.back().bytes(), length, buffer, file.string());
            }
        }
        total += bytes.size();
        if (total > gltfByteLimit)
            fail(ErrorKind::unsupported, "{}: buffer {}: more than {} bytes of buffers", place, i,
                 gltfByteLimit);
        bytes_.push_back(bytes);
    }
}

std::size_t GltfBuffers::add(std::vector<std::byte>&& bytes)
{
    own_.push_back(std::move(bytes));
    bytes_.emplace_back(own_.back());
    return bytes_.size() - 1;
}

} // namespace sward::terrain
