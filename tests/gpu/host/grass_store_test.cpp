// Grass that is stored into a host's picture is the grass that a composite draws over it.

#include "core/error.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "store_canvas.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::StoreCanvas;

constexpr float step = 1.0f / 255.0f; ///< of 8 bits

/// Colours of 8 bits as 0 … 1.
std::vector<glm::vec4> colorsOf(const HostPicture& picture)
{
    const std::vector<std::byte> bytes = picture.pixels();
    std::vector<glm::vec4> colors(bytes.size() / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        colors[i / 4][static_cast<glm::length_t>(i % 4)] =
            step * static_cast<float>(std::to_integer<int>(bytes[i]));
    return colors;
}

/// The largest difference of a channel.
float apartBy(glm::vec4 a, glm::vec4 b)
{
    const glm::vec4 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z, d.w});
}

/// Of a canvas: a whole number of steps in each channel.
constexpr glm::vec4 background(0.2f, 0.4f, 0.8f, 1.0f);

/// What a composite looks like over the background: it is drawn over nothing.
glm::vec4 overBackground(glm::vec4 drawn)
{
    return drawn + (1.0f - drawn.w) * background;
}

/// Whether 8 bits are those of the background.
bool isBackground(glm::vec4 color)
{
    return apartBy(color, background) < 0.01f * step;
}

class GrassStoreTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        if (!context().features.bufferInt64Atomics)
            GTEST_SKIP() << "the device has no 64-bit atomics";
        // Freeze the blades, so that frames are equal.
        settings_.winds.clear();
        rasters_ = true;
        resident_ = upload(field_);
    }

    static HostView viewFrom(glm::dvec3 eye, std::uint32_t samples = 1, bool isReversed = true)
    {
        HostView view = test::lookingFrom(eye, isReversed);
        view.geometry = Geometry::raster;
        view.samples = samples;
        return view;
    }

    /// Adds the field `count` times, turned.
    void addTo(Grass& grass, int count) const
    {
        for (int i = 0; i < count; ++i)
            grass.add({resident_,
                       {.position = {0.4 * i, 0.0, -0.3 * i},
                        .rotation = glm::angleAxis(0.7 * i, glm::dvec3(0.0, 1.0, 0.0))}});
    }

    /// Stores one frame's views into a canvas, in one command buffer. `walls`: of each view, or
    /// null. Their depths hide grass.
    void store(Grass& grass, std::vector<HostView> views, const StoreCanvas& canvas,
               const std::vector<const HostPicture*>& walls, double distance) const
    {
        for (std::size_t i = 0; i < views.size(); ++i)
            if (walls[i] != nullptr)
                views[i].depth = walls[i]->depth();
        grass.begin(0, {.time = 1.0, .views = views, .settings = settings_, .light = light_});
        gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
            grass.recordUpdate(commands);
            canvas.recordScene(commands);
            for (std::uint32_t view = 0; view < views.size(); ++view) {
                EXPECT_EQ(grass.whyNotStored(view), nullptr);
                if (walls[view] != nullptr)
                    walls[view]->recordWall(commands, distance);
                grass.recordCull(commands, view);
                grass.recordRaster(commands, view);
            }
            canvas.recordEnd(commands);
        });
    }

    std::shared_ptr<ResidentField> resident_;
};

/// Each shader has its turn with either number of samples and, of these, one convention of depth.
struct StoreKind {
    std::uint32_t samples;
    bool isReversed;
    int instances;
    bool hasLamps;
};
constexpr StoreKind storeKinds[]{{1, true, 1, false},  {1, false, 1, true},  {1, true, 3, false},
                                 {1, false, 3, true},  {4, false, 1, false}, {4, true, 1, true},
                                 {4, false, 3, false}, {4, true, 3, true}};

