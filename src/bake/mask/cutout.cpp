#include "bake/mask/cutout.h"

#include "terrain/image/image_sampling.h"

namespace sward::bake {

Cutout::Cutout(const terrain::GroundMesh& ground, bool colorsAreMask)
    : ground_(ground)
    , colorsAreMask_(colorsAreMask)
{
    bool mayHold = false;
    for (const terrain::GroundMaterial& material : ground.materials)
        mayHold = mayHold || material.alphaCutoff > 0.0f;
    for (std::size_t t = 0; mayHold && !isAny_ && t < ground.triangles.size(); ++t)
        isAny_ = ground.bears[t] != 0 && ground.materials[ground.materialOf[t]].alphaCutoff > 0.0f;
}

bool Cutout::holds(const RootSample& root) const
{
    const terrain::GroundMaterial& material = ground_.materials[ground_.materialOf[root.triangle]];
    if (!(material.alphaCutoff > 0.0f))
        return false;
    const glm::uvec3 corners = ground_.triangles[root.triangle];
    const auto b = static_cast<double>(root.barycentric.x);
    const auto c = static_cast<double>(root.barycentric.y);
    const auto between = [&](const auto& atX, const auto& atY, const auto& atZ) {
        return (1.0 - b - c) * atX + b * atY + c * atZ;
    };
    auto alpha = double(material.baseColor.w);
    if (material.image != terrain::GroundMaterial::noImage)
        alpha *= terrain::valueAt(
            ground_.images[material.image], 3, {material.wrapU, material.wrapV},
            between(glm::dvec2(ground_.uvs[corners.x]), glm::dvec2(ground_.uvs[corners.y]),
                    glm::dvec2(ground_.uvs[corners.z])));
    if (ground_.hasColors && !colorsAreMask_)
        alpha *= between(double(ground_.colors[corners.x].w), double(ground_.colors[corners.y].w),
                         double(ground_.colors[corners.z].w));
    return alpha < double(material.alphaCutoff);
}

} // namespace sward::bake
