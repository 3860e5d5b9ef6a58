// Preset cameras on eleven shapes: what they show is counted by rays through a coarse grid of
// pixels.

#include "core/random.h"
#include "presentation/camera_presets.h"
#include "render/frame/frame_settings.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace sward::render {
namespace {

using presentation::CameraPreset;
using presentation::GroundSurface;
using presentation::presetCamera;

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t presetSeed = 37;
constexpr float aspect = 16.0f / 9.0f;
constexpr int columns = 32;
constexpr int rows = 18;
constexpr std::size_t bladeCount = 4000;

/// A shape as triangles, three corners each.
using Triangles = std::vector<glm::vec3>;

/// Appends a surface over `across` × `along` cells of the unit square.
void addSheet(Triangles& shape, int across, int along,
              const std::function<glm::dvec3(double, double)>& at)
{
    const auto corner = [&](int i, int k) {
        return glm::vec3(at(double(i) / across, double(k) / along));
    };
    for (int i = 0; i < across; ++i)
        for (int k = 0; k < along; ++k)
            for (const auto& [x, y] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 0),
                                       std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)})
                shape.push_back(corner(i + x, k + y));
}

Triangles heightfield(double side, int cells, const std::function<double(double, double)>& height)
{
    Triangles shape;
    addSheet(shape, cells, cells, [&](double u, double v) {
        const double x = side * (u - 0.5);
        const double z = side * (v - 0.5);
        return glm::dvec3(x, height(x, z), z);
    });
    return shape;
}

void addBall(Triangles& shape, glm::dvec3 centre, glm::dvec3 radii, double lowest = -0.5 * pi)
{
    addSheet(shape, 32, 16, [&](double u, double v) {
        const double turn = 2.0 * pi * u;
        const double rise = 0.5 * pi + (lowest - 0.5 * pi) * v;
        return centre + radii * glm::dvec3(std::cos(rise) * std::cos(turn), std::sin(rise),
                                           -std::cos(rise) * std::sin(turn));
    });
}

/// A tube around a ring of the (x, y) plane, from angle 0 to `end`, or of the (x, z) plane.
void addTube(Triangles& shape, double ring, double tube, double end, bool isLying)
{
    addSheet(shape, 48, 16, [&](double u, double v) {
        const double turn = end * u;
        const double around = 2.0 * pi * v;
        const double out = ring + tube * std::cos(around);
        const double aside = tube * std::sin(around);
        return isLying ? glm::dvec3(out * std::cos(turn), aside, out * std::sin(turn))
                       : glm::dvec3(out * std::cos(turn), out * std::sin(turn), -aside);
    });
}

Triangles cliff()
{
    // The plateau hangs over the land before it.
    const std::vector<glm::dvec2> profile{{-20, 0}, {0, 0}, {0, 3}, {-3, 8}, {-3, 9}, {20, 9}};
    Triangles shape;
    addSheet(shape, 20, 5, [&](double u, double v) {
        const glm::dvec2 place = profile[static_cast<std::size_t>(std::lround(5.0 * v))];
        return glm::dvec3(40.0 * (u - 0.5), place.y, place.x);
    });
    return shape;
}

Triangles islands()
{
    Triangles shape;
    for (std::uint64_t i = 0; i < 30; ++i) {
        const auto dice = [i](std::uint32_t d) { return uniform(presetSeed, i, d); };
        const double size = 3.0 + 4.0 * dice(3);
        addBall(shape, {100.0 * dice(0), 12.0 * dice(1), 100.0 * dice(2)},
                {size, 0.4 * size, size});
    }
    return shape;
}

double hillAt(double x, double z)
{
    return 3.0 * std::sin(0.31 * x) * std::cos(0.23 * z) + 1.1 * std::sin(0.7 * z + 0.4 * x);
}

