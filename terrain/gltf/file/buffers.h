#pragma once

#include "core/diagnostics.h"
#include "core/files/mapped_file.h"
#include "terrain/gltf/file/container.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// The bytes of a glTF's buffers: in the BIN chunk, in separate files (mapped), in data URIs
/// (decoded), or made by a decoder.
class GltfBuffers {
public:
    GltfBuffers() = default;

    /// Opens every buffer of `document`. A buffer without bytes stays empty: an extension creates
    /// them. Moves the texts of data URIs out of `document`. Warns where a file of nearly that name
    /// is taken. `parts` must outlive this. Throws Error{io} for an unreadable file, Error{input}
    /// naming the buffer, Error{unsupported} above gltfByteLimit.
    GltfBuffers(nlohmann::json& document, const GltfParts& parts, const std::filesystem::path& gltf,
                Diagnostics& diagnostics);

    std::size_t count() const { return bytes_.size(); }
    std::span<const std::byte> bytes(std::size_t buffer) const { return bytes_.at(buffer); }

    /// Adds a decoded buffer and returns its index.
    std::size_t add(std::vector<std::byte>&& bytes);

private:
    std::vector<std::span<const std::byte>> bytes_; // of each buffer
    std::vector<MappedFile> files_;
    std::vector<std::vector<std::byte>> own_;
};

/// All buffers of a file together [bytes].
inline constexpr std::uint64_t gltfByteLimit = std::uint64_t(4) << 30;

} // namespace sward::terrain
