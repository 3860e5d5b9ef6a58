#include "terrain/gltf/model.h"

#include "core/error.h"
#include "core/json_text.h"
#include "core/settings_json.h"
#include "terrain/gltf/check.h"
#include "terrain/gltf/container.h"
#include "terrain/gltf/draco.h"
#include "terrain/gltf/extensions.h"
#include "terrain/gltf/meshopt.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace sward::terrain {
namespace {

// JSON of a .gltf with all data in data URIs; larger data belongs into a .glb.
constexpr std::size_t jsonLimit = std::size_t(512) << 20; // [bytes]

// JSON writers of some languages print whole numbers as 5.0; JSON knows one kind of number. −0.0
// stays, for its sign.
void makeWholeNumbers(nlohmann::json& value)
{
    constexpr double limit = 0x1p53;
    if (value.is_structured()) {
        for (nlohmann::json& part : value)
            makeWholeNumbers(part);
        return;
    }
    if (!value.is_number_float())
        return;
    const auto number = value.get<double>();
    if (!(std::fabs(number) < limit) || number != std::floor(number) ||
        (number == 0.0 && std::signbit(number)))
        return;
    if (number >= 0.0)
        value = static_cast<std::uint64_t>(number);
    else
        value = static_cast<std::int64_t>(number);
}

// glTF 1.0 keeps its objects under names, not in arrays.
void refuseVersion1(const nlohmann::json& document, const std::string& place)
{
    bool isVersion1 = false;
    for (const char* const key : {"meshes", "accessors", "bufferViews", "buffers", "nodes"})
        if (const auto found = document.find(key); found != document.end())
            isVersion1 = isVersion1 || found->is_object();
    if (const auto asset = document.find("asset");
        asset != document.end() && asset->is_object() && asset->contains("version")) {
        const nlohmann::json& version = (*asset)["version"];
        const std::string text =
            version.is_string() ? version.get<std::string>() : jsonText(version);
        isVersion1 = isVersion1 || text.starts_with("1");
    }
    if (isVersion1)
        fail(ErrorKind::unsupported,
             "{}: glTF version 1; only 2.0 is read: convert it with gltf-pipeline or export it "
             "anew",
             place);
}

// tinygltf wants bytes behind indices, where zeros or sparse values may stand: it gets bufferView 0
// until it has parsed. Returns the accessors without one.
std::vector<std::size_t> lendViews(nlohmann::json& document)
{
    std::vector<std::size_t> lent;
    if (!document.contains("accessors") || !document.contains("bufferViews"))
        return lent;
    nlohmann::json& accessors = document["accessors"];
    for (std::size_t i = 0; i < accessors.size(); ++i)
        if (!accessors[i].contains("bufferView")) {
            accessors[i]["bufferView"] = 0;
            lent.push_back(i);
        }
    return lent;
}

ImageWrap wrapOf(int mode)
{
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE)
        return ImageWrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? ImageWrap::mirror : ImageWrap::repeat;
}

// The images of a document that has been checked.
std::vector<GltfImage> takeImages(nlohmann::json& document)
{
    std::vector<GltfImage> images;
    for (nlohmann::json& entry : document.value("images", nlohmann::json::array())) {
        GltfImage image;
        image.name = entry.value("name", "");
        image.uri = entry.value("uri", "");
        if (entry.contains("bufferView"))
            image.view = entry["bufferView"].get<std::size_t>();
        images.push_back(std::move(image));
    }
    document.erase("images");
    return images;
}

