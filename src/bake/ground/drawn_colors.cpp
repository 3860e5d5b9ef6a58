#include "bake/ground/drawn_colors.h"

#include <algorithm>

namespace sward::bake {
namespace {

// Whether a colour is a default of some exporter: neutral and lighter than rock.
bool looksUnset(glm::vec3 color)
{
    const float high = std::max({color.x, color.y, color.z});
    const float low = std::min({color.x, color.y, color.z});
    return high >= 0.4f && high - low <= 0.02f * high;
}

} // namespace

bool showsVertexColors(const terrain::GroundMesh& ground, std::uint32_t material,
                       bool colorsAreMask)
{
    return ground.hasColors && !colorsAreMask &&
           ground.materials[material].image == terrain::GroundMaterial::noImage;
}

std::vector<glm::vec3> drawnBaseColors(const terrain::GroundMesh& ground, bool colorsAreMask)
{
    const glm::vec3 earth(terrain::GroundMaterial{}.baseColor);
    std::vector<glm::vec3> colors;
    for (std::uint32_t m = 0; m < ground.materials.size(); ++m) {
        const glm::vec3 own(ground.materials[m].baseColor);
        const bool isPlain = ground.materials[m].image == terrain::GroundMaterial::noImage &&
                             !showsVertexColors(ground, m, colorsAreMask);
        colors.push_back(isPlain && looksUnset(own) ? earth : own);
    }
    return colors;
}

glm::vec3 vertexColor(const terrain::GroundMesh& ground, std::uint32_t material,
                      std::uint32_t vertex)
{
    const glm::vec3 stored(ground.colors[vertex]);
    return ground.materials[material].srgbColors ? stored * stored : stored;
}

} // namespace sward::bake
