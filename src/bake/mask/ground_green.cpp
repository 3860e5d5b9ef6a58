#include "bake/mask/ground_green.h"

#include "bake/ground/drawn_colors.h"
#include "bake/mask/sample_places.h"
#include "terrain/image/image_sampling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::bake {
namespace {

constexpr double squareWidth = 0.5;                                   // [m] at blade scale 1
constexpr std::array<double, 4> tapOffsets{-0.75, -0.25, 0.25, 0.75}; // of half the width

// Hue [0, 360) in degrees, saturation and value [0, 1].
struct Hsv {
    double hue = 0.0;
    double saturation = 0.0;
    double value = 0.0;
};

Hsv hsvOf(glm::dvec3 color)
{
    const double high = std::max({color.x, color.y, color.z});
    const double low = std::min({color.x, color.y, color.z});
    const double range = high - low;
    if (!(range > 0.0))
        return {0.0, 0.0, high};
    double sector = 0.0;
    if (high == color.x)
        sector = (color.y - color.z) / range;
    else if (high == color.y)
        sector = 2.0 + (color.z - color.x) / range;
    else
        sector = 4.0 + (color.x - color.y) / range;
    return {60.0 * (sector < 0.0 ? sector + 6.0 : sector), range / high, high};
}

// From 0 at `none` to 1 at `full`, which may lie below it.
double ramp(double x, double none, double full)
{
    return std::clamp((x - none) / (full - none), 0.0, 1.0);
}

// A texel, linear by a square, as groundColor() takes it.
glm::dvec3 linearTexel(const terrain::GroundImage& image, std::size_t x, std::size_t y)
{
    const std::uint8_t* pixel = image.rgba.data() + 4 * (y * image.width + x);
    const glm::dvec3 stored(pixel[0], pixel[1], pixel[2]);
    return stored * stored * (1.0 / (255.0 * 255.0));
}

glm::dvec3 linearImage(const terrain::GroundImage& image, const terrain::GroundMaterial& material,
                       glm::dvec2 uv)
{
    const terrain::PixelPair x = terrain::pixelsAt(uv.x, image.width, material.wrapU);
    const terrain::PixelPair y = terrain::pixelsAt(uv.y, image.height, material.wrapV);
    const auto row = [&](std::size_t at) {
        const glm::dvec3 first = linearTexel(image, x.first, at);
        return first + x.share * (linearTexel(image, x.second, at) - first);
    };
    const glm::dvec3 upper = row(y.first);
    return upper + y.share * (row(y.second) - upper);
}

glm::dvec3 nearestTexel(const terrain::GroundImage& image, const terrain::GroundMaterial& material,
                        glm::dvec2 uv)
{
    return linearTexel(image,
                       terrain::wrapped(terrain::pixelAt(uv.x, image.width, material.wrapU),
                                        image.width, material.wrapU),
                       terrain::wrapped(terrain::pixelAt(uv.y, image.height, material.wrapV),
                                        image.height, material.wrapV));
}

} // namespace

double greenWeight(glm::dvec3 color)
{
    const Hsv hsv = hsvOf(color);
    const double green = std::min(ramp(hsv.hue, 50.0, 62.0), ramp(hsv.hue, 175.0, 160.0)) *
                         ramp(hsv.saturation, 0.12, 0.25);
    const double earth = std::min(ramp(hsv.hue, 10.0, 20.0), ramp(hsv.hue, 60.0, 50.0)) *
                         ramp(hsv.saturation, 0.3, 0.45) * ramp(hsv.value, 0.7, 0.55);
    return std::max(green, 0.2 * earth);
}

GroundGreen::GroundGreen(const terrain::GroundMesh& ground, double scale, bool colorsAreMask)
    : ground_(ground)
    , halfWidth_(0.5 * squareWidth * scale)
    , colorsAreMask_(colorsAreMask)
{
}

