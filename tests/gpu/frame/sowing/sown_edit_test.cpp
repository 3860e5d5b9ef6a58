// Edits of a field with seeds: FieldRenderer::apply() sows what has changed again.
#include "bake/session/session.h"
#include "bake/settings/meadow.h"
#include "core/diagnostics.h"
#include "core/error.h"
#include "core/progress.h"
#include "field/inspect.h"
#include "field/seeds/seeds.h"
#include "gpu/frame/likeness.h"
#include "gpu/frame/picture.h"
#include "support/gpu/gpu_fixture.h"
#include "support/meshes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 pictureSize(160, 100);

bake::BakeSettings sownSettings()
{
    bake::BakeSettings settings;
    settings.meadow = bake::loadMeadow("meadow");
    settings.density = 60.0;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.seeds = bake::SeedUse::always;
    settings.budget = 20'000;
    return settings;
}

bake::Strokes strokeOf(bake::StrokeKind kind, double value)
{
    bake::Stroke stroke;
    stroke.kind = kind;
    stroke.radius = 4.0;
    stroke.value = value;
    stroke.points = {{-12'000, 0, -14'000}, {-4'000, 0, -2'000}};
    stroke.depth = 1000.0;
    bake::Strokes strokes;
    strokes.list = {stroke};
    return strokes;
}

class SownEditTest : public test::GpuTest {
protected:
    static FieldRenderer::Settings rasterised()
    {
        FieldRenderer::Settings settings;
        settings.samples = 1;
        settings.geometry = Geometry::raster;
        settings.rastersForCpu = false;
        settings.largestTarget = pictureSize;
        settings.waitsForDisk = true;
        settings.isEditable = true;
        return settings;
    }

    static Camera here()
    {
        Camera camera;
        camera.eye = {-20.0, 6.0, -20.0};
        camera.target = {0.0, 0.0, -4.0};
        camera.fovY = 40.0f;
        return camera;
    }

    static FrameSettings calm(const field::Field& field)
    {
        FrameSettings result = FrameSettings::of(field::viewOf(field));
        result.maxLeafArea = 0.0f;
        result.exposure = 1.0f;
        result.winds = {};
        return result;
    }

    Diagnostics diagnostics;
    Progress progress;
    const terrain::GroundMesh ground = meshes::hills(60.0, 30);
};

TEST_F(SownEditTest, SowsWhatTheEditedFieldSows)
{
    bake::Session session(ground, sownSettings(), 2, diagnostics, progress);
    const field::Field before = session.field();
    ASSERT_LT(before.seeds->seeds.meadow.stored, 0.5);
    FieldRenderer edited(device(), field::viewOf(before), rasterised());
    ASSERT_TRUE(edited.isSown());
    test::Picture picture(context(), pictureSize);
    const std::vector<std::byte> black(std::size_t(pictureSize.x) * pictureSize.y * 4);
    picture.draw(edited, here(), calm(before), 1.0);
    const auto first = picture.pixels();
    const auto likenessTo = [&](const std::vector<std::byte>& wanted) {
        return test::likeness(picture.pixels(), wanted, black, pictureSize);
    };
    for (const bake::Strokes& strokes :
         {strokeOf(bake::StrokeKind::erase, 1.0), strokeOf(bake::StrokeKind::height, 2.0),
          strokeOf(bake::StrokeKind::set, 3.0)}) {
        edited.apply(session.deltaOf(session.apply(strokes, progress).cells));
        picture.draw(edited, here(), calm(before), 1.0);
        const auto found = picture.pixels();
        EXPECT_GT(test::differingPixels(found, first), 100U);
        const field::Field after = session.field();
        FieldRenderer fresh(device(), field::viewOf(after), rasterised());
        picture.draw(fresh, here(), calm(before), 1.0);
        EXPECT_EQ(edited.stats().resident, fresh.stats().resident);
        EXPECT_EQ(edited.stats().drawn, fresh.stats().drawn);
        const test::Likeness alike = likenessTo(found);
        // The mean height of the grass, by which light falls into it, stays that of the beginning.
        const bool isTaller = strokes.list.front().kind == bake::StrokeKind::height;
        EXPECT_GT(alike.psnr, isTaller ? 30.0 : 60.0);
        EXPECT_LT(std::abs(alike.worstTile), isTaller ? 6.0 : 0.1);
    }
    // Undone, it is as it was.
    edited.apply(session.deltaOf(session.apply({}, progress).cells));
    picture.draw(edited, here(), calm(before), 1.0);
    EXPECT_GT(likenessTo(first).psnr, 45.0);
}

