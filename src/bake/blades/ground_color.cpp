#include "bake/blades/ground_color.h"

#include "bake/ground/drawn_colors.h"
#include "terrain/image/image_sampling.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace sward::bake {
namespace {

glm::vec3 linear(glm::vec3 stored)
{
    return stored * stored;
}

// Mean of the nine texels around a place, linear.
glm::vec3 imageColor(const terrain::GroundImage& image, const terrain::GroundMaterial& material,
                     glm::dvec2 uv)
{
    const std::int64_t column = terrain::pixelAt(uv.x, image.width, material.wrapU);
    const std::int64_t row = terrain::pixelAt(uv.y, image.height, material.wrapV);
    glm::vec3 sum(0.0f);
    for (std::int64_t y = row - 1; y <= row + 1; ++y)
        for (std::int64_t x = column - 1; x <= column + 1; ++x) {
            const std::size_t texel =
                terrain::wrapped(y, image.height, material.wrapV) * image.width +
                terrain::wrapped(x, image.width, material.wrapU);
            const std::uint8_t* pixel = image.rgba.data() + 4 * texel;
            sum += linear(glm::vec3(float(pixel[0]), float(pixel[1]), float(pixel[2])) / 255.0f);
        }
    return sum / 9.0f;
}

} // namespace

glm::vec3 groundColor(const terrain::GroundMesh& ground, const RootSample& root,
                      std::span<const glm::vec3> baseColors, bool colorsAreMask)
{
    const terrain::GroundMaterial& material = ground.materials[ground.materialOf[root.triangle]];
    glm::vec3 color = baseColors[ground.materialOf[root.triangle]];
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const float b = root.barycentric.x;
    const float c = root.barycentric.y;
    if (material.image != terrain::GroundMaterial::noImage) {
        const glm::vec2 uv = (1.0f - b - c) * ground.uvs[corners.x] + b * ground.uvs[corners.y] +
                             c * ground.uvs[corners.z];
        color *= imageColor(ground.images[material.image], material, glm::dvec2(uv));
    }
    if (showsVertexColors(ground, ground.materialOf[root.triangle], colorsAreMask)) {
        const std::uint32_t own = ground.materialOf[root.triangle];
        color *= (1.0f - b - c) * vertexColor(ground, own, corners.x) +
                 b * vertexColor(ground, own, corners.y) + c * vertexColor(ground, own, corners.z);
    }
    return glm::sqrt(glm::clamp(color, 0.0f, 1.0f));
}

} // namespace sward::bake
