#include "terrain/gltf_files.h"

#include "core/error.h"
#include "core/mapped_file.h"
#include "terrain/gltf_check.h"
#include "terrain/gltf_container.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace sward::terrain {
namespace {

// What tinygltf asks of the disk while it parses.
struct Neighbours {
    std::string folder;  // every file that a glTF names lies in or below it, as far as we look
    std::string missing; // the last one that could not be read, and why

    static bool exists(const std::string& file, void* self)
    {
        auto& own = *static_cast<Neighbours*>(self);
        // tinygltf would look into the current folder, too.
        if (file.substr(0, own.folder.size()) != own.folder)
            return false;
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error) &&
            std::filesystem::file_size(file, error) > 0)
            return true;
        own.missing = file;
        return false;
    }

    static std::string expand(const std::string& file, void*) { return file; }

    static bool read(std::vector<unsigned char>* out, std::string* error, const std::string& file,
                     void* self)
    {
        try {
            const std::vector<std::byte> bytes = readFile(file);
            const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
            out->assign(first, first + bytes.size());
            return true;
        } catch (const Error& caught) {
            static_cast<Neighbours*>(self)->missing = file;
            *error += caught.what();
            return false;
        }
    }
};

// Keeps the encoded bytes: only what a material shows is decoded later.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*)
{
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

} // namespace

tinygltf::Model readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics)
{
    const std::string place = path.string();
    const MappedFile file(path);
    const GltfParts parts = splitGltf(file.bytes(), place);
    const std::string json = checkGltf(parts, place, diagnostics).dump();

    // tinygltf counts in 32 bits.
    const bool binary = parts.hasBinary && !parts.binary.empty();
    std::vector<unsigned char> glb;
    if (binary)
        glb = joinGlb(json, parts.binary);
    const std::size_t size = std::max(json.size(), glb.size());
    if (size > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::unsupported, "{}: {} bytes, more than a GLB can hold", place, size);

    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
    Neighbours neighbours{.folder = folder.string(), .missing = {}};
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncoded, nullptr);
    reader.SetFsCallbacks({.FileExists = Neighbours::exists,
                           .ExpandFilePath = Neighbours::expand,
                           .ReadWholeFile = Neighbours::read,
                           .WriteWholeFile = nullptr,
                           .user_data = &neighbours});

    tinygltf::Model model;
    std::string error;
    std::string warning;
    bool read = false;
    try {
        read =
            binary
                ? reader.LoadBinaryFromMemory(&model, &error, &warning, glb.data(),
                                              static_cast<unsigned>(glb.size()), neighbours.folder)
                : reader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                             static_cast<unsigned>(json.size()), neighbours.folder);
    } catch (const std::exception& caught) {
        fail(ErrorKind::input, "{}: {}", place, caught.what());
    }
    if (!read && error.find("File not found") != std::string::npos && !neighbours.missing.empty())
        fail(ErrorKind::io, "{}: the file {} that it names cannot be read", place,
             neighbours.missing);
    if (!read)
        fail(ErrorKind::input, "{}: {}", place, firstLine(error));
    return model;
}

} // namespace sward::terrain
