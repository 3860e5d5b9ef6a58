// Edits of a running field: FieldRenderer::apply().

#include "core/error.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/frame_ring.h"
#include "picture.h"
#include "support/fields/edited_meadow.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

namespace sward::render {
namespace {

constexpr glm::uvec2 size(160, 100);

using test::EditedMeadow;

enum class Way { raster, rasterForCpu, tessellation };

FieldRenderer::Settings settingsOf(Way way)
{
    FieldRenderer::Settings settings;
    settings.samples = 1;
    settings.geometry = way == Way::tessellation ? Geometry::tessellation : Geometry::raster;
    settings.rastersForCpu = way == Way::rasterForCpu;
    settings.isEditable = true;
    return settings;
}

/// Over the cell in the middle and its neighbours.
Camera overMeadow()
{
    Camera camera;
    camera.eye = {-6.0, 7.0, -8.0};
    camera.target = {14.0, 0.0, 16.0};
    camera.fovY = 60.0f;
    return camera;
}

/// Nothing depends on the field as a whole, or on a blade's place.
FrameSettings calm()
{
    FrameSettings settings = FrameSettings::of(field::viewOf(test::emptyField()));
    settings.winds.clear();
    settings.levelOfDetail = false;
    settings.exposure = 1.0f;
    settings.fogDensity = 0.0f;
    settings.thatch = 0.0f;
    settings.updateRate = {.everyFrame = 1e6f, .everyThird = 1e6f};
    return settings;
}

std::map<std::uint64_t, FieldRenderer::BladeRecord> byId(const FieldRenderer& renderer,
                                                         const field::Field& field)
{
    std::map<std::uint64_t, FieldRenderer::BladeRecord> records;
    for (const FieldRenderer::BladeRecord& record : renderer.dumpBlades(field::viewOf(field)))
        records[record.id] = record;
    EXPECT_EQ(records.size(), field.blades.size());
    return records;
}

/// Bytes that differ by more than rounding.
std::size_t plainlyDiffering(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > 2)
            ++differing;
    return differing;
}

class EditTest : public test::GpuTest, public testing::WithParamInterface<Way> {};

TEST_P(EditTest, DrawsTheFieldJoinedAnew)
{
    EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 2000);
    meadow.sow({-1, 0, 0}, 500);
    meadow.changes();
    const field::Field first = meadow.whole();
    FieldRenderer edited(device(), field::viewOf(first), settingsOf(GetParam()));
    test::Picture picture(context(), size);
    double time = 10.0;
    picture.draw(edited, overMeadow(), calm(), time);
    auto before = picture.pixels();
    int seen = 0;
    for (std::uint64_t step = 0; step < 4; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        meadow.sowSome(step + 10);
        edited.apply(meadow.changes());
        // Two edits between frames, now and then.
        if (step % 3 == 0) {
            meadow.sowSome(step + 100);
            edited.apply(meadow.changes());
        }
        time += 0.1;
        picture.draw(edited, overMeadow(), calm(), time);
        seen += test::differingPixels(picture.pixels(), before) > 200 ? 1 : 0;
        // Both come to rest.
        time += 60.0;
        picture.draw(edited, overMeadow(), calm(), time);
        const auto pixels = picture.pixels();
        const field::Field whole = meadow.whole();
        FieldRenderer fresh(device(), field::viewOf(whole), settingsOf(GetParam()));
        test::Picture expected(context(), size);
        expected.draw(fresh, overMeadow(), calm(), time - 60.0);
        expected.draw(fresh, overMeadow(), calm(), time);
        EXPECT_LE(plainlyDiffering(pixels, expected.pixels()), 20u);
        EXPECT_EQ(edited.stats().total, whole.blades.size());
        EXPECT_EQ(test::sumOf(edited.stats()), whole.blades.size());
        EXPECT_NEAR(double(edited.stats().drawn), double(fresh.stats().drawn), 2.0);
        before = pixels;
        const auto states = byId(edited, whole);
        for (const auto& [id, record] : byId(fresh, whole)) {
            if (record.lodWidth > 0.0f) {
                ASSERT_NEAR(glm::distance(states.at(id).v2, record.v2), 0.0, 3e-3);
            }
        }
    }
    EXPECT_GT(seen, 1);
}

