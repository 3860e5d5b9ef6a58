#include "terrain/gltf/layout.h"

#include <nlohmann/json.hpp>

namespace sward::terrain {
namespace {

using nlohmann::json;

// An accessor without bytes is all zeros; more than this are a mistake or an attack.
constexpr std::uint64_t zeroLimit = 1U << 20;

constexpr std::uint64_t instanceLimit = 1U << 21; // of a node

// `count` elements of `size` bytes from `offset` on must end inside the view.
void requireInside(const GltfObject& o, std::uint64_t offset, std::uint64_t count,
                   std::uint64_t size, std::uint64_t view, const std::vector<GltfView>& views)
{
    if (views[view].emptyBuffer)
        o.failHere(
            "its bufferView {}: buffer {} has no uri and no BIN chunk, and nothing is decoded "
            "into it",
            view, *views[view].emptyBuffer);
    const std::uint64_t length = views[view].length;
    const std::uint64_t stride = views[view].stride == 0 ? size : views[view].stride;
    if (stride < size)
        o.failHere("its elements of {} bytes do not fit the byteStride {} of bufferView {}", size,
                   stride, view);
    // This order cannot overflow.
    if (size > length || offset > length - size || count - 1 > (length - size - offset) / stride)
        o.failHere("{} elements of {} bytes from byte {} on end behind bufferView {} of {} bytes",
                   count, size, offset, view, length);
}

json checkSparse(const GltfObject& o, std::uint64_t count, std::uint64_t elementSize,
                 const std::vector<GltfView>& views)
{
    const GltfObject sparse = o.part(*o.object("sparse"));
    const std::uint64_t changed = sparse.requiredCount("count", count + 1);
    if (changed == 0)
        o.failHere("sparse count is 0");
    json kept = sparse.keep({"count"});

    const auto checkPart = [&](const char* key, std::uint64_t size) {
        const json* const found = sparse.object(key);
        if (found == nullptr)
            o.failHere("sparse has no {}", key);
        const GltfObject part = o.part(*found);
        const std::uint64_t view = part.requiredCount("bufferView", views.size());
        if (views[view].stride != 0)
            o.failHere("sparse {} use a bufferView with a byteStride", key);
        requireInside(o, part.count("byteOffset").value_or(0), changed, size, view, views);
        kept[key] = part.keep({"bufferView", "byteOffset", "componentType"});
    };
    const json* const indices = sparse.object("indices");
    const std::uint64_t type =
        indices == nullptr ? 0 : o.part(*indices).requiredCount("componentType");
    if (type != 5121 && type != 5123 && type != 5125)
        o.failHere("sparse indices have component type {}", type);
    checkPart("indices", gltfComponentSize(type));
    checkPart("values", elementSize);
    return kept;
}

} // namespace

std::uint64_t gltfComponentCount(std::string_view type)
{
    constexpr std::pair<std::string_view, std::uint64_t> types[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3},  {"VEC4", 4},
        {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16},
    };
    for (const auto& [name, count] : types)
        if (name == type)
            return count;
    return 0;
}

std::uint64_t gltfComponentSize(std::uint64_t componentType)
{
    switch (componentType) {
    case 5120: // signed byte
    case 5121: // unsigned byte
        return 1;
    case 5122: // signed short
    case 5123: // unsigned short
        return 2;
    case 5125: // unsigned int
    case 5126: // float
        return 4;
    default:
        return 0;
    }
}

json checkAccessor(const GltfObject& o, const std::vector<GltfView>& views)
{
    const std::uint64_t type = o.requiredCount("componentType");
    const std::uint64_t componentSize = gltfComponentSize(type);
    if (componentSize == 0)
        o.failHere("component type {} is not known", type);
    o.text("type");
    const auto shape = o.value.value("type", std::string());
    const std::uint64_t elementSize = componentSize * gltfComponentCount(shape);
    if (elementSize == 0)
        o.failHere("type \"{}\" is not known", shape);
    const std::uint64_t count = o.requiredCount("count", 1ULL << 32);
    if (count == 0)
        o.failHere("count is 0");
    o.truth("normalized");

    const std::uint64_t offset = o.count("byteOffset").value_or(0);
    if (const auto view = o.count("bufferView", views.size()))
        requireInside(o, offset, count, elementSize, *view, views);
    else if (count > zeroLimit)
        o.failHere("{} elements, but no bufferView", count);

    json kept =
        o.keep({"componentType", "type", "count", "normalized", "byteOffset", "bufferView"});
    if (o.object("sparse") != nullptr)
        kept["sparse"] = checkSparse(o, count, elementSize, views);
    return kept;
}