glm::dvec3 GroundGreen::imageAround(const RootSample& root,
                                    const terrain::GroundMaterial& material) const
{
    const terrain::GroundImage& image = ground_.images[material.image];
    const glm::uvec3 corners = ground_.triangles[root.triangle];
    const glm::dvec2 uv0(ground_.uvs[corners.x]);
    const glm::dvec2 uv1 = glm::dvec2(ground_.uvs[corners.y]) - uv0;
    const glm::dvec2 uv2 = glm::dvec2(ground_.uvs[corners.z]) - uv0;
    const glm::dvec2 middle =
        uv0 + double(root.barycentric.x) * uv1 + double(root.barycentric.y) * uv2;

    // Steps of the texture coordinates along two unit vectors in the triangle's plane.
    const glm::dvec3 p0(ground_.positions[corners.x]);
    const glm::dvec3 edge1 = glm::dvec3(ground_.positions[corners.y]) - p0;
    const glm::dvec3 edge2 = glm::dvec3(ground_.positions[corners.z]) - p0;
    const glm::dvec3 normal = glm::cross(edge1, edge2);
    const double squared = glm::dot(normal, normal);
    if (!(squared > 0.0))
        return linearImage(image, material, middle);
    const glm::dvec3 gradient1 = glm::cross(edge2, normal) / squared;
    const glm::dvec3 gradient2 = glm::cross(normal, edge1) / squared;
    const auto stepAlong = [&](glm::dvec3 direction) {
        const glm::dvec3 step =
            direction * (halfWidth_ / std::sqrt(glm::dot(direction, direction)));
        return uv1 * glm::dot(gradient1, step) + uv2 * glm::dot(gradient2, step);
    };
    const glm::dvec2 along = stepAlong(edge1);
    const glm::dvec2 across = stepAlong(glm::cross(normal, edge1));
    // Within one texel the image is linear, and its mean is in the middle.
    const glm::dvec2 reach =
        (glm::abs(along) + glm::abs(across)) * glm::dvec2(image.width, image.height);
    if (reach.x < 0.5 && reach.y < 0.5)
        return linearImage(image, material, middle);
    // Taps a texel or more apart need no interpolation, which takes most of the time.
    const bool isFine = reach.x >= 2.0 && reach.y >= 2.0;
    glm::dvec3 sum(0.0);
    for (const double i : tapOffsets)
        for (const double j : tapOffsets) {
            const glm::dvec2 uv = middle + i * along + j * across;
            sum += isFine ? nearestTexel(image, material, uv) : linearImage(image, material, uv);
        }
    return sum / 16.0;
}

double GroundGreen::at(const RootSample& root) const
{
    const terrain::GroundMaterial& material = ground_.materials[ground_.materialOf[root.triangle]];
    glm::dvec3 color(glm::vec3(material.baseColor));
    if (material.image != terrain::GroundMaterial::noImage)
        color *= imageAround(root, material);
    if (showsVertexColors(ground_, ground_.materialOf[root.triangle], colorsAreMask_)) {
        const glm::uvec3 corners = ground_.triangles[root.triangle];
        const auto b = static_cast<double>(root.barycentric.x);
        const auto c = static_cast<double>(root.barycentric.y);
        const std::uint32_t own = ground_.materialOf[root.triangle];
        color *= (1.0 - b - c) * glm::dvec3(vertexColor(ground_, own, corners.x)) +
                 b * glm::dvec3(vertexColor(ground_, own, corners.y)) +
                 c * glm::dvec3(vertexColor(ground_, own, corners.z));
    }
    color = glm::clamp(color, 0.0, 1.0);
    return greenWeight({std::sqrt(color.x), std::sqrt(color.y), std::sqrt(color.z)});
}

bool hasOwnColors(const terrain::GroundMesh& ground, bool colorsAreMask)
{
    std::vector<bool> bears(ground.materials.size(), false);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        if (ground.bears[t] != 0)
            bears[ground.materialOf[t]] = true;
    // What is drawn as earth has never been given a colour.
    const glm::vec3 earth(terrain::GroundMaterial{}.baseColor);
    const std::vector<glm::vec3> drawn = drawnBaseColors(ground, colorsAreMask);
    for (std::uint32_t m = 0; m < bears.size(); ++m)
        if (bears[m] && (ground.materials[m].image != terrain::GroundMaterial::noImage ||
                         showsVertexColors(ground, m, colorsAreMask) || drawn[m] != earth))
            return true;
    return false;
}

std::optional<GreenShares> greenShares(const terrain::GroundMesh& ground, double scale,
                                       bool colorsAreMask)
{
    if (!hasOwnColors(ground, colorsAreMask))
        return std::nullopt;
    GreenShares shares;
    constexpr std::uint64_t places = 16384;
    const GroundGreen green(ground, scale, colorsAreMask);
    forEachPlace(ground, places, [&](const RootSample& root) {
        const double weight = green.at(root);
        shares.green += weight >= 0.5 ? 1.0 / double(places) : 0.0;
        shares.bare += weight < 0.25 ? 1.0 / double(places) : 0.0;
        return true;
    });
    return shares;
}

} // namespace sward::bake
