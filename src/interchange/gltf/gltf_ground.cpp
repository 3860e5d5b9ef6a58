#include "interchange/gltf/gltf_ground.h"

#include "core/error.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/look/blade_colors.h"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <stb/stb_image_write.h>

#include <span>
#include <vector>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Texture i shows image i.
void addImage(GltfDocument& document, const field::Image& image)
{
    std::vector<std::byte> png;
    const auto append = [](void* to, void* bytes, int size) {
        const auto* const first = static_cast<const std::byte*>(bytes);
        auto& all = *static_cast<std::vector<std::byte>*>(to);
        all.insert(all.end(), first, first + size);
    };
    if (stbi_write_png_to_func(append, &png, static_cast<int>(image.width),
                               static_cast<int>(image.height), 4, image.rgba.data(),
                               static_cast<int>(4 * image.width)) == 0)
        fail(ErrorKind::runtime, "the ground's image of {}×{} cannot be encoded as PNG",
             image.width, image.height);
    const std::size_t view = document.addView(png, 0);
    const std::size_t source =
        document.add("images", {{"mimeType", "image/png"}, {"bufferView", view}});
    document.add("textures", {{"source", source}});
}

// The base colour of a material. Vertex colours are at most 1: under grass it is that of
// undergrowth where that is lighter, also where it varies.
glm::vec3 baseOf(const shared::GroundMaterial& material, const shared::Cover* cover)
{
    glm::vec3 color(material.baseColor);
    if (cover != nullptr && material.image == shared::noImage)
        color = glm::max(color, 1.5f * cover->undergrowth);
    return glm::clamp(color, 1e-3f, 1.0f);
}

std::size_t addMaterial(GltfDocument& document, const shared::GroundMaterial& material,
                        const shared::Cover* cover)
{
    const glm::vec4 color(cover != nullptr ? baseOf(material, cover)
                                           : glm::clamp(glm::vec3(material.baseColor), 0.0f, 1.0f),
                          glm::clamp(material.baseColor.w, 0.0f, 1.0f));
    ordered_json pbr = {{"baseColorFactor", {color.x, color.y, color.z, color.w}},
                        {"metallicFactor", material.metallic},
                        {"roughnessFactor", material.roughness}};
    if (material.image != shared::noImage)
        pbr["baseColorTexture"] = {{"index", material.image}};
    ordered_json entry = {{"name", "ground"}, {"pbrMetallicRoughness", pbr}};
    if ((material.flags & shared::groundDoubleSided) != 0)
        entry["doubleSided"] = true;
    return document.add("materials", std::move(entry));
}

// The sun at 53° over level ground stands for every sun.
constexpr float meanSun = 0.8f;

// Share of the light of the day that comes from the sun.
constexpr float sunShare = 0.6f;

// Share of the light that leaves pass on below a closed sward.
constexpr float amongLeaves = 0.1f;

// Colour of a vertex under grass, relative to baseOf() its material: undergrowth and the shade of
// leaves, which engines without the field's leaf area cannot know. What lies below an image keeps
// its colours.
std::uint32_t colorUnderGrass(const shared::Cover& cover, const shared::GroundVertex& vertex,
                              const shared::GroundMaterial& material)
{
    const auto channel = [&](unsigned shift) {
        return float((vertex.color >> shift) & 255u) / 255.0f;
    };
    glm::vec3 color(channel(0), channel(8), channel(16));
    const glm::vec3 grass = shared::grassAt(cover, vertex.position);
    if (material.image == shared::noImage)
        color = shared::groundUnder(cover, glm::vec3(material.baseColor) * color,
                                    shared::meadowShade(vertex.position, shared::toneOf(grass)),
                                    cover.thinned * grass.x) /
                baseOf(material, &cover);
    const float open = shared::skyBelow(grass.x);
    color *= sunShare * shared::sunBelow(shared::leafProjectionOf(cover), grass.x, meanSun) +
             (1.0f - sunShare) * open + amongLeaves * (1.0f - open);
    const glm::uvec3 bytes(255.0f * glm::clamp(color, 0.0f, 1.0f) + 0.5f);
    return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (vertex.color & 0xff000000u);
}

// The colours of all vertices, by the material of the finest triangles that they belong to.
std::vector<std::uint32_t> colorsUnderGrass(const field::DisplayGround& ground,
                                            const shared::Cover& cover)
{
    std::vector<std::uint32_t> colors;
    for (const shared::GroundVertex& vertex : ground.vertices)
        colors.push_back(vertex.color);
    for (const field::GroundRange& range : ground.ranges)
        if (range.level == 0)
            for (const std::uint32_t v :
                 std::span(ground.indices).subspan(range.firstIndex, range.indexCount))
                colors[v] =
                    colorUnderGrass(cover, ground.vertices[v], ground.materials[range.material]);
    return colors;
}

// The vertices of all levels, as accessors that every primitive shares.
ordered_json addVertices(GltfDocument& document, const field::DisplayGround& ground,
                         const shared::Cover* cover)
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> colors;
    Aabb bounds;
    for (const shared::GroundVertex& vertex : ground.vertices) {
        positions.push_back(vertex.position);
        normals.push_back(shared::decodeNormal32(vertex.normal));
        uvs.push_back(vertex.uv);
        colors.push_back(vertex.color);
        bounds.add(vertex.position);
    }
    if (cover != nullptr)
        colors = colorsUnderGrass(ground, *cover);
    return {
        {"POSITION", document.addArray(std::span<const glm::vec3>(positions),
                                       {.type = "VEC3", .bounds = bounds}, gltfVertices)},
        {"NORMAL",
         document.addArray(std::span<const glm::vec3>(normals), {.type = "VEC3"}, gltfVertices)},
        {"TEXCOORD_0",
         document.addArray(std::span<const glm::vec2>(uvs), {.type = "VEC2"}, gltfVertices)},
        {"COLOR_0", document.addArray(std::span<const std::uint32_t>(colors),
                                      {.componentType = 5121, .type = "VEC4", .normalized = true},
                                      gltfVertices)}};
}

} // namespace

std::optional<std::size_t> addGround(GltfDocument& document, const field::DisplayGround& ground,
                                     const DrawnLooks* looks)
{
    shared::Cover cover = {};
    if (looks != nullptr)
        cover = looks->cover();
    const shared::Cover* const grass = cover.countX > 0 ? &cover : nullptr;
    ordered_json primitives = ordered_json::array();
    ordered_json attributes;
    std::vector<std::size_t> materials;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0 || range.indexCount == 0)
            continue;
        // Write the shared vertices before the first range.
        if (primitives.empty()) {
            attributes = addVertices(document, ground, grass);
            for (const field::Image& image : ground.images)
                addImage(document, image);
            for (const shared::GroundMaterial& material : ground.materials)
                materials.push_back(addMaterial(document, material, grass));
        }
        const auto indices = std::span(ground.indices).subspan(range.firstIndex, range.indexCount);
        primitives.push_back(
            {{"attributes", attributes},
             {"indices", document.addArray(indices, {.componentType = 5125}, gltfIndices)},
             {"material", materials[range.material]}});
    }
    if (primitives.empty())
        return std::nullopt;
    const std::size_t mesh =
        document.add("meshes", {{"name", "ground"}, {"primitives", std::move(primitives)}});
    return document.add("nodes", {{"name", "ground"}, {"mesh", mesh}});
}

} // namespace sward::interchange