json checkMaterial(const GltfObject& o, std::size_t textures)
{
    o.text("name");
    o.truth("doubleSided");
    o.text("alphaMode");
    o.number("alphaCutoff");
    json kept = o.keep({"name", "doubleSided", "alphaMode", "alphaCutoff"});
    const json* const found = o.object("pbrMetallicRoughness");
    if (found == nullptr)
        return kept;
    const GltfObject surface = o.part(*found);
    surface.numbers("baseColorFactor", 4);
    surface.number("roughnessFactor");
    surface.number("metallicFactor");
    json& keptSurface = kept["pbrMetallicRoughness"];
    keptSurface = surface.keep({"baseColorFactor", "roughnessFactor", "metallicFactor"});

    const json* const image = surface.object("baseColorTexture");
    if (image == nullptr)
        return kept;
    const GltfObject reference = o.part(*image);
    reference.requiredCount("index", textures);
    reference.count("texCoord", 16);
    json& keptImage = keptSurface["baseColorTexture"];
    keptImage = reference.keep({"index", "texCoord"});

    constexpr const char* moved = "KHR_texture_transform";
    if (const json* const extensions = reference.object("extensions"))
        if (const json* const move = o.part(*extensions).object(moved)) {
            const GltfObject m = o.part(*move);
            m.numbers("offset", 2);
            m.numbers("scale", 2);
            m.number("rotation");
            m.count("texCoord", 16);
            keptImage["extensions"][moved] = m.keep({"offset", "scale", "rotation", "texCoord"});
        }
    return kept;
}

void keepVisibility(const GltfObject& node, std::size_t nodes, json& kept)
{
    const json* const extensions = node.object("extensions");
    if (extensions == nullptr)
        return;
    if (const json* const shown = node.part(*extensions).object("KHR_node_visibility")) {
        node.part(*shown).truth("visible");
        kept["extensions"]["KHR_node_visibility"] = node.part(*shown).keep({"visible"});
    }
    if (const json* const levels = node.part(*extensions).object("MSFT_lod")) {
        node.part(*levels).indices("ids", nodes);
        if (levels->contains("ids") && !(*levels)["ids"].empty())
            kept["extensions"]["MSFT_lod"] = node.part(*levels).keep({"ids"});
    }
}

void keepInstancing(const GltfObject& node, const std::vector<std::uint64_t>& accessorCounts,
                    json& kept)
{
    constexpr const char* name = "EXT_mesh_gpu_instancing";
    const json* const extensions = node.object("extensions");
    if (extensions == nullptr)
        return;
    const json* const instancing = node.part(*extensions).object(name);
    if (instancing == nullptr)
        return;
    const json* const attributes = node.part(*instancing).object("attributes");
    if (attributes == nullptr)
        node.failHere("{} has no attributes", name);

    // All attributes describe the same number of instances.
    json& keptAttributes = kept["extensions"][name]["attributes"];
    std::uint64_t instances = 0;
    for (const auto& [key, unused] : attributes->items())
        if (const auto accessor =
                node.part(*attributes).count(key.c_str(), accessorCounts.size())) {
            const std::uint64_t count = accessorCounts[*accessor];
            if (instances != 0 && count != instances)
                node.failHere("{} has {} for {} instances", name, count, instances);
            instances = count;
            if (instances > instanceLimit)
                node.failHere("{} of {} instances, more than {}", name, instances, instanceLimit);
            keptAttributes[key] = *accessor;
        }
    if (instances == 0)
        node.failHere("{} names no attribute", name);
}

} // namespace sward::terrain