TEST_F(GrassStoreTest, IsWhatACompositeLaysOverTheHostsPicture)
{
    const HostLamp lamps[]{{.position = {0.5, 1.5, 0.5}, .range = 9.0f}};
    for (const auto& [samples, isReversed, instances, hasLamps] : storeKinds) {
        SCOPED_TRACE(testing::Message() << samples << " samples, reversed " << isReversed << ", "
                                        << instances << " instances, lamps " << hasLamps);
        light_.lamps = {};
        if (hasLamps)
            light_.lamps = lamps;
        const HostPicture::Settings target{.isReversed = isReversed, .samples = samples};
        const HostPicture composite(context(), target);
        const HostPicture wall(context(), target);
        const StoreCanvas canvas(context(), {});
        HostView view = viewFrom({2.0, 2.5, 4.0}, samples, isReversed);
        view.depth = composite.depth();
        Grass grass(context(), oneSlot_);
        addTo(grass, instances);
        const HostPicture* const pictures[]{&composite};
        // The wall hides the left half of some blades and is hidden by others.
        drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 5.2);
        EXPECT_NE(grass.whyNotStored(0), nullptr);
        view.stored = canvas.picture();
        store(grass, {view}, canvas, {&wall}, 5.2);

        const std::vector<glm::vec4> drawn = colorsOf(composite);
        const std::vector<glm::vec4> stored = canvas.colors();
        const std::vector<float> nearest =
            samples == 1 ? composite.depths()
                         : test::nearestOfFour(context(), composite.depthImage(), isReversed);
        const std::vector<float> depths = canvas.depths();
        // Four samples are rounded to 8 bits before they are resolved.
        const float most = samples == 1 ? 1.01f * step : 2.01f * step;
        std::size_t covered = 0;
        std::size_t apart = 0;
        std::size_t deeper = 0;
        for (std::size_t i = 0; i < test::hostPixels; ++i) {
            const bool isGrass = drawn[i].w > 0.0f;
            covered += isGrass ? 1u : 0u;
            apart += apartBy(stored[i], overBackground(drawn[i])) > most ? 1u : 0u;
            apart += !isGrass && !isBackground(stored[i]) ? 1u : 0u;
            deeper += depths[i] != (isGrass ? nearest[i] : StoreCanvas::depthBefore);
        }
        EXPECT_EQ(apart, 0u);
        EXPECT_EQ(deeper, 0u);
        EXPECT_GT(covered, test::hostPixels / 10);
        EXPECT_LT(covered, test::hostPixels);
    }
}

TEST_F(GrassStoreTest, PutsTwoViewsIntoTheirPartsOfAPicture)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        SCOPED_TRACE(samples);
        Grass grass(context(), oneSlot_);
        addTo(grass, 2);
        const StoreCanvas canvas(context(),
                                 {.size = {2 * test::hostSize.x + 5, test::hostSize.y + 9}});
        std::vector<HostView> views{viewFrom({2.0, 2.5, 4.0}, samples),
                                    viewFrom({-3.0, 1.5, 3.0}, samples)};
        const HostPicture::Settings target{.samples = samples};
        const HostPicture left(context(), target);
        const HostPicture right(context(), target);
        const HostPicture* const pictures[]{&left, &right};
        drawFrame(grass, 1.0, views, pictures);
        const glm::uvec2 firsts[]{{2, 9}, {test::hostSize.x + 4, 3}};
        for (std::size_t i = 0; i < 2; ++i) {
            views[i].stored = canvas.picture();
            views[i].stored->first = firsts[i];
        }
        store(grass, views, canvas, {nullptr, nullptr}, 0.0);

        const std::vector<glm::vec4> stored = canvas.colors();
        const std::uint32_t width = 2 * test::hostSize.x + 5;
        std::size_t kept = 0;
        for (const glm::vec4& color : stored)
            kept += isBackground(color) ? 1u : 0u;
        EXPECT_GT(kept, stored.size() / 3);
        for (std::size_t i = 0; i < 2; ++i) {
            const std::vector<glm::vec4> drawn = colorsOf(*pictures[i]);
            std::size_t apart = 0;
            for (std::uint32_t y = 0; y < test::hostSize.y; ++y)
                for (std::uint32_t x = 0; x < test::hostSize.x; ++x) {
                    const glm::vec4& one = drawn[y * test::hostSize.x + x];
                    const glm::vec4& other = stored[(firsts[i].y + y) * width + firsts[i].x + x];
                    apart += apartBy(other, overBackground(one)) > 2.01f * step ? 1u : 0u;
                }
            EXPECT_EQ(apart, 0u) << i;
            EXPECT_GT(pictures[i]->covered(), test::hostPixels / 20);
        }
        // Nothing lies outside of both views.
        for (std::uint32_t x = 0; x < width; ++x)
            EXPECT_TRUE(isBackground(stored[x])) << x;
    }
}

