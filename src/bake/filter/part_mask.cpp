#include "bake/filter/part_mask.h"

#include "terrain/image/image_sampling.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace sward::bake {
namespace {

// Pixels that are read for one part; larger parts are not tested.
constexpr std::size_t maxPixels = 4096;

// Box of the texture coordinates of a part.
struct UvBox {
    glm::dvec2 low{unbounded};
    glm::dvec2 high{-unbounded};
};

// Visits the barycentrics (b, c) of the part's corners.
template <typename Visit>
void forEachCorner(const GroundPart& part, Visit visit)
{
    visit(part.b, part.c);
    visit(part.b + part.size, part.c);
    visit(part.b, part.c + part.size);
}

template <typename Value>
UvBox uvBox(const terrain::GroundMesh& ground, const std::vector<Value>& uvs,
            const GroundPart& part)
{
    const glm::uvec3 corners = ground.triangles[part.triangle];
    UvBox box;
    forEachCorner(part, [&](double b, double c) {
        const glm::dvec2 uv = (1.0 - b - c) * glm::dvec2(uvs[corners.x]) +
                              b * glm::dvec2(uvs[corners.y]) + c * glm::dvec2(uvs[corners.z]);
        box.low = glm::min(box.low, uv);
        box.high = glm::max(box.high, uv);
    });
    return box;
}

// A mask by vertices is linear on its triangle, and cut off at 0: at all corners 0, it is 0 between
// them.
bool isZeroAtCorners(const Mask& mask, const terrain::GroundMesh& ground, const GroundPart& part)
{
    bool isZero = true;
    forEachCorner(part, [&](double b, double c) {
        RootSample root{};
        root.triangle = part.triangle;
        root.barycentric = glm::vec2(b, c);
        isZero = isZero && mask.at(ground, root) <= 0.0;
    });
    return isZero;
}

} // namespace

bool isZeroOn(const Mask& mask, const terrain::GroundMesh& ground, const GroundPart& part)
{
    const double zero = mask.invert ? 1.0 : 0.0;
    switch (mask.source) {
    case Mask::Source::vertexColor:
        return isZeroAtCorners(mask, ground, part);
    case Mask::Source::texture: {
        const terrain::VertexAttribute* const own =
            ground.attributes.list.empty() ? nullptr : ground.attributes.find(mask.attributeName());
        const UvBox box =
            own != nullptr ? uvBox(ground, own->values, part) : uvBox(ground, ground.uvs, part);
        return terrain::holdsOnly(*mask.image, {}, box.low, box.high, zero, maxPixels);
    }
    case Mask::Source::materialTexture: {
        const terrain::GroundMaterial& material =
            ground.materials[ground.materialOf[part.triangle]];
        if (material.image == terrain::GroundMaterial::noImage)
            return zero == 0.0;
        const terrain::GroundImage& image = ground.images[material.image];
        const auto& stored = image.stored[static_cast<std::size_t>(mask.channel)];
        const terrain::ImageWraps wraps{material.wrapU, material.wrapV};
        const UvBox box = uvBox(ground, ground.uvs, part);
        return stored != nullptr
                   ? terrain::holdsOnly(*stored, wraps, box.low, box.high, zero, maxPixels)
                   : terrain::holdsOnly(image, mask.channel, wraps, box.low, box.high, zero,
                                        maxPixels);
    }
    case Mask::Source::groundGreen:
    case Mask::Source::raster:
        break;
    }
    return false;
}

} // namespace sward::bake