// Strokes come while a device still grows units of the cells that they change.
TEST_F(SownEditTest, ADeviceGrowsAnewWhatStrokesChange)
{
    bake::Session session(ground, sownSettings(), 2, diagnostics, progress);
    const field::Field before = session.field();
    FieldRenderer waiting(device(), field::viewOf(before), rasterised());
    FieldRenderer::Settings shaders = rasterised();
    shaders.waitsForDisk = false;
    shaders.sowsOnDevice = true;
    shaders.sowThreads = 2;
    FieldRenderer sown(device(), field::viewOf(before), shaders);
    test::Picture picture(context(), pictureSize);
    for (int i = 0; i < 3; ++i)
        picture.draw(sown, here(), calm(before), 1.0);
    for (const bake::Strokes& strokes :
         {strokeOf(bake::StrokeKind::erase, 1.0), strokeOf(bake::StrokeKind::height, 2.0),
          strokeOf(bake::StrokeKind::set, 3.0)}) {
        const field::Delta delta = session.deltaOf(session.apply(strokes, progress).cells);
        waiting.apply(delta);
        sown.apply(delta);
        picture.draw(waiting, here(), calm(before), 1.0);
        const auto expected = picture.pixels();
        std::size_t differing = 1;
        for (int i = 0; i < 2000 && differing > 0; ++i) {
            picture.draw(sown, here(), calm(before), 1.0);
            differing = test::differingPixels(picture.pixels(), expected);
        }
        EXPECT_EQ(differing, 0U);
        EXPECT_EQ(sown.stats().resident, waiting.stats().resident);
    }
}

TEST_F(SownEditTest, StoredBladesKeepTheirStates)
{
    bake::Session session(ground, sownSettings(), 2, diagnostics, progress);
    const field::Field before = session.field();
    FieldRenderer renderer(device(), field::viewOf(before), rasterised());
    FrameSettings windy = FrameSettings::of(field::viewOf(before));
    test::Picture picture(context(), pictureSize);
    for (int i = 0; i < 12; ++i)
        picture.draw(renderer, here(), windy, 1.0 + 0.05 * i);
    const auto tipsOf = [&](const field::Field& field) {
        // Sown blades follow the stored ones.
        std::map<std::uint64_t, FieldRenderer::BladeRecord> tips;
        const auto records = renderer.dumpBlades(field::viewOf(field));
        for (std::size_t i = 0; i < field.blades.size(); ++i)
            if (records[i].lodWidth > 0.0f)
                tips[records[i].id] = records[i];
        return tips;
    };
    const auto first = tipsOf(before);
    // Drier blades are the same ones.
    renderer.apply(
        session.deltaOf(session.apply(strokeOf(bake::StrokeKind::dryness, 1.0), progress).cells));
    picture.draw(renderer, here(), windy, 1.0 + 0.05 * 11);
    const field::Field after = session.field();
    std::size_t kept = 0;
    double sum = 0.0;
    for (const auto& [id, record] : tipsOf(after))
        if (const auto known = first.find(id); known != first.end()) {
            ++kept;
            const double moved = glm::distance(record.v2, known->second.v2);
            ASSERT_NEAR(moved, 0.0, 0.01);
            sum += moved;
        }
    EXPECT_GT(kept, 200U);
    EXPECT_LT(sum / double(kept), 1e-3);
}

TEST_F(SownEditTest, RefusesADeltaOfAFieldThatIsNotEditable)
{
    bake::Session session(ground, sownSettings(), 2, diagnostics, progress);
    const field::Field field = session.field();
    FieldRenderer::Settings settings = rasterised();
    settings.isEditable = false;
    FieldRenderer renderer(device(), field::viewOf(field), settings);
    EXPECT_THROW(renderer.apply(session.deltaOf(
                     session.apply(strokeOf(bake::StrokeKind::erase, 1.0), progress).cells)),
                 Error);
}

} // namespace
} // namespace sward::render
