#include "render/viewer/exposure.h"

#include "core/math/srgb.h"
#include "render/frame/frame_settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sward::render {
namespace {

constexpr float minExposure = 0.25f;
constexpr float maxExposure = 4.0f;

/// Radiance times exposure that the film (shaders/shared/look/film_curve.h) shows as 18 % grey, and
/// as 85 %.
constexpr float exposedGrey = 0.163f;
constexpr float exposedBright = 1.6f;

/// Mean radiance of a meadow in preset views relative to shared::Cover::sward times the light on
/// level ground: leaves shade one another. Measured: lawn, meadow and steppe on hills.
constexpr float meadowBrightness = 0.6f;

/// Share of the stops by which bright ground raises the mean of all that is seen, which lowers the
/// exposure. All of them would make a meadow beside snow black, none would bleach the snow.
constexpr float adaptation = 0.5f;

/// Luminance of ground without grass, above which it is bright: sand is lighter than 18 % grey by
/// half of its stops. That of earth.
constexpr float usualGround = 0.2f;

/// Share of the ground below which its grass does not decide alone on the exposure.
constexpr float fewBlades = 0.05f;

/// Places of the ground whose colours are looked at, about; at most as many of a triangle; and the
/// share of the ground that may be brighter than exposedBright.
constexpr std::size_t groundSamples = 50'000;
constexpr std::size_t samplesOfTriangle = 256;
constexpr float mayClip = 0.01f;

float luminanceOf(glm::vec3 color)
{
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// A place of the ground, and the area that it stands for.
struct GroundPlace {
    glm::vec3 color{0.0f}; ///< linear, without grass
    float area = 0.0f;     ///< [m²]
    float leafArea = 0.0f; ///< of the meadow
};

/// Linear colour of an image at a place; images repeat.
glm::vec3 texelOf(const field::Image& image, glm::vec2 uv)
{
    const glm::vec2 place = glm::fract(uv) * glm::vec2(image.width, image.height);
    const std::size_t x = std::min<std::size_t>(static_cast<std::size_t>(place.x), image.width - 1);
    const std::size_t y =
        std::min<std::size_t>(static_cast<std::size_t>(place.y), image.height - 1);
    const std::uint8_t* const texel = &image.rgba[4 * (y * image.width + x)];
    const auto linear = [texel](int i) { return linearOf(static_cast<float>(texel[i]) / 255.0f); };
    return {linear(0), linear(1), linear(2)};
}

glm::vec3 vertexColor(const shared::GroundVertex& corner)
{
    const auto channel = [&corner](unsigned i) {
        return static_cast<float>((corner.color >> (8u * i)) & 255u) / 255.0f;
    };
    return {channel(0), channel(1), channel(2)};
}

/// Evenly spread weights of a triangle's corners: a sequence of two irrational steps (M. Roberts,
/// "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), folded into the triangle.
glm::vec3 weightsOf(std::size_t i)
{
    glm::dvec2 p = glm::fract(glm::dvec2(0.5) +
                              double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
    if (p.x + p.y > 1.0)
        p = 1.0 - p;
    return glm::vec3(glm::dvec3(1.0 - p.x - p.y, p.x, p.y));
}

/// Places all over the ground that is drawn in detail: many of a large triangle, whose image may
/// show all of a terrain.
std::vector<GroundPlace> groundPlaces(const field::DisplayGround& ground,
                                      const shared::Cover& cover)
{
    std::size_t triangles = 0;
    for (const field::GroundRange& range : ground.ranges)
        triangles += range.level == 0 ? range.indexCount / 3 : 0;
    const std::size_t stride = std::max<std::size_t>(triangles / groundSamples, 1);
    const std::size_t each = std::clamp<std::size_t>(
        groundSamples / std::max<std::size_t>(triangles, 1), 1, samplesOfTriangle);
    std::vector<GroundPlace> places;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0 || range.material >= ground.materials.size())
            continue;
        const shared::GroundMaterial& material = ground.materials[range.material];
        for (std::size_t i = 0; i < range.indexCount / 3; i += stride) {
            const std::uint32_t* const corner = &ground.indices[range.firstIndex + 3 * i];
            const shared::GroundVertex& a = ground.vertices[corner[0]];
            const shared::GroundVertex& b = ground.vertices[corner[1]];
            const shared::GroundVertex& c = ground.vertices[corner[2]];
            const float area =
                0.5f * static_cast<float>(stride) *
                glm::length(glm::cross(b.position - a.position, c.position - a.position));
            for (std::size_t k = 0; k < each; ++k) {
                const glm::vec3 w = weightsOf(places.size());
                GroundPlace place;
                place.color = glm::vec3(material.baseColor) *
                              (w.x * vertexColor(a) + w.y * vertexColor(b) + w.z * vertexColor(c));
                if (material.image < ground.images.size())
                    place.color *= texelOf(ground.images[material.image],
                                           w.x * a.uv + w.y * b.uv + w.z * c.uv);
                place.area = area / static_cast<float>(each);
                place.leafArea =
                    cover.thinned * shared::leafAreaAt(cover, w.x * a.position + w.y * b.position +
                                                                  w.z * c.position);
                places.push_back(place);
            }
        }
    }
    return places;
}

/// The usual light on level ground and on ground that faces the sun.
struct UsualLight {
    FrameSettings settings;
    glm::vec3 sky = 1.25f * settings.skyColor;
    float cosine = glm::normalize(settings.sunDirection).y;

