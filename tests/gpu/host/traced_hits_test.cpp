// What the rasteriser shows in a pixel is what a ray through its middle meets.

#include "host_picture.h"
#include "trace/camera.h"
#include "trace/ray_scene.h"
#include "trace/tracer.h"

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sward {
namespace {

using test::HostPicture;

// Blades are one to three pixels wide; the rasteriser rounds edges to 1/256 of a pixel.
constexpr glm::uvec2 pictureSize = 6u * test::hostSize;

// Distance along the view [m] of a reversed depth of test::perspective(): 0.1 to 200 m.
float distanceOf(float depth)
{
    if (depth <= 0.0f)
        return std::numeric_limits<float>::infinity();
    return 0.1f * 200.0f / (depth * (200.0f - 0.1f) + 0.1f);
}

class TracedHitsTest : public test::GrassTest {
protected:
    // As geometry is: no wind, no widening, no blade left out, chords like those of the tracer.
    void SetUp() override
    {
        test::GrassTest::SetUp();
        settings_.winds.clear();
        settings_.cullMask = 0;
        settings_.levelOfDetail = false;
        settings_.tessellationLevel = 32;
        field_.ground = {};
    }

    // Distances that the rasteriser has in the middles of pixels.
    std::vector<float> drawn(glm::dvec3 eye)
    {
        const HostPicture picture(context(), {.size = pictureSize});
        render::HostView view = test::lookingFrom(eye);
        view.size = pictureSize;
        view.geometry = render::Geometry::raster;
        rasters_ = true;
        render::Grass grass(context(), oneSlot_);
        grass.add({upload(field_), {}});
        const HostPicture* const pictures[]{&picture};
        drawFrame(grass, 1.0, {&view, 1}, pictures);
        std::vector<float> distances = picture.depths();
        for (float& depth : distances)
            depth = distanceOf(depth);
        return distances;
    }

    // The same of rays.
    std::vector<float> met(glm::dvec3 eye, float curveError) const
    {
        const field::FieldView view = field::viewOf(field_);
        const trace::RayScene scene(
            trace::surfacesOf(view, field::restingPoses(view), {.errors = {.curve = curveError}}));
        const trace::Camera camera{
            .eye = eye, .target = glm::dvec3(0.0), .fovY = glm::degrees(2.0 * std::atan(0.5))};
        trace::Tracer tracer(scene, camera, view.origin, {}, {.size = pictureSize});
        Progress progress;
        tracer.add(1, progress);
        return tracer.layers().depth;
    }
};

// Whether both see nothing, or the same blade: blades of the field are a few centimetres apart.
bool areAtOne(float a, float b)
{
    constexpr float sameBlade = 0.006f; // [m]
    return a == b || std::abs(a - b) < sameBlade;
}

// Shares of pixels.
struct Agreement {
    double same = 0.0; ///< both show the same
    double near = 0.0; ///< a ray through the pixel or one beside it shows the same
};

Agreement agreementOf(const std::vector<float>& raster, const std::vector<float>& rays)
{
    Agreement agreement;
    const int width = int(pictureSize.x);
    const int height = int(pictureSize.y);
    const double each = 1.0 / double(raster.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float shown = raster[std::size_t(y * width + x)];
            bool isNear = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                    isNear = isNear || areAtOne(shown, rays[std::size_t(v * width + u)]);
            agreement.near += isNear ? each : 0.0;
            agreement.same += areAtOne(shown, rays[std::size_t(y * width + x)]) ? each : 0.0;
        }
    return agreement;
}

TEST_F(TracedHitsTest, AreWhatTheRasteriserShows)
{
    const glm::dvec3 eye(-0.5, 0.9, 2.4);
    const std::vector<float> raster = drawn(eye);
    EXPECT_GT(std::count_if(raster.begin(), raster.end(), [](float d) { return std::isfinite(d); }),
              std::ptrdiff_t(raster.size() / 8));
    const Agreement usual = agreementOf(raster, met(eye, field::RowErrors().curve));
    EXPECT_GE(usual.near, 0.995);
    EXPECT_GE(usual.same, 0.97);
    // What is left is due to the chords of the strips.
    const Agreement fine = agreementOf(raster, met(eye, 0.1f * field::RowErrors().curve));
    EXPECT_GE(fine.near, 0.999);
    EXPECT_GE(fine.same, 0.995);
}

} // namespace
} // namespace sward
