#include "bake/patches/display_ground.h"

#include "bake/ground/drawn_colors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace sward::bake {
namespace {

std::uint32_t packColor(glm::vec4 color)
{
    const glm::vec4 bytes = glm::floor(glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f);
    return static_cast<std::uint32_t>(bytes.x) | static_cast<std::uint32_t>(bytes.y) << 8 |
           static_cast<std::uint32_t>(bytes.z) << 16 | static_cast<std::uint32_t>(bytes.w) << 24;
}

shared::GroundMaterial displayMaterial(const terrain::GroundMaterial& material, glm::vec3 color)
{
    shared::GroundMaterial shown;
    shown.baseColor = glm::vec4(color, material.baseColor.w);
    shown.roughness = material.roughness;
    shown.metallic = material.metallic;
    shown.image = material.image;
    shown.flags = material.doubleSided ? shared::groundDoubleSided : 0U;
    return shown;
}

// Frees what an array holds; assigning {} would keep its memory.
template <typename T>
void release(std::vector<T>& array)
{
    std::vector<T>().swap(array);
}

std::vector<shared::GroundVertex> verticesOf(const terrain::GroundMesh& ground, bool colorsAreMask)
{
    std::vector<shared::GroundVertex> vertices(ground.positions.size());
    for (std::size_t v = 0; v < ground.positions.size(); ++v) {
        shared::GroundVertex& vertex = vertices[v];
        vertex.position = ground.positions[v];
        vertex.normal = shared::encodeNormal32(ground.normals[v]);
        vertex.uv = ground.uvs[v];
        vertex.color = 0xffffffffU;
    }

    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (!showsVertexColors(ground, ground.materialOf[t], colorsAreMask))
            continue;
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = ground.triangles[t][corner];
            vertices[v].color =
                packColor({vertexColor(ground, ground.materialOf[t], v), ground.colors[v].w});
        }
    }
    return vertices;
}

// Groups the triangles by material, in the order of the mesh.
void addIndices(const terrain::GroundMesh& ground, field::DisplayGround& shown)
{
    std::vector<std::uint32_t> first(ground.materials.size() + 1, 0);
    for (const std::uint32_t material : ground.materialOf)
        ++first[material + 1];
    for (std::size_t m = 0; m < ground.materials.size(); ++m)
        first[m + 1] += first[m];
    shown.indices.resize(3 * ground.triangles.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        const std::size_t slot = next[ground.materialOf[t]]++;
        for (std::size_t corner = 0; corner < 3; ++corner)
            shown.indices[3 * slot + corner] = ground.triangles[t][int(corner)];
    }
    for (std::uint32_t m = 0; m < ground.materials.size(); ++m)
        if (first[m + 1] > first[m])
            shown.ranges.push_back({0, m, 3 * first[m], 3 * (first[m + 1] - first[m])});
}

void addLook(const terrain::GroundMesh& ground, bool colorsAreMask, field::DisplayGround& shown)
{
    const std::vector<glm::vec3> colors = drawnBaseColors(ground, colorsAreMask);
    for (std::size_t m = 0; m < ground.materials.size(); ++m)
        shown.materials.push_back(displayMaterial(ground.materials[m], colors[m]));
    for (const terrain::GroundImage& image : ground.images)
        shown.images.push_back({image.width, image.height, image.rgba});
}

} // namespace

field::DisplayGround displayGround(const terrain::GroundMesh& ground, bool colorsAreMask)
{
    field::DisplayGround shown;
    shown.vertices = verticesOf(ground, colorsAreMask);
    addIndices(ground, shown);
    addLook(ground, colorsAreMask, shown);
    return shown;
}

field::DisplayGround displayGround(terrain::GroundMesh&& ground, bool colorsAreMask)
{
    field::DisplayGround shown;
    if (!ground.hasColors)
        release(ground.colors);
    release(ground.nodeOf);
    release(ground.bears);
    release(ground.attributes.list);
    shown.vertices = verticesOf(ground, colorsAreMask);
    release(ground.colors);
    release(ground.positions);
    release(ground.normals);
    release(ground.uvs);
    addIndices(ground, shown);
    release(ground.triangles);
    release(ground.materialOf);
    addLook(ground, colorsAreMask, shown);
    return shown;
}

} // namespace sward::bake
