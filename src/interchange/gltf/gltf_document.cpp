#include "interchange/gltf/gltf_document.h"

#include "core/expect.h"
#include "core/json/json_text.h"

#include <nlohmann/json.hpp>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

std::uint64_t aligned(std::uint64_t bytes)
{
    return (bytes + 3) / 4 * 4;
}

ordered_json arrayOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

} // namespace

GltfDocument::GltfDocument(const std::string& generator, const std::string& copyright)
    : json_(std::make_unique<ordered_json>())
{
    ordered_json asset = {{"version", "2.0"}, {"generator", generator}};
    if (!copyright.empty())
        asset["copyright"] = copyright;
    (*json_)["asset"] = std::move(asset);
}

GltfDocument::~GltfDocument() = default;

std::size_t GltfDocument::placeView(std::uint64_t bytes, int target)
{
    ordered_json view = {{"buffer", 0}, {"byteOffset", binaryBytes_}, {"byteLength", bytes}};
    if (target != 0)
        view["target"] = target;
    binaryBytes_ += aligned(bytes);
    return add("bufferViews", std::move(view));
}

std::size_t GltfDocument::addView(std::span<const std::byte> bytes, int target)
{
    expect(fixed_.size() == binaryBytes_, "known bytes come before reserved ones");
    fixed_.insert(fixed_.end(), bytes.begin(), bytes.end());
    fixed_.resize(aligned(fixed_.size()));
    return placeView(bytes.size(), target);
}

std::size_t GltfDocument::reserveView(std::uint64_t bytes)
{
    expect(bytes % 4 == 0, "reserved arrays follow one another without gaps");
    return placeView(bytes, 0);
}

std::size_t GltfDocument::reserveCompressedView(const CompressedView& view,
                                                const std::string& extension)
{
    const std::uint64_t decoded = view.count * view.stride;
    ordered_json compression = {{"buffer", 0},
                                {"byteOffset", binaryBytes_},
                                {"byteLength", view.stored},
                                {"byteStride", view.stride},
                                {"count", view.count},
                                {"mode", "ATTRIBUTES"}};
    if (view.filter != "NONE")
        compression["filter"] = view.filter;
    ordered_json entry = {{"buffer", 1},
                          {"byteOffset", decodedBytes_},
                          {"byteLength", decoded},
                          {"extensions", {{extension, std::move(compression)}}}};
    binaryBytes_ += aligned(view.stored);
    decodedBytes_ += aligned(decoded);
    compressionExtension_ = extension;
    return add("bufferViews", std::move(entry));
}

std::size_t GltfDocument::addAccessor(const GltfAccessor& accessor)
{
    ordered_json entry = {{"bufferView", accessor.view},
                          {"componentType", accessor.componentType},
                          {"count", accessor.count},
                          {"type", accessor.type}};
    if (accessor.offset != 0)
        entry["byteOffset"] = accessor.offset;
    if (accessor.normalized)
        entry["normalized"] = true;
    if (accessor.bounds) {
        entry["min"] = arrayOf(accessor.bounds->low);
        entry["max"] = arrayOf(accessor.bounds->high);
    }
    return add("accessors", std::move(entry));
}

std::size_t GltfDocument::add(const char* name, ordered_json element)
{
    ordered_json& list = (*json_)[name];
    list.push_back(std::move(element));
    return list.size() - 1;
}

void GltfDocument::require(const std::string& extension)
{
    add("extensionsUsed", extension);
    add("extensionsRequired", extension);
}

void GltfDocument::setScene(std::size_t node)
{
    (*json_)["scenes"] = ordered_json::array({{{"nodes", {node}}}});
    (*json_)["scene"] = 0;
}

std::string GltfDocument::text() const
{
    ordered_json whole = *json_;
    whole["buffers"] = ordered_json::array({{{"byteLength", binaryBytes_}}});
    if (decodedBytes_ > 0)
        whole["buffers"].push_back(
            {{"byteLength", decodedBytes_},
             {"extensions", {{compressionExtension_, {{"fallback", true}}}}}});
    std::string text = jsonText(whole);
    text.resize(aligned(text.size()), ' ');
    return text;
}

} // namespace sward::interchange