/// A field on a shape: roots uniform per area, upright on their triangles.
field::Field fieldOn(const Triangles& shape, glm::dvec3 origin, glm::vec3 up)
{
    field::Field field = test::emptyField();
    field.origin = origin;
    field.defaults.gravityDirection = -up;
    std::vector<double> areas{0.0};
    Aabb box;
    for (std::size_t i = 0; i < shape.size(); i += 3) {
        const glm::vec3 normal = glm::cross(shape[i + 1] - shape[i], shape[i + 2] - shape[i]);
        areas.push_back(areas.back() + double(glm::length(normal)));
        for (std::size_t k = i; k < i + 3; ++k) {
            box.add(shape[k]);
            shared::GroundVertex vertex = {};
            vertex.position = shape[k];
            field.ground.vertices.push_back(vertex);
            field.ground.indices.push_back(static_cast<std::uint32_t>(k));
        }
    }
    shared::GroundMaterial material = {};
    material.baseColor = glm::vec4(1.0f);
    material.image = shared::noImage;
    field.ground.materials.push_back(material);
    field.ground.ranges.push_back({.indexCount = static_cast<std::uint32_t>(shape.size())});

    const glm::vec3 size = box.size();
    shared::Patch cell = {};
    cell.parent = cell.firstChild = shared::noPatch;
    cell.boundsLow = box.low - 0.01f * size;
    cell.boundsHigh = box.high + 0.01f * size;
    cell.rootLow = box.low;
    cell.rootStep = std::max({size.x, size.y, size.z}) / 65535.0f;
    cell.heightLow = 0.002f * std::max({size.x, size.y, size.z});
    cell.widthLow = 0.1f * cell.heightLow;
    cell.bladeCount = bladeCount;
    for (std::size_t i = 0; i < bladeCount; ++i) {
        const double place = uniform(presetSeed, i, 0) * areas.back();
        const auto found = std::upper_bound(areas.begin(), areas.end(), place) - areas.begin();
        const glm::vec3* const corner = &shape[3 * static_cast<std::size_t>(found - 1)];
        auto b = static_cast<float>(uniform(presetSeed, i, 1));
        auto c = static_cast<float>(uniform(presetSeed, i, 2));
        if (b + c > 1.0f) {
            b = 1.0f - b;
            c = 1.0f - c;
        }
        shared::Blade blade = {};
        blade.root = corner[0] + b * (corner[1] - corner[0]) + c * (corner[2] - corner[0]);
        blade.up = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
        blade.height = cell.heightLow;
        blade.width = cell.widthLow;
        field.blades.push_back(shared::packBlade(blade, cell));
        field.keys.push_back({static_cast<std::uint32_t>(i), 0});
    }
    field.patches = {cell};
    return field;
}

struct Shape {
    std::string name;
    Triangles triangles;
    bool isLevel = false; ///< a heightfield
    glm::dvec3 origin{0.0};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
};

