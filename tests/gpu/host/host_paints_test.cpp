// A host that bakes and paints in its own process: bake::Session's changes go to Grass::edit().

#include "bake/session/session.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;

class HostPaintsTest : public test::GrassTest {
protected:
    std::vector<std::byte> drawn(Grass& grass) const
    {
        const HostPicture picture(context(), {});
        const std::array<const HostPicture*, 1> pictures{&picture};
        // Blades come to rest in between.
        for (const double time : {0.0, 60.0})
            drawFrame(grass, time + time_, {&view_, 1}, pictures);
        time_ += 100.0;
        return picture.pixels();
    }

    const HostView view_{
        .worldToClip = test::perspective(true) *
                       glm::lookAt(glm::dvec3(-8.0, 9.0, -12.0), {2.0, 0.0, 0.0}, {0.0, 1.0, 0.0}),
        .size = test::hostSize,
        .geometry = Geometry::tessellation};
    mutable double time_ = 0.0;
};

TEST_F(HostPaintsTest, ShowsTheFieldOfTheSession)
{
    const terrain::GroundMesh ground = meshes::square(40.0);
    bake::BakeSettings settings = tests::plainSettings(20.0);
    settings.bladeScale = 4.0;
    Diagnostics diagnostics;
    Progress progress;
    bake::Session session(ground, settings, 2, diagnostics, progress);
    field::Field first = session.field();
    settings_ = FrameSettings::of(field::viewOf(first));
    settings_.winds.clear();
    settings_.levelOfDetail = false;
    settings_.thatch = 0.0f;
    const auto lawn = std::make_shared<ResidentField>(context(), std::move(first),
                                                      FieldBudget{.isEditable = true});
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    Grass grass(context(), oneSlot_);
    grass.add({lawn, {}});
    const auto unpainted = drawn(grass);

    const bake::Stroke stroke = {.kind = bake::StrokeKind::erase,
                                 .radius = 4.0,
                                 .species = {},
                                 .points = {{-6000, 0, 0}, {10'000, 0, 3000}}, // [mm]
                                 .normals = {}};
    const bake::Session::Change change = session.apply({"host", {stroke}}, progress);
    grass.edit(*lawn, session.deltaOf(change.cells));
    const auto painted = drawn(grass);
    EXPECT_GT(test::pixelsApart(painted, unpainted, 2), 500u);
    {
        const field::Field now = session.field();
        Grass anew(context(), oneSlot_);
        anew.add({upload(now), {}});
        EXPECT_LE(test::pixelsApart(painted, drawn(anew), 2), 40u);
    }
    const bake::Session::Change undone = session.apply({}, progress);
    grass.edit(*lawn, session.deltaOf(undone.cells));
    EXPECT_LE(test::pixelsApart(drawn(grass), unpainted, 2), 40u);
}

} // namespace
} // namespace sward::render