TEST_P(EditTest, KeepsTheStatesOfUnchangedBlades)
{
    EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 2500);
    meadow.sow({0, 0, 1}, 800);
    meadow.changes();
    const field::Field first = meadow.whole();
    FieldRenderer renderer(device(), field::viewOf(first), settingsOf(GetParam()));
    FrameSettings windy = calm();
    windy.winds = FrameSettings::of(field::viewOf(test::emptyField())).winds;
    test::Picture picture(context(), size);
    for (int i = 0; i < 20; ++i)
        picture.draw(renderer, overMeadow(), windy, 1.0 + 0.05 * i);
    const auto before = byId(renderer, first);
    const double now = 1.0 + 0.05 * 19;
    meadow.sow({0, 0, 0}, 2600, 0.8);
    meadow.sow({-3, 0, 40}, 700);
    const field::Delta delta = meadow.changes();
    renderer.apply(delta);
    picture.draw(renderer, overMeadow(), windy, now);
    const field::Field whole = meadow.whole();
    std::size_t kept = 0;
    std::size_t added = 0;
    for (const auto& [id, record] : byId(renderer, whole)) {
        const auto known = before.find(id);
        if (known == before.end()) {
            // It is not upright any more when it is first drawn.
            added += record.lodWidth > 0.0f ? 1 : 0;
            if (record.lodWidth > 0.0f) {
                EXPECT_LT(glm::dot(glm::normalize(record.v2 - record.root), glm::dvec3(record.up)),
                          0.9999);
            }
            continue;
        }
        // What is not seen waits to be moved.
        if (record.lodWidth == 0.0f || known->second.lodWidth == 0.0f)
            continue;
        ++kept;
        // Packing rounds heights otherwise in another patch.
        ASSERT_NEAR(glm::distance(record.v2 - record.root, known->second.v2 - known->second.root),
                    0.0, 0.01);
    }
    EXPECT_GT(kept, 200u);
    EXPECT_GT(added, 10u);
}

// Blades that an edit leaves alone look as before, also those thinner than a pixel. They are drawn
// from another place of the buffer, in another order.
TEST_P(EditTest, ChangesThePictureWhereBladesChangeAlone)
{
    EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 3000);
    meadow.sow({1, 0, 0}, 3000);
    meadow.changes();
    const field::Field first = meadow.whole();
    FieldRenderer renderer(device(), field::viewOf(first), settingsOf(GetParam()));
    Camera far = overMeadow();
    far.eye = {-25.0, 20.0, -25.0};
    far.fovY = 35.0f;
    // Ranks of blades change with their number, so nothing is thinned out here.
    FrameSettings settings = calm();
    settings.levelOfDetail = true;
    settings.lodThreshold = 0.0f;
    settings.maxLeafArea = 0.0f;
    test::Picture picture(context(), size);
    const auto atRest = [&](double time) {
        picture.draw(renderer, far, settings, time);
        picture.draw(renderer, far, settings, time + 60.0);
        return picture.pixels();
    };
    const auto before = atRest(0.0);
    meadow.sow({0, 0, 0}, 3003);
    meadow.sow({1, 0, 0}, 0);
    renderer.apply(meadow.changes());
    const auto without = atRest(100.0);
    const std::size_t ofMany = test::differingPixels(without, before);
    meadow.sow({1, 0, 0}, 3000);
    meadow.sow({0, 0, 0}, 3000);
    renderer.apply(meadow.changes());
    EXPECT_LE(plainlyDiffering(atRest(200.0), before), 20u);
    meadow.sow({0, 0, 0}, 3003);
    renderer.apply(meadow.changes());
    const std::size_t ofFew = test::differingPixels(atRest(300.0), before);
    EXPECT_GT(ofMany, 500u);
    EXPECT_LT(ofFew, ofMany / 10);
}