std::vector<Shape> allShapes()
{
    std::vector<Shape> shapes;
    shapes.push_back({"plane", heightfield(20, 8, [](double, double) { return 0.0; }), true});
    shapes.push_back({"hills", heightfield(40, 64, hillAt), true});

    shapes.push_back({"sphere", {}});
    addBall(shapes.back().triangles, glm::dvec3(0.0), glm::dvec3(5.0));
    shapes.push_back({"torus", {}});
    addTube(shapes.back().triangles, 4.0, 1.5, 2.0 * pi, true);
    shapes.push_back({"cliff", cliff()});
    shapes.push_back({"arch", heightfield(20, 8, [](double, double) { return 0.0; })});
    addTube(shapes.back().triangles, 4.0, 0.8, pi, false);

    // Four slopes around a flat top of a few triangles.
    shapes.push_back({"low-poly mountain",
                      heightfield(24, 4,
                                  [](double x, double z) {
                                      return std::max(std::abs(x), std::abs(z)) < 7.0 ? 12.0 : 0.0;
                                  }),
                      true});
    shapes.push_back({"cave", heightfield(30, 8, [](double, double) { return 0.0; })});
    addBall(shapes.back().triangles, {4.0, 0.0, 4.0}, glm::dvec3(9.0), 0.1);
    shapes.push_back({"30 islands", islands()});
    shapes.push_back(
        {"2 km at UTM coordinates",
         heightfield(2000, 128,
                     [](double x, double z) { return 20.0 * hillAt(0.02 * x, 0.02 * z); }),
         true,
         {500'000.0, 300.0, 5'200'000.0}});
    // Hills of 30 cm whose up-vector is z.
    shapes.push_back(
        {"Z-up centimetres",
         heightfield(0.3, 64,
                     [](double x, double z) { return 0.01 * hillAt(100.0 * x, 100.0 * z); }),
         true,
         {3.0, -2.0, 1.0},
         {0.0f, 0.0f, 1.0f}});
    for (glm::vec3& corner : shapes.back().triangles)
        corner = {corner.x, -corner.z, corner.y};
    return shapes;
}

/// Right, up and forward of a camera, scaled to half a picture at distance 1.
struct Axes {
    glm::dvec3 forward, right, above;

    explicit Axes(const Camera& camera)
    {
        forward = glm::normalize(camera.target - camera.eye);
        const double tangent = std::tan(0.5 * glm::radians(double(camera.fovY)));
        const glm::dvec3 side = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
        above = tangent * glm::cross(side, forward);
        right = tangent * double(aspect) * side;
    }
};

/// Share of the pixels that show ground.
double groundShare(const GroundSurface& surface, const Camera& camera)
{
    const Axes axes(camera);
    int hits = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const glm::dvec3 ray = axes.forward + (2.0 * (x + 0.5) / columns - 1.0) * axes.right +
                                   (1.0 - 2.0 * (y + 0.5) / rows) * axes.above;
            hits += surface.hit(camera.eye, ray) ? 1 : 0;
        }
    return double(hits) / (columns * rows);
}

class Presets : public testing::TestWithParam<std::size_t> {
protected:
    Presets()
        : shape_(allShapes()[GetParam()])
        , field_(fieldOn(shape_.triangles, shape_.origin, shape_.up))
        , surface_(viewOf(field_))
        , sun_(glm::normalize(glm::dvec3(FrameSettings::of(viewOf(field_)).sunDirection)))
    {
    }

    Camera camera(CameraPreset preset) const
    {
        return presetCamera(preset, viewOf(field_),
                            {.groundUp = shape_.up, .aspect = aspect, .surface = &surface_});
    }

    /// Without the component along the up-vector.
    glm::dvec3 level(const glm::dvec3& v) const
    {
        const glm::dvec3 up(shape_.up);
        return glm::normalize(v - up * glm::dot(v, up));
    }

    Shape shape_;
    field::Field field_;
    GroundSurface surface_;
    glm::dvec3 sun_;
};

TEST_P(Presets, FitFillsThePictureFromTheSunnySide)
{
    const Camera fit = camera(CameraPreset::fit);
    const Axes axes(fit);
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::vec3& corner : shape_.triangles) {
        const glm::dvec3 way = shape_.origin + glm::dvec3(corner) - fit.eye;
        const double depth = glm::dot(way, axes.forward);
        ASSERT_GT(depth, 0.0);
        const glm::dvec2 place =
            glm::dvec2(glm::dot(way, axes.right) / glm::dot(axes.right, axes.right),
                       glm::dot(way, axes.above) / glm::dot(axes.above, axes.above)) /
            depth;
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    EXPECT_GT(std::min(low.x, low.y), -0.93) << shape_.name;
    EXPECT_LT(std::max(high.x, high.y), 0.93) << shape_.name;
    EXPECT_GT(0.5 * std::max(high.x - low.x, high.y - low.y), 0.6) << shape_.name;

    // The sun is beside the camera or behind it, but not in its back.
    const double towardsSun = glm::dot(level(axes.forward), level(sun_));
    EXPECT_LT(towardsSun, 0.0) << shape_.name;
    EXPECT_GT(towardsSun, -0.9) << shape_.name;
    if (shape_.isLevel) {
        const glm::dvec3 horizon = level(axes.forward);
        EXPECT_LT(glm::dot(horizon, axes.above) / glm::dot(axes.above, axes.above) /
                      glm::dot(horizon, axes.forward),
                  0.95)
            << shape_.name;
    }
}

TEST_P(Presets, EyeStandsFreelyAndSeesGround)
{
    const Camera eye = camera(CameraPreset::eye);
    EXPECT_GT(groundShare(surface_, eye), 1.0 / 3.0) << shape_.name;
    EXPECT_LT(groundShare(surface_, eye), 0.95) << shape_.name;

    // Above ground, at the height of a person or of a smaller one, with nothing overhead.
    const glm::dvec3 up(shape_.up);
    const auto below = surface_.hit(eye.eye, -up);
    ASSERT_TRUE(below) << shape_.name;
    const glm::vec3 size = viewOf(field_).bounds().size();
    const double length = double(std::max(size.x, shape_.up.z > 0.5f ? size.y : size.z));
    EXPECT_NEAR(below->distance, 1.7 * std::min(1.0, length / 8.0), 0.02 * below->distance)
        << shape_.name;
    EXPECT_FALSE(surface_.hit(eye.eye, up)) << shape_.name;

    // No wall ahead.
    const auto ahead = surface_.hit(eye.eye, level(eye.target - eye.eye));
    EXPECT_TRUE(!ahead || ahead->distance > 4.0 * below->distance) << shape_.name;
}

INSTANTIATE_TEST_SUITE_P(Shapes, Presets, testing::Range<std::size_t>(0, 11));

// The same camera for the same field, and a side that follows the sun.
TEST(PresetsAndTheSun, FitTurnsWithIt)
{
    const field::Field field = fieldOn(heightfield(40, 64, hillAt), {}, {0.0f, 1.0f, 0.0f});
    const auto fit = [&](glm::vec3 sun) {
        return presetCamera(CameraPreset::fit, viewOf(field),
                            {.aspect = aspect, .sunDirection = sun});
    };
    for (const glm::vec3 sun :
         {glm::vec3(1.0f, 0.7f, 0.0f), glm::vec3(-1.0f, 0.7f, 0.0f), glm::vec3(0.0f, 0.2f, 1.0f)}) {
        const Camera camera = fit(sun);
        EXPECT_LT(glm::dot(camera.target - camera.eye, glm::dvec3(sun.x, 0.0f, sun.z)), 0.0);
        EXPECT_EQ(camera.eye, fit(sun).eye);
    }
    // A sun in the zenith leaves the side open.
    EXPECT_TRUE(std::isfinite(glm::length(fit({0.0f, 1.0f, 0.0f}).eye)));
}

} // namespace
} // namespace sward::render