    /// Below `leafArea` of leaves, with the sun at `facing` from the ground's normal.
    glm::vec3 below(const shared::Cover& cover, float leafArea, float facing) const
    {
        return facing * shared::sunBelow(shared::leafProjectionOf(cover), leafArea, facing) *
                   settings.sunColor +
               shared::skyBelow(leafArea) * sky;
    }
};

/// Ground that is seen between and beside grass.
struct SeenGround {
    float share = 0.0f; ///< of the area that no leaves cover
    float mean = 0.0f;  ///< mean luminance of all the ground, without grass
    float stops = 0.0f; ///< mean logarithm (base e) by which what is seen is brighter than leaves;
                        ///< those have 0
    float brightest =
        0.0f; ///< largest radiance of a channel where it faces the sun, but for mayClip of the area
};

SeenGround seenGround(const std::vector<GroundPlace>& places, const shared::Cover& cover,
                      const UsualLight& light, float luminanceOfLeaves)
{
    struct Bright {
        float radiance, area;
    };
    std::vector<Bright> facing;
    SeenGround seen;
    double area = 0.0, open = 0.0, mean = 0.0, stops = 0.0;
    for (const GroundPlace& place : places) {
        const float share = 1.0f - shared::undergrowthBelow(place.leafArea);
        const glm::vec3 color =
            shared::groundUnder(cover, place.color, glm::vec3(1.0f), place.leafArea);
        const float level = luminanceOf(color * light.below(cover, place.leafArea, light.cosine));
        area += double(place.area);
        open += double(share * place.area);
        mean +=
            double(place.area * luminanceOf(place.color * light.below(cover, 0.0f, light.cosine)));
        if (luminanceOfLeaves > 0.0f)
            stops +=
                double(share * place.area * std::log(std::max(level / luminanceOfLeaves, 1.0f)));
        const glm::vec3 bright = color * light.below(cover, place.leafArea, 1.0f);
        facing.push_back({std::max({bright.x, bright.y, bright.z}), share * place.area});
    }
    if (!(area > 0.0))
        return seen;
    seen.share = static_cast<float>(open / area);
    seen.mean = static_cast<float>(mean / area);
    seen.stops = static_cast<float>(stops / area);
    std::sort(facing.begin(), facing.end(),
              [](const Bright& a, const Bright& b) { return a.radiance > b.radiance; });
    double above = 0.0;
    for (const Bright& bright : facing) {
        above += double(bright.area);
        if (above < double(mayClip) * area)
            continue;
        seen.brightest = bright.radiance;
        break;
    }
    return seen;
}

} // namespace

float chosenExposure(const field::FieldView& field, const field::LeafAreaGrid& grass)
{
    const UsualLight light;
    shared::Cover cover = grass.view();
    field::describeUndergrowth(field, cover);
    cover.thatch = 1.0f;
    const float leaves = field.blades.empty()
                             ? 0.0f
                             : luminanceOf(cover.sward * light.below(cover, 0.0f, light.cosine));
    const SeenGround ground = seenGround(groundPlaces(*field.ground, cover), cover, light, leaves);

    // The mean luminance of the meadow, or of the ground without any.
    float mean = ground.mean > usualGround ? std::sqrt(ground.mean * usualGround) : ground.mean;
    float stops = 0.0f;
    if (leaves > 0.0f) {
        const float meadow = std::min((1.0f - ground.share) / fewBlades, 1.0f);
        mean = std::pow(meadowBrightness * leaves, meadow) *
               std::pow(std::max(mean, 1e-6f), 1.0f - meadow);
        stops = meadow * adaptation * ground.stops;
    }
    const float wanted = mean > 0.0f ? exposedGrey / mean * std::exp(-stops) : 1.0f;
    const float allowed = ground.brightest > 0.0f ? exposedBright / ground.brightest : maxExposure;
    return std::clamp(std::min(wanted, allowed), minExposure, maxExposure);
}

} // namespace sward::render