TEST_P(EditTest, BecomesBareAndGrowsAgain)
{
    EditedMeadow meadow(200.0f);
    const field::Field bare = meadow.whole();
    FieldRenderer renderer(device(), field::viewOf(bare), settingsOf(GetParam()));
    test::Picture picture(context(), size);
    picture.draw(renderer, overMeadow(), calm(), 0.0);
    const auto empty = picture.pixels();
    EXPECT_EQ(renderer.stats().total, 0u);
    for (int round = 1; round < 4; ++round) {
        meadow.sow({0, 0, 0}, 3000);
        renderer.apply(meadow.changes());
        picture.draw(renderer, overMeadow(), calm(), round);
        EXPECT_EQ(renderer.stats().total, 3000u);
        EXPECT_GT(renderer.stats().drawn, 300u);
        EXPECT_GT(test::differingPixels(picture.pixels(), empty), 600u);
        meadow.sow({0, 0, 0}, 0);
        renderer.apply(meadow.changes());
        picture.draw(renderer, overMeadow(), calm(), round + 0.5);
        EXPECT_EQ(renderer.stats().total, 0u);
        EXPECT_EQ(test::differingPixels(picture.pixels(), empty), 0u);
    }
}

TEST_P(EditTest, GoesOnWithSeveralFramesInFlight)
{
    EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 1000);
    meadow.changes();
    const field::Field first = meadow.whole();
    FieldRenderer::Settings wanted = settingsOf(GetParam());
    wanted.framesInFlight = 3;
    FieldRenderer renderer(device(), field::viewOf(first), wanted);
    gpu::FrameRing ring(context(), wanted.framesInFlight);
    const gpu::Image target(context(), {.name = "picture",
                                        .format = VK_FORMAT_R8G8B8A8_SRGB,
                                        .extent = {size.x, size.y},
                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                 VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    for (std::uint64_t i = 0; i < 40; ++i) {
        const gpu::FrameRing::Frame frame = ring.begin();
        if (i >= wanted.framesInFlight) {
            const FrameStats stats = renderer.stats(frame.slot);
            EXPECT_EQ(test::sumOf(stats), stats.total) << "frame " << i;
        }
        if (i % 2 == 0) {
            meadow.sowSome(i);
            // Lets every buffer grow.
            if (i == 20)
                meadow.sow({1, 0, 1}, 20'000);
            renderer.apply(meadow.changes());
        }
        gpu::transition(frame.commands, target, gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
        renderer.record(frame.commands, {target.get(), target.view(), size}, overMeadow(), calm(),
                        0.02 * double(i), frame.slot);
        ring.submit(frame);
    }
    ring.finish();
    const field::Field whole = meadow.whole();
    FieldRenderer fresh(device(), field::viewOf(whole), settingsOf(GetParam()));
    test::Picture expected(context(), size);
    expected.draw(fresh, overMeadow(), calm(), 0.8);
    test::Picture picture(context(), size);
    picture.draw(renderer, overMeadow(), calm(), 0.8);
    EXPECT_LE(plainlyDiffering(picture.pixels(), expected.pixels()), 100u);
}

INSTANTIATE_TEST_SUITE_P(EveryGeometry, EditTest,
                         testing::Values(Way::raster, Way::rasterForCpu, Way::tessellation));

class EditRefusalTest : public test::GpuTest {};

TEST_F(EditRefusalTest, NamesWhatCannotBeEdited)
{
    EditedMeadow meadow(200.0f);
    meadow.sow({0, 0, 0}, 2000);
    const field::Field field = meadow.whole();
    const field::Delta delta = meadow.changes();
    const auto kindOf = [&](const FieldRenderer::Settings& settings, const field::Delta& applied) {
        FieldRenderer renderer(device(), field::viewOf(field), settings);
        try {
            renderer.apply(applied);
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::runtime;
    };
    FieldRenderer::Settings settings = settingsOf(Way::raster);
    field::Delta elsewhere = delta;
    elsewhere.origin.y = 1.0;
    EXPECT_EQ(kindOf(settings, elsewhere), ErrorKind::input);
    settings.isEditable = false;
    EXPECT_EQ(kindOf(settings, delta), ErrorKind::usage);
}

} // namespace
} // namespace sward::render
