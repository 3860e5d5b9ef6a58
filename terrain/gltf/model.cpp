#include "terrain/gltf/model.h"

#include "core/error.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"
#include "terrain/gltf/codecs/draco.h"
#include "terrain/gltf/codecs/meshopt.h"
#include "terrain/gltf/file/check.h"
#include "terrain/gltf/file/container.h"
#include "terrain/gltf/file/extensions.h"
#include "terrain/gltf/file/layout.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>

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

// glTF 1.0 keeps its objects under names, not in arrays. Its early files have no version.
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
        isVersion1 = text.starts_with("1");
    }
    if (isVersion1)
        fail(ErrorKind::unsupported,
             "{}: glTF version 1; only 2.0 is read: convert it with gltf-pipeline or export it "
             "anew",
             place);
}

// glTF 2.0, 3.6.2.3: sparse indices rise strictly. The last value of an element counts, as it is
// written last.
void warnOfSparseOrder(const GltfModel& model, const std::string& place, Diagnostics& diagnostics)
{
    for (std::size_t i = 0; i < model.structure.accessors.size(); ++i) {
        const auto& sparse = model.structure.accessors[i].sparse;
        if (!sparse)
            continue;
        const std::uint64_t size = gltfComponentSize(sparse->indexType);
        const auto bytes = model.view(static_cast<std::size_t>(sparse->indexView))
                               .subspan(sparse->indexOffset, sparse->count * size);
        std::int64_t before = -1;
        for (std::uint64_t entry = 0; entry < sparse->count; ++entry) {
            std::uint32_t index = 0; // little-endian, as the machine
            std::memcpy(&index, bytes.data() + entry * size, size);
            if (std::int64_t(index) <= before) {
                diagnostics.warn("{}: accessor {}: its sparse indices do not rise, entry {} names "
                                 "element {} after {}; the last value of an element counts",
                                 place, i, entry, index, before);
                break;
            }
            before = index;
        }
    }
}

} // namespace

std::span<const std::byte> GltfModel::view(std::size_t index) const
{
    const GltfView& own = structure.views.at(index);
    const auto bytes = buffers.bytes(own.buffer);
    if (own.offset > bytes.size() || own.length > bytes.size() - own.offset)
        fail(ErrorKind::input, "{}: bufferView {} ends behind buffer {}", path.string(), index,
             own.buffer);
    return bytes.subspan(own.offset, own.length);
}

GltfModel readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics)
{
    const std::string place = path.string();
    GltfModel model{.path = path, .structure = {}, .buffers = {}, .file = MappedFile(path)};
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
    model.buffers = GltfBuffers(document, parts, path, diagnostics);
    decompressMeshopt(document, model.buffers, place);
    decompressDraco(document, model.buffers, place);
    model.structure = checkGltf(document, model.buffers, place, diagnostics);
    warnOfSparseOrder(model, place, diagnostics);
    model.size = parts.json.size();
    for (std::size_t i = 0; i < model.buffers.count(); ++i)
        model.size += model.buffers.bytes(i).size();
    return model;
}

} // namespace sward::terrain