TEST_F(GrassStoreTest, KeepsRadianceAndEncodesForScreens)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        SCOPED_TRACE(samples);
        Grass grass(context(), oneSlot_);
        addTo(grass, 1);
        const HostView plain = viewFrom({2.0, 2.5, 4.0}, samples);
        const auto stored = [&](const StoreCanvas& canvas, const StoredPicture& picture) {
            HostView view = plain;
            view.stored = picture;
            store(grass, {view}, canvas, {nullptr}, 0.0);
            return canvas.colors();
        };

        // Radiance, within the rounding of a composite's.
        const HostPicture radiant(context(), {.samples = samples, .keepsRadiance = true});
        const HostPicture* const pictures[]{&radiant};
        drawFrame(grass, 1.0, {&plain, 1}, pictures);
        const std::vector<glm::vec4> drawn = radiant.radiance();
        const StoreCanvas floats(context(), {.format = VK_FORMAT_R16G16B16A16_SFLOAT});
        StoredPicture radiance = floats.picture();
        radiance.keepsRadiance = true;
        radiance.depth = VK_NULL_HANDLE;
        const std::vector<glm::vec4> kept = stored(floats, radiance);
        std::size_t covered = 0;
        std::size_t apart = 0;
        for (std::size_t i = 0; i < test::hostPixels; ++i) {
            covered += drawn[i].w > 0.0f ? 1u : 0u;
            const glm::vec4 expected = overBackground(drawn[i]);
            const float largest = std::max({expected.x, expected.y, expected.z});
            apart += apartBy(kept[i], expected) > largest / 256.0f + 1e-4f ? 1u : 0u;
        }
        EXPECT_EQ(apart, 0u);
        EXPECT_GT(covered, test::hostPixels / 10);
        for (const float depth : floats.depths())
            ASSERT_EQ(depth, StoreCanvas::depthBefore);

        // Developed colours, without and with the encoding of sRGB, and blue first.
        const StoreCanvas linear(context(), {.format = VK_FORMAT_R16G16B16A16_SFLOAT});
        const std::vector<glm::vec4> developed = stored(linear, linear.picture());
        const StoreCanvas encoded(context(), {.isSrgb = true});
        const std::vector<glm::vec4> decoded = stored(encoded, encoded.picture());
        const StoreCanvas turned(context(), {.background = {0.8f, 0.4f, 0.2f, 1.0f}});
        StoredPicture blueFirst = turned.picture();
        blueFirst.isBgr = true;
        const std::vector<glm::vec4> swapped = stored(turned, blueFirst);
        std::size_t unlike = 0;
        apart = 0;
        for (std::size_t i = 0; i < test::hostPixels; ++i) {
            apart += apartBy(decoded[i], developed[i]) > 2.0f * step ? 1u : 0u;
            const glm::vec4 back(swapped[i].z, swapped[i].y, swapped[i].x, swapped[i].w);
            apart += apartBy(back, developed[i]) > 1.01f * step ? 1u : 0u;
            unlike += apartBy(kept[i], developed[i]) > 4.0f * step ? 1u : 0u;
        }
        EXPECT_EQ(apart, 0u);
        EXPECT_GT(unlike, test::hostPixels / 20);
    }
}

