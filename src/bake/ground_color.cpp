#include "bake/ground_color.h"

#include "bake/display_ground.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <cmath>

namespace sward::bake {
namespace {

glm::vec3 linear(glm::vec3 stored)
{
    return stored * stored;
}

// Texel index of a coordinate in images that repeat.
std::size_t wrapped(double coordinate, std::uint32_t size, int offset)
{
    const double share = coordinate - std::floor(coordinate);
    const auto texel = static_cast<std::int64_t>(share * size) + offset;
    const auto length = static_cast<std::int64_t>(size);
    return static_cast<std::size_t>(((texel % length) + length) % length);
}

// Mean of the nine texels around a place, linear.
glm::vec3 imageColor(const terrain::GroundImage& image, glm::vec2 uv)
{
    glm::vec3 sum(0.0f);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const std::size_t texel = wrapped(double(uv.y), image.height, y) * image.width +
                                      wrapped(double(uv.x), image.width, x);
            const std::uint8_t* pixel = image.rgba.data() + 4 * texel;
            sum += linear(glm::vec3(float(pixel[0]), float(pixel[1]), float(pixel[2])) / 255.0f);
        }
    return sum / 9.0f;
}

} // namespace

glm::vec3 groundColor(const terrain::GroundMesh& ground, const RootSample& root, bool colorsAreMask)
{
    const terrain::GroundMaterial& material = ground.materials[ground.materialOf[root.triangle]];
    glm::vec3 color(material.baseColor.x, material.baseColor.y, material.baseColor.z);
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const float b = root.barycentric.x;
    const float c = root.barycentric.y;
    if (material.image != terrain::GroundMaterial::noImage) {
        const glm::vec2 uv = (1.0f - b - c) * ground.uvs[corners.x] + b * ground.uvs[corners.y] +
                             c * ground.uvs[corners.z];
        color *= imageColor(ground.images[material.image], uv);
    }
    if (showsVertexColors(ground, ground.materialOf[root.triangle], colorsAreMask)) {
        const glm::vec4 vertexColor = (1.0f - b - c) * ground.colors[corners.x] +
                                      b * ground.colors[corners.y] + c * ground.colors[corners.z];
        color *= glm::vec3(vertexColor.x, vertexColor.y, vertexColor.z);
    }
    return glm::sqrt(glm::clamp(color, 0.0f, 1.0f));
}

} // namespace sward::bake
