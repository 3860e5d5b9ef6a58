#include "terrain/gltf_extensions.h"

#include "terrain/gltf_json.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

// Applied in full.
constexpr std::array<std::string_view, 3> applied = {
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
};

// They change nothing of a ground that stands still; neither do those named KHR_materials_….
constexpr std::array<std::string_view, 4> harmless = {
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "EXT_lights_image_based",
};

// Textures in other formats: the material is kept, its image is not.
constexpr std::array<std::string_view, 4> imageFormats = {"EXT_texture_webp", "EXT_texture_avif",
                                                          "KHR_texture_basisu", "MSFT_texture_dds"};

template <typename List>
bool contains(const List& list, std::string_view name)
{
    return std::find(list.begin(), list.end(), name) != list.end();
}

bool isMaterialExtension(std::string_view name)
{
    return name.substr(0, 14) == "KHR_materials_";
}

std::vector<std::string> namesUnder(const nlohmann::json& document, const char* key,
                                    const std::string& place)
{
    std::vector<std::string> names;
    const auto found = document.find(key);
    if (found == document.end())
        return names;
    if (!found->is_array())
        fail(ErrorKind::input, "{}: {} is not an array", place, key);
    for (const nlohmann::json& name : *found) {
        if (!name.is_string())
            fail(ErrorKind::input, "{}: {} holds something that is not a name", place, key);
        names.push_back(name.get<std::string>());
    }
    return names;
}

bool hasExtension(const nlohmann::json& object, const char* name)
{
    if (!object.is_object())
        return false;
    const auto extensions = object.find("extensions");
    return extensions != object.end() && extensions->is_object() && extensions->contains(name);
}

// The entries of an array of the document; none if it is missing or something else.
const nlohmann::json& entries(const nlohmann::json& object, const char* key)
{
    static const nlohmann::json none = nlohmann::json::array();
    if (!object.is_object())
        return none;
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : none;
}

// A compressed buffer view may name a plain copy of its bytes; without one there is nothing to
// read.
void refuseMeshopt(const nlohmann::json& document, const char* name, const std::string& place)
{
    const nlohmann::json& buffers = entries(document, "buffers");
    for (const nlohmann::json& view : entries(document, "bufferViews")) {
        if (!hasExtension(view, name))
            continue;
        const auto buffer = view.find("buffer");
        const bool inRange = buffer != view.end() && buffer->is_number_unsigned() &&
                             buffer->get<std::uint64_t>() < buffers.size();
        const bool plain = inRange && buffers[buffer->get<std::size_t>()].is_object() &&
                           buffers[buffer->get<std::size_t>()].contains("uri");
        if (!plain)
            fail(ErrorKind::unsupported,
                 "{}: its meshes are compressed with {}, which is not supported; export it "
                 "uncompressed",
                 place, name);
    }
}

void refuseDraco(const nlohmann::json& document, const std::string& place)
{
    constexpr const char* name = "KHR_draco_mesh_compression";
    const nlohmann::json& accessors = entries(document, "accessors");
    const auto isPlain = [&](const nlohmann::json& index) {
        return index.is_number_unsigned() && index.get<std::uint64_t>() < accessors.size() &&
               accessors[index.get<std::size_t>()].is_object() &&
               accessors[index.get<std::size_t>()].contains("bufferView");
    };
    for (const nlohmann::json& mesh : entries(document, "meshes"))
        for (const nlohmann::json& primitive : entries(mesh, "primitives")) {
            if (!hasExtension(primitive, name))
                continue;
            const auto attributes = primitive.find("attributes");
            const bool plain = attributes != primitive.end() && attributes->is_object() &&
                               attributes->contains("POSITION") &&
                               isPlain((*attributes)["POSITION"]);
            if (!plain)
                fail(ErrorKind::unsupported,
                     "{}: its meshes are compressed with {}, which is not supported; export it "
                     "uncompressed",
                     place, name);
        }
}

} // namespace

void checkGltfExtensions(const nlohmann::json& document, const std::string& place,
                         Diagnostics& diagnostics)
{
    for (const std::string& name : namesUnder(document, "extensionsRequired", place))
        if (!contains(applied, name) && !contains(harmless, name) &&
            !contains(imageFormats, name) && !isMaterialExtension(name))
            fail(ErrorKind::unsupported,
                 "{}: requires the glTF extension {}, which is not supported; supported are {}",
                 place, name, fmt::join(applied, ", "));

    refuseMeshopt(document, "EXT_meshopt_compression", place);
    refuseMeshopt(document, "KHR_meshopt_compression", place);
    refuseDraco(document, place);

    for (const std::string& name : namesUnder(document, "extensionsUsed", place)) {
        if (contains(imageFormats, name))
            diagnostics.warn("{}: textures of {} are not read; their materials are drawn without",
                             place, name);
        else if (name == "KHR_materials_pbrSpecularGlossiness")
            diagnostics.warn("{}: the colours of {} are not read", place, name);
    }
}

} // namespace sward::terrain
