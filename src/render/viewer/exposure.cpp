#include "render/viewer/exposure.h"

#include "core/math/srgb.h"
#include "field/measure/leaf_area.h"
#include "render/frame/frame_settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sward::render {
namespace {

constexpr float minExposure = 0.25f;
constexpr float maxExposure = 4.0f;

/// Radiance times exposure that the film (shaders/shared/look/film_curve.h) shows as 18 % grey, and
/// as 97 %.
constexpr float exposedGrey = 0.163f;
constexpr float exposedBright = 4.7f;

/// Mean radiance of a meadow in preset views relative to shared::Cover::sward times the light on
/// level ground: leaves shade one another. Measured: lawn, meadow and steppe on hills.
constexpr float meadowBrightness = 0.6f;

/// Triangles of the ground whose colours are looked at, and the share of them that may clip.
constexpr std::size_t groundSamples = 50'000;
constexpr float mayClip = 0.01f;

float luminanceOf(glm::vec3 color)
{
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// A colour of the ground, and the area that has it.
struct GroundColor {
    glm::vec3 color{0.0f}; ///< linear
    float area = 0.0f;     ///< [m²]
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

glm::vec3 colorAt(const field::DisplayGround& ground, const shared::GroundMaterial& material,
                  const shared::GroundVertex& corner)
{
    const auto channel = [&corner](unsigned i) {
        return static_cast<float>((corner.color >> (8u * i)) & 255u) / 255.0f;
    };
    glm::vec3 color = glm::vec3(material.baseColor) * glm::vec3(channel(0), channel(1), channel(2));
    if (material.image < ground.images.size())
        color *= texelOf(ground.images[material.image], corner.uv);
    return color;
}

std::vector<GroundColor> groundColors(const field::DisplayGround& ground)
{
    std::vector<GroundColor> colors;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0 || range.material >= ground.materials.size())
            continue;
        const std::size_t triangles = range.indexCount / 3;
        const std::size_t stride = std::max<std::size_t>(triangles / groundSamples, 1);
        for (std::size_t i = 0; i < triangles; i += stride) {
            const std::uint32_t* const corner = &ground.indices[range.firstIndex + 3 * i];
            const shared::GroundVertex& a = ground.vertices[corner[0]];
            const glm::vec3 b = ground.vertices[corner[1]].position;
            const glm::vec3 c = ground.vertices[corner[2]].position;
            colors.push_back({colorAt(ground, ground.materials[range.material], a),
                              static_cast<float>(stride) *
                                  glm::length(glm::cross(b - a.position, c - a.position))});
        }
    }
    return colors;
}

/// The brightest channel of the ground, but for a share `mayClip` of its area.
float brightestOf(std::vector<GroundColor> colors)
{
    const auto brightness = [](const GroundColor& ground) {
        return std::max({ground.color.x, ground.color.y, ground.color.z});
    };
    std::sort(colors.begin(), colors.end(), [&](const GroundColor& a, const GroundColor& b) {
        return brightness(a) > brightness(b);
    });
    double area = 0.0;
    for (const GroundColor& ground : colors)
        area += double(ground.area);
    double above = 0.0;
    for (const GroundColor& ground : colors) {
        above += double(ground.area);
        if (above >= double(mayClip) * area)
            return brightness(ground);
    }
    return 0.0f;
}

} // namespace

float chosenExposure(const field::FieldView& field)
{
    const FrameSettings usual;
    const glm::vec3 sky = 1.25f * usual.skyColor;
    const float cosine = glm::normalize(usual.sunDirection).y;
    const std::vector<GroundColor> ground = groundColors(*field.ground);

    // Mean radiance of the meadow, or of the ground without any.
    glm::vec3 color(0.0f);
    shared::Cover cover = {};
    field::describeUndergrowth(field, cover);
    if (!field.blades.empty()) {
        color = meadowBrightness * cover.sward;
    } else {
        float area = 0.0f;
        for (const GroundColor& part : ground) {
            color += part.area * part.color;
            area += part.area;
        }
        color /= std::max(area, 1e-20f);
    }
    const float mean = luminanceOf(color * (cosine * usual.sunColor + sky));
    const float wanted = mean > 0.0f ? exposedGrey / mean : 1.0f;

    // Radiance of the brightest ground where it faces the sun.
    const glm::vec3 light = usual.sunColor + sky;
    const float brightest = brightestOf(ground) * std::max({light.x, light.y, light.z});
    const float allowed = brightest > 0.0f ? exposedBright / brightest : maxExposure;
    return std::clamp(std::min(wanted, allowed), minExposure, maxExposure);
}

} // namespace sward::render
