#include "core/expect.h"
#include "core/files/mapped_file.h"
#include "terrain/image/channel_image.h"
#include "terrain/load.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

namespace sward::terrain {
namespace {

// XXH3 over a sequence of arrays. Hashes the length of each array first, so that borders count too.
class Hasher {
public:
    Hasher() { expect(XXH3_64bits_reset(state_) == XXH_OK, "XXH3 does not start"); }
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;
    ~Hasher() { XXH3_freeState(state_); }

    template <typename Value>
    void add(std::span<const Value> values)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        const std::uint64_t length = values.size();
        XXH3_64bits_update(state_, &length, sizeof length);
        if (!values.empty())
            XXH3_64bits_update(state_, values.data(), values.size_bytes());
    }

    template <typename Value>
    void add(const std::vector<Value>& values)
    {
        add(std::span<const Value>(values));
    }

    void add(double value) { add(std::span<const double>(&value, 1)); }

    std::uint64_t digest() const { return XXH3_64bits_digest(state_); }

private:
    XXH3_state_t* state_ = XXH3_createState();
};

// The material properties that affect blades: the colour.
void addAppearance(const GroundMesh& mesh, Hasher& hasher)
{
    for (const GroundMaterial& material : mesh.materials) {
        for (glm::length_t channel = 0; channel < 4; ++channel)
            hasher.add(static_cast<double>(material.baseColor[channel]));
        hasher.add(static_cast<double>(material.image));
        hasher.add(material.doubleSided ? 1.0 : 0.0);
        hasher.add(static_cast<double>(material.wrapU));
        hasher.add(static_cast<double>(material.wrapV));
        // What most grounds do not have leaves their hashes as they are.
        if (material.alphaCutoff > 0.0f)
            hasher.add(static_cast<double>(material.alphaCutoff));
        if (material.srgbColors)
            hasher.add(1.0);
    }
    for (const GroundImage& image : mesh.images) {
        hasher.add(static_cast<double>(image.width));
        hasher.add(image.rgba);
        for (const auto& channel : image.stored)
            if (channel != nullptr)
                hasher.add(channel->values);
    }
}

} // namespace

std::string contentHash(const GroundMesh& mesh)
{
    Hasher hasher;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        hasher.add(mesh.origin[axis]);
    hasher.add(mesh.positions);
    hasher.add(mesh.normals);
    hasher.add(mesh.uvs);
    hasher.add(mesh.colors);
    for (const VertexAttribute& one : mesh.attributes.list)
        hasher.add(one.values);
    hasher.add(mesh.triangles);
    hasher.add(mesh.materialOf);
    hasher.add(mesh.bears);
    addAppearance(mesh, hasher);
    return fmt::format("{:016x}", hasher.digest());
}

std::string mapFileHash(const std::filesystem::path& path)
{
    constexpr std::uint64_t wholeBytes = std::uint64_t(256) << 20;
    constexpr std::uint64_t pieces = 256;
    constexpr std::uint64_t pieceBytes = wholeBytes / pieces;
    std::vector<std::filesystem::path> files{path};
    for (const char* const extension : {".shx", ".dbf", ".prj", ".cpg", ".tfw", ".wld"})
        files.push_back(std::filesystem::path(path).replace_extension(extension));
    for (const char* const end : {".ovr", ".msk", ".aux.xml"})
        files.emplace_back(path.string() + end);
    Hasher hasher;
    for (std::size_t i = 0; i < files.size(); ++i) {
        std::error_code ignored;
        if (i > 0 && !std::filesystem::is_regular_file(files[i], ignored))
            continue;
        const MappedFile file(files[i]);
        const std::span<const std::byte> bytes = file.bytes();
        hasher.add(double(i));
        if (bytes.size() <= wholeBytes) {
            hasher.add(bytes);
            continue;
        }
        hasher.add(double(bytes.size()));
        for (std::uint64_t piece = 0; piece < pieces; ++piece)
            hasher.add(
                bytes.subspan((bytes.size() - pieceBytes) * piece / (pieces - 1), pieceBytes));
    }
    return fmt::format("{:016x}", hasher.digest());
}

std::uint64_t appearanceHash(const GroundMesh& mesh)
{
    Hasher hasher;
    addAppearance(mesh, hasher);
    return hasher.digest();
}

} // namespace sward::terrain
