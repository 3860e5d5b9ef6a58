#include "terrain/gltf/file/layout.h"

#include "core/math/exact_math.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace sward::terrain {
namespace {

using nlohmann::json;

constexpr std::uint64_t instanceLimit = 1U << 21; // of a node

// `count` elements of `size` bytes from `offset` on must end inside the view.
void requireInside(const GltfObject& o, std::uint64_t offset, std::uint64_t count,
                   std::uint64_t size, std::uint64_t view, const std::vector<GltfView>& views)
{
    if (views[view].isEmpty)
        o.failHere(
            "its bufferView {}: buffer {} has no uri and no BIN chunk, and nothing is decoded "
            "into it",
            view, views[view].buffer);
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

GltfSparse checkSparse(const GltfObject& o, std::uint64_t count, std::uint64_t elementSize,
                       const std::vector<GltfView>& views)
{
    const GltfObject sparse = o.part(*o.object("sparse"));
    GltfSparse kept;
    kept.count = sparse.requiredCount("count");
    if (kept.count == 0 || kept.count > count)
        o.failHere("sparse count is {} for {} elements", kept.count, count);

    const auto checkPart = [&](const char* key, std::uint64_t size, int& view,
                               std::uint64_t& offset) {
        const json* const found = sparse.object(key);
        if (found == nullptr)
            o.failHere("sparse has no {}", key);
        const GltfObject part = o.part(*found);
        view = part.requiredReference("bufferView", views.size(), "bufferViews");
        if (views[static_cast<std::size_t>(view)].stride != 0)
            o.failHere("sparse {} use a bufferView with a byteStride", key);
        offset = part.count("byteOffset").value_or(0);
        requireInside(o, offset, kept.count, size, static_cast<std::size_t>(view), views);
    };
    const json* const indices = sparse.object("indices");
    const std::uint64_t type =
        indices == nullptr ? 0 : o.part(*indices).requiredCount("componentType");
    if (type != 5121 && type != 5123 && type != 5125)
        o.failHere("sparse indices have component type {}", type);
    kept.indexType = static_cast<std::uint32_t>(type);
    checkPart("indices", gltfComponentSize(type), kept.indexView, kept.indexOffset);
    checkPart("values", elementSize, kept.valueView, kept.valueOffset);
    return kept;
}

// uv' = translation · rotation · scale · uv, as KHR_texture_transform has it.
GltfUvSource checkUvs(const GltfObject& texture)
{
    GltfUvSource source;
    source.set = static_cast<int>(texture.count("texCoord", 16).value_or(0));
    const json* const extensions = texture.object("extensions");
    const json* const found =
        extensions == nullptr ? nullptr : texture.part(*extensions).object("KHR_texture_transform");
    if (found == nullptr)
        return source;
    const GltfObject move = texture.part(*found);
    const std::vector<double> offset = move.numbers("offset", 2);
    const std::vector<double> scale = move.numbers("scale", 2);
    const SinCos turn = exactSinCos(std::clamp(move.number("rotation").value_or(0.0), -1e6, 1e6));
    source.set = static_cast<int>(
        move.count("texCoord", 16).value_or(static_cast<std::uint64_t>(source.set)));
    const double scaleU = scale.empty() ? 1.0 : scale[0];
    const double scaleV = scale.empty() ? 1.0 : scale[1];
    source.placing[0] = glm::vec2(glm::dvec2(turn.cos * scaleU, -turn.sin * scaleU));
    source.placing[1] = glm::vec2(glm::dvec2(turn.sin * scaleV, turn.cos * scaleV));
    if (!offset.empty())
        source.placing[2] = glm::vec2(glm::dvec2(offset[0], offset[1]));
    return source;
}

float unitInterval(double value)
{
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
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

GltfElements checkAccessor(const GltfObject& o, const std::vector<GltfView>& views,
                           std::uint64_t zeros)
{
    GltfElements kept;
    const std::uint64_t type = o.requiredCount("componentType");
    const std::uint64_t componentSize = gltfComponentSize(type);
    if (componentSize == 0)
        o.failHere("component type {} is not known", type);
    const std::string shape = o.text("type");
    const std::uint64_t elementSize = componentSize * gltfComponentCount(shape);
    if (elementSize == 0)
        o.failHere("type \"{}\" is not known", shape);
    kept.type = static_cast<std::uint32_t>(type);
    kept.components = static_cast<std::uint32_t>(gltfComponentCount(shape));
    kept.count = o.requiredCount("count", 1ULL << 32);
    if (kept.count == 0)
        o.failHere("count is 0");
    kept.isNormalized = o.truth("normalized").value_or(false);
    kept.offset = o.count("byteOffset").value_or(0);
    kept.view = o.reference("bufferView", views.size(), "bufferViews");
    if (kept.view != noEntry)
        requireInside(o, kept.offset, kept.count, elementSize, static_cast<std::size_t>(kept.view),
                      views);
    else if (kept.count > zeros)
        o.failHere("{} elements, but no bufferView: more zeros than the {} that a file of this "
                   "size may claim",
                   kept.count, zeros);
    if (o.object("sparse") != nullptr)
        kept.sparse = checkSparse(o, kept.count, elementSize, views);
    return kept;
}

GltfAttributes checkAttributes(const GltfObject& owner, const json& attributes,
                               std::size_t accessors)
{
    GltfAttributes kept;
    const GltfObject o = owner.part(attributes);
    for (const auto& [name, unused] : attributes.items())
        kept.emplace_back(name, o.requiredReference(name.c_str(), accessors, "accessors"));
    return kept;
}

GltfAttributes checkInstancing(const GltfObject& node, const std::vector<GltfElements>& accessors)
{
    constexpr const char* name = "EXT_mesh_gpu_instancing";
    const json* const extensions = node.object("extensions");
    if (extensions == nullptr)
        return {};
    const json* const instancing = node.part(*extensions).object(name);
    if (instancing == nullptr)
        return {};
    const json* const attributes = node.part(*instancing).object("attributes");
    if (attributes == nullptr)
        node.failHere("{} has no attributes", name);

    // All attributes describe the same number of instances.
    GltfAttributes kept = checkAttributes(node, *attributes, accessors.size());
    std::uint64_t instances = 0;
    for (const auto& [key, accessor] : kept) {
        const std::uint64_t count = accessors[static_cast<std::size_t>(accessor)].count;
        if (instances != 0 && count != instances)
            node.failHere("{} has {} for {} instances", name, count, instances);
        instances = count;
        if (instances > instanceLimit)
            node.failHere("{} of {} instances, more than {}", name, instances, instanceLimit);
    }
    if (instances == 0)
        node.failHere("{} names no attribute", name);
    return kept;
}

std::vector<double> checkPlacing(const GltfObject& o, Diagnostics& diagnostics)
{
    std::vector<double> matrix = o.numbers("matrix", 16);
    std::vector<double> translation = o.numbers("translation", 3);
    std::vector<double> rotation = o.numbers("rotation", 4);
    std::vector<double> scale = o.numbers("scale", 3);
    const bool hasParts = !translation.empty() || !rotation.empty() || !scale.empty();
    if (!matrix.empty() && hasParts)
        diagnostics.warn("{}: it has a matrix and a {}; glTF allows one or the other, and the "
                         "matrix is taken",
                         o.name(),
                         !translation.empty() ? "translation"
                         : !rotation.empty()  ? "rotation"
                                              : "scale");
    if (!matrix.empty() || !hasParts)
        return matrix;
    std::vector<double> placing = translation.empty() ? std::vector<double>(3, 0.0) : translation;
    if (rotation.empty())
        rotation = {0.0, 0.0, 0.0, 1.0};
    if (scale.empty())
        scale.assign(3, 1.0);
    placing.insert(placing.end(), rotation.begin(), rotation.end());
    placing.insert(placing.end(), scale.begin(), scale.end());
    return placing;
}

GltfMaterial checkMaterial(const GltfObject& o, std::size_t textures)
{
    GltfMaterial kept;
    kept.name = o.text("name");
    kept.doubleSided = o.truth("doubleSided").value_or(false);
    const double cutoff = o.number("alphaCutoff").value_or(0.5);
    if (o.text("alphaMode") == "MASK")
        kept.alphaCutoff = static_cast<float>(std::clamp(cutoff, 0.0, 1e6));
    const json* const found = o.object("pbrMetallicRoughness");
    if (found == nullptr)
        return kept;
    const GltfObject surface = o.part(*found);
    const std::vector<double> color = surface.numbers("baseColorFactor", 4);
    for (std::size_t c = 0; c < color.size(); ++c)
        kept.color[int(c)] = unitInterval(color[c]);
    kept.roughness = unitInterval(surface.number("roughnessFactor").value_or(1.0));
    kept.metallic = unitInterval(surface.number("metallicFactor").value_or(1.0));
    if (const json* const image = surface.object("baseColorTexture")) {
        const GltfObject reference = o.part(*image);
        kept.texture = reference.requiredReference("index", textures, "textures");
        kept.uvs = checkUvs(reference);
    }
    return kept;
}

} // namespace sward::terrain