// Reads each texture's wrap modes and removes samplers. Debian's tinygltf.so and its header
// disagree on a sampler's size, so tinygltf must not see one.
std::vector<GltfWrap> takeWraps(nlohmann::json& document)
{
    const nlohmann::json samplers = document.value("samplers", nlohmann::json::array());
    std::vector<GltfWrap> wraps;
    if (document.contains("textures"))
        for (nlohmann::json& texture : document["textures"]) {
            GltfWrap wrap;
            if (texture.contains("sampler")) {
                const nlohmann::json& sampler = samplers[texture["sampler"].get<std::size_t>()];
                wrap.u = wrapOf(sampler.value("wrapS", 0));
                wrap.v = wrapOf(sampler.value("wrapT", 0));
                texture.erase("sampler");
            }
            wraps.push_back(wrap);
        }
    document.erase("samplers");
    return wraps;
}

// tinygltf requires bytes for each buffer: give it one.
void emptyBuffers(nlohmann::json& document)
{
    if (document.contains("buffers"))
        for (nlohmann::json& buffer : document["buffers"])
            buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
}

std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

tinygltf::Model parseStructure(const std::string& text, const std::string& place)
{
    if (text.size() > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::unsupported, "{}: {} bytes of JSON", place, text.size());
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    bool read = false;
    try {
        read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                          static_cast<unsigned>(text.size()), "");
    } catch (const std::exception& caught) {
        fail(ErrorKind::input, "{}: {}", place, caught.what());
    }
    if (!read)
        fail(ErrorKind::input, "{}: {}", place, firstLine(error));
    return model;
}

// An element dropped by tinygltf would shift the following indices.
void requireSame(const nlohmann::json& document, const char* key, std::size_t count,
                 const std::string& place)
{
    const auto found = document.find(key);
    const std::size_t expected = found == document.end() ? 0 : found->size();
    if (count != expected)
        fail(ErrorKind::input, "{}: {} of {} {} could be read", place, count, expected, key);
}

} // namespace

std::span<const std::byte> GltfModel::view(std::size_t index) const
{
    const tinygltf::BufferView& view = structure.bufferViews.at(index);
    const auto bytes = buffers.bytes(static_cast<std::size_t>(view.buffer));
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        fail(ErrorKind::input, "{}: bufferView {} ends behind buffer {}", path.string(), index,
             view.buffer);
    return bytes.subspan(view.byteOffset, view.byteLength);
}

GltfModel readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics)
{
    const std::string place = path.string();
    GltfModel model{.path = path,
                    .structure = {},
                    .buffers = {},
                    .images = {},
                    .wraps = {},
                    .file = MappedFile(path)};
    const GltfParts parts = splitGltf(model.file.bytes(), place);
    if (parts.json.size() > jsonLimit)
        fail(ErrorKind::unsupported, "{}: {} bytes of JSON, more than {}; save it as .glb", place,
             parts.json.size(), jsonLimit);
    nlohmann::json document = parseJson(parts.json, place);
    if (!document.is_object())
        fail(ErrorKind::input, "{}: its JSON is not an object", place);
    makeWholeNumbers(document);
    refuseVersion1(document, place);
    checkGltfExtensions(document, place, diagnostics);

    // Decompress first, then check everything.
    model.buffers = GltfBuffers(document, parts, path);
    decompressMeshopt(document, model.buffers, place);
    decompressDraco(document, model.buffers, place);
    document = checkGltf(document, model.buffers, place, diagnostics);

    model.images = takeImages(document);
    model.wraps = takeWraps(document);
    emptyBuffers(document);
    const std::vector<std::size_t> lent = lendViews(document);
    model.structure = parseStructure(jsonText(document), place);
    requireSame(document, "bufferViews", model.structure.bufferViews.size(), place);
    requireSame(document, "accessors", model.structure.accessors.size(), place);
    requireSame(document, "textures", model.structure.textures.size(), place);
    requireSame(document, "materials", model.structure.materials.size(), place);
    requireSame(document, "meshes", model.structure.meshes.size(), place);
    requireSame(document, "nodes", model.structure.nodes.size(), place);
    requireSame(document, "scenes", model.structure.scenes.size(), place);
    for (const std::size_t accessor : lent)
        model.structure.accessors.at(accessor).bufferView = -1;
    return model;
}

} // namespace sward::terrain