TEST_F(GrassStoreTest, IsNotDrawnASecondTimeButItsDepthMayBe)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        SCOPED_TRACE(samples);
        Grass grass(context(), oneSlot_);
        addTo(grass, 1);
        const StoreCanvas canvas(context(), {});
        HostView view = viewFrom({2.0, 2.5, 4.0}, samples);
        const HostPicture composite(context(), {.samples = samples});
        const HostPicture* const composites[]{&composite};
        drawFrame(grass, 1.0, {&view, 1}, composites);
        EXPECT_GT(composite.covered(), test::hostPixels / 10);
        view.stored = canvas.picture();
        gpu::submitAndWait(context(),
                           [&](VkCommandBuffer commands) { canvas.recordScene(commands); });
        const HostPicture empty(context(), {.samples = samples});
        const HostPicture* const empties[]{&empty};
        drawFrame(grass, 1.0, {&view, 1}, empties);
        EXPECT_EQ(empty.covered(), 0u);
        const HostPicture depth(context(), {.samples = samples, .hasColor = false});
        const HostPicture* const depths[]{&depth};
        drawFrame(grass, 1.0, {&view, 1}, depths);
        if (samples == 1) {
            EXPECT_EQ(depth.depths(), composite.depths());
        } else {
            EXPECT_EQ(test::nearestOfFour(context(), depth.depthImage(), true),
                      test::nearestOfFour(context(), composite.depthImage(), true));
        }
    }
}

TEST_F(GrassStoreTest, SaysWhyItIsNotStored)
{
    Grass grass(context(), {.framesInFlight = 1, .maxViews = 6});
    addTo(grass, 1);
    const StoreCanvas canvas(context(), {});
    const HostPicture wall(context(), {});
    std::vector<HostView> views(6, viewFrom({2.0, 2.5, 4.0}));
    for (HostView& view : views)
        view.stored = canvas.picture();
    views[1].stored.reset();
    views[2].geometry = Geometry::tessellation;
    views[3].samples = 4;
    views[3].depth = wall.depth();
    views[4].depth = wall.depth();
    views[4].cullViewFrom = views[4].worldToClip;
    views[5].depth = wall.depth();
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    for (std::uint32_t view = 0; view < 6; ++view)
        EXPECT_EQ(grass.whyNotStored(view) == nullptr, view == 0 || view == 5) << view;
    for (const std::uint32_t view : {1u, 3u, 4u})
        EXPECT_EQ(grass.whyTessellated(view), nullptr) << view;
    // Without occlusion nobody reads the depth.
    settings_.cullMask = 0;
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    EXPECT_EQ(grass.whyNotStored(0), nullptr);
    EXPECT_NE(grass.whyNotStored(5), nullptr);
}

TEST_F(GrassStoreTest, RefusesPicturesThatDoNotFit)
{
    Grass grass(context(), oneSlot_);
    addTo(grass, 1);
    const StoreCanvas canvas(context(), {});
    const auto refused = [&](const auto& change) {
        HostView view = viewFrom({2.0, 2.5, 4.0});
        view.stored = canvas.picture();
        change(*view.stored);
        try {
            grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings_});
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage;
        }
        return false;
    };
    EXPECT_FALSE(refused([](StoredPicture&) {}));
    EXPECT_TRUE(refused([](StoredPicture& picture) { picture.color = VK_NULL_HANDLE; }));
    EXPECT_TRUE(refused([](StoredPicture& picture) { picture.format = VK_FORMAT_R8G8B8A8_UINT; }));
    EXPECT_TRUE(refused([](StoredPicture& picture) { picture.size.y = test::hostSize.y - 1; }));
    EXPECT_TRUE(refused([](StoredPicture& picture) { picture.first.x = 1; }));
    EXPECT_TRUE(refused([](StoredPicture& picture) { picture.first.x = 0xffffffffu; }));
    EXPECT_TRUE(refused([](StoredPicture& picture) {
        picture.format = VK_FORMAT_R16G16B16A16_SFLOAT;
        picture.isSrgb = true;
    }));
    EXPECT_TRUE(refused([](StoredPicture& picture) {
        picture.isSrgb = true;
        picture.keepsRadiance = true;
    }));
}

} // namespace
} // namespace sward::render
