#pragma once

#include "core/mapped_file.h"
#include "terrain/gltf_container.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// The bytes of a glTF's buffers, where they lie: in the BIN chunk, in files beside it (mapped), in
/// data URIs (decoded), or made by a decoder.
class GltfBuffers {
public:
    GltfBuffers() = default;

    /// Opens every buffer of `document`. A buffer without bytes of its own is left empty: an
    /// extension makes them. Takes the texts of data URIs out of `document`. `parts` must outlive
    /// this. Throws Error{io} for a file that cannot be read, Error{input} naming the buffer,
    /// Error{unsupported} for more than gltfByteLimit.
    GltfBuffers(nlohmann::json& document, const GltfParts& parts,
                const std::filesystem::path& gltf);

    std::size_t count() const { return bytes_.size(); }
    std::span<const std::byte> bytes(std::size_t buffer) const { return bytes_.at(buffer); }

    /// Adds a buffer of a decoder's and returns its index.
    std::size_t add(std::vector<std::byte>&& bytes);

private:
    std::vector<std::span<const std::byte>> bytes_; // of each buffer
    std::vector<MappedFile> files_;
    std::vector<std::vector<std::byte>> own_;
};

/// All buffers of a file together [bytes].
inline constexpr std::uint64_t gltfByteLimit = std::uint64_t(4) << 30;

} // namespace sward::terrain
