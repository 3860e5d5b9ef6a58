// What a host may do wrong is an Error that names it, and leaves everything as it was.

#include "core/error.h"
#include "gpu/context/host_device.h"
#include "gpu/device/device.h"
#include "gpu/device/features.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "render/viewer/field_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;
using testing::HasSubstr;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// Expects Error{usage} with these words.
void expectMisuse(const std::function<void()>& work, const std::vector<std::string>& words)
{
    try {
        work();
        ADD_FAILURE() << "no error about: " << words.front();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
        for (const std::string& word : words)
            EXPECT_THAT(error.what(), HasSubstr(word));
    }
}

class GrassMisuseTest : public test::GrassTest {
protected:
    using Change = std::function<void(HostView&)>;

    gpu::HostDevice host() const
    {
        return {.instance = instance().get(),
                .physical = context().physical,
                .device = context().device,
                .queue = context().queue,
                .queueFamily = context().queueFamily,
                .features = context().features};
    }

    /// A device beside that of the fixture.
    static gpu::Device otherDevice() { return gpu::Device(instance()); }

    void beginWith(Grass& grass, const HostView& view) const
    {
        grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings_});
    }

    /// Records into a buffer that is thrown away.
    void record(const std::function<void(VkCommandBuffer)>& work) const
    {
        gpu::submitAndWait(context(), work);
    }

    std::shared_ptr<ResidentField> resident_ = upload(field_);
    HostView view_ = lookingFrom({1.0, 2.0, 4.0});
};

TEST_F(GrassMisuseTest, ADeviceIsDescribedByTheLoaderOfTheSystem)
{
    const gpu::DeviceContext own = gpu::describeDevice(host());
    EXPECT_EQ(own.name, context().name);

    auto resident = std::make_shared<ResidentField>(own, field::viewOf(field_));
    record([&](VkCommandBuffer commands) { resident->recordUpload(commands); });
    Grass grass(own, oneSlot_);
    grass.add({resident, {}});
    Grass linked(context(), oneSlot_);
    linked.add({resident_, {}});
    EXPECT_LT(test::pixelsApart(drawnAlone(linked, 1.0, view_), drawnAlone(grass, 1.0, view_), 4),
              10u);
}

TEST_F(GrassMisuseTest, ADeviceLacksNoHandle)
{
    using Take = void (*)(gpu::HostDevice&);
    const std::pair<const char*, Take> handles[]{
        {"instance", [](gpu::HostDevice& device) { device.instance = VK_NULL_HANDLE; }},
        {"physical", [](gpu::HostDevice& device) { device.physical = VK_NULL_HANDLE; }},
        {"device", [](gpu::HostDevice& device) { device.device = VK_NULL_HANDLE; }},
        {"queue", [](gpu::HostDevice& device) { device.queue = VK_NULL_HANDLE; }}};
    for (const auto& [name, take] : handles) {
        gpu::HostDevice device = host();
        take(device);
        expectMisuse([&] { gpu::describeDevice(device); },
                     {"HostDevice::" + std::string(name) + " is null"});
    }
    gpu::HostDevice device = host();
    device.queueFamily = 77;
    expectMisuse([&] { gpu::describeDevice(device); }, {"queueFamily is 77", "families"});
    device = host();
    device.memory.allocate = [](void*, const gpu::MemoryRequest&, gpu::MemoryPiece&) {
        return VK_SUCCESS;
    };
    expectMisuse([&] { gpu::describeDevice(device); }, {"HostDevice::memory"});
    device.memory.release = [](void*, const gpu::MemoryPiece&) {};
    const gpu::DeviceContext empty = gpu::describeDevice(device);
    expectMisuse([&] { const ResidentField field(empty, field::viewOf(field_)); },
                 {"HostMemory::allocate"});

    gpu::FeatureChain wanted;
    expectMisuse([&] { gpu::enableFeatures(VK_NULL_HANDLE, wanted); }, {"is null"});
}

TEST_F(GrassMisuseTest, NothingIsMadeWithoutADevice)
{
    const gpu::DeviceContext none;
    const field::FieldView field = field::viewOf(field_);
    expectMisuse([&] { const ResidentField made(none, field); }, {"describes no device"});
    expectMisuse([&] { const Grass made(none, oneSlot_); }, {"describes no device"});
    expectMisuse([&] { const BladeTarget made(none, {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB}}); },
                 {"describes no device"});
    expectMisuse([&] { const FieldRenderer made(none, field, {}); }, {"describes no device"});
    const field::FieldView nothing;
    expectMisuse([&] { const FieldRenderer made(context(), nothing, {}); }, {"no ground"});
    expectMisuse([&] { const ResidentField made(context(), nothing); }, {"no defaults"});
    expectMisuse([&] { windSource(shared::windKinds); }, {"wind kind"});
}

TEST_F(GrassMisuseTest, NumbersOfSettingsAndBudgetsAreBounded)
{
    expectMisuse([&] { const Grass grass(context(), {.framesInFlight = 0}); },
                 {"framesInFlight is 0"});
    expectMisuse([&] { const Grass grass(context(), {.framesInFlight = 17}); }, {"17", "16"});
    expectMisuse([&] { const Grass grass(context(), {.maxViews = 0}); }, {"maxViews is 0"});
    expectMisuse([&] { const Grass grass(context(), {.maxViews = 65}); }, {"65", "64"});
    const std::pair<const char*, FieldBudget> budgets[]{{"framesInFlight", {.framesInFlight = 0}},
                                                        {"instances", {.instances = 0}},
                                                        {"views", {.views = 0}}};
    for (const auto& [name, budget] : budgets)
        expectMisuse(
            [&, &budget = budget] {
                const ResidentField made(context(), field::Field(field_), budget);
            },
            {"FieldBudget::" + std::string(name) + " is 0"});
}

TEST_F(GrassMisuseTest, TargetsAreOfWhatADeviceDraws)
{
    constexpr VkFormat color = VK_FORMAT_R8G8B8A8_SRGB;
    const std::pair<HostTarget, std::vector<std::string>> wrong[]{
        {{.colorFormats = {color}, .writesMotion = true}, {"writesMotion", "second colour"}},
        {{.colorFormats = {VK_FORMAT_UNDEFINED}}, {"format 0 of attachment 0 is undefined"}},
        {{.colorFormats = {VK_FORMAT_D32_SFLOAT}}, {"colorFormats", "126", "is a depth"}},
        {{.colorFormats = {VK_FORMAT_R8G8B8A8_UINT}}, {"41", "holds integers", "fractions"}},
        {{.colorFormats = {VK_FORMAT_R32G32B32A32_SINT}}, {"108", "holds integers"}},
        {{.colorFormats = {VK_FORMAT_A2B10G10R10_UINT_PACK32}}, {"68", "holds integers"}},
        {{.colorFormats = {VK_FORMAT_R8G8B8A8_SSCALED}}, {"40", "scaled"}},
        {{.colorFormats = {VK_FORMAT_BC7_SRGB_BLOCK}}, {"146", "compressed"}},
        {{.colorFormats = {VK_FORMAT_S8_UINT}}, {"127", "is a stencil"}},
        {{.colorFormats = {color, VK_FORMAT_R16G16_SINT}, .writesMotion = true},
         {"attachment 1 holds integers"}},
        {{.colorFormats = {color, VK_FORMAT_D16_UNORM}}, {"attachment 1 is a depth"}},
        {{.colorFormats = {color}, .depthFormat = color}, {"depthFormat", "43", "is a colour"}},
        {{.colorFormats = {color}, .depthFormat = VK_FORMAT_S8_UINT}, {"depthFormat", "127"}},
        {{.colorFormats = {color}, .depthFormat = VK_FORMAT_R32_UINT}, {"98", "holds integers"}},
        {{.colorFormats = {color}, .stencilFormat = VK_FORMAT_D32_SFLOAT}, {"has no stencil"}},
        {{.colorFormats = {color}, .stencilFormat = VK_FORMAT_D32_SFLOAT_S8_UINT},
         {"stencilFormat is 130", "depthFormat is 126"}},
        {{.colorFormats = {}, .depthFormat = VK_FORMAT_UNDEFINED}, {"neither"}},
        {{.colorFormats = {color}, .samples = 3}, {"samples is 3"}},
        {{.colorFormats = {color}, .samples = 0}, {"samples is 0"}},
        {{.colorFormats = std::vector(100, color)}, {"100"}}};
    for (const auto& [target, words] : wrong)
        expectMisuse([&, &target = target] { const BladeTarget made(context(), target); }, words);
    expectMisuse(
        [&] {
            const FieldRenderer made(context(), field::viewOf(field_),
                                     {.colorFormat = VK_FORMAT_R8G8B8A8_UINT, .samples = 1});
        },
        {"colorFormat: format 41 holds integers"});
}

TEST_F(GrassMisuseTest, WhatIsToldOfImagesSuitsTheirUse)
{
    Grass grass(context(), {.framesInFlight = 1, .maxViews = 1});
    grass.add({resident_, {}});
    constexpr VkImageUsageFlags sampled = VK_IMAGE_USAGE_SAMPLED_BIT;
    constexpr VkImageUsageFlags storage = VK_IMAGE_USAGE_STORAGE_BIT;
    constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    const HostPicture picture(context(), {});
    const VkImageView some = picture.depthImage().view();
    const std::array cascades{glm::dmat4(1.0)};
    const auto depth = [&](const HostImage& image) {
        return [&, image](HostView& view) { view.depth = HostDepth{.view = some, .image = image}; };
    };
    const auto shadow = [&](const HostImage& image) {
        return [&, image](HostView& view) {
            view.shadow = HostShadow{.view = some, .worldToShadow = cascades, .image = image};
        };
    };
    const auto stored = [&](StoredPicture told) {
        told.color = some;
        told.size = view_.size;
        return [told](HostView& view) { view.stored = told; };
    };
    constexpr VkFormat bytes = VK_FORMAT_R8G8B8A8_UNORM;
    const std::pair<Change, std::vector<std::string>> wrong[]{
        {depth({.usage = attachment}), {"view 0, depth", "0x20", "VK_IMAGE_USAGE_SAMPLED_BIT"}},
        {depth({VK_FORMAT_S8_UINT, sampled}), {"127", "is a stencil"}},
        {depth({VK_FORMAT_R32_UINT, sampled}), {"98", "holds integers"}},
        {shadow({.usage = attachment}), {"shadow map", "VK_IMAGE_USAGE_SAMPLED_BIT"}},
        {shadow({VK_FORMAT_R32_SFLOAT, sampled}), {"shadow map", "100", "is a colour"}},
        {stored({.image = {.usage = attachment}}), {"picture", "VK_IMAGE_USAGE_STORAGE_BIT"}},
        {stored({.depthImage = {.usage = sampled}}), {"depth", "VK_IMAGE_USAGE_STORAGE_BIT"}},
        {stored({.depthImage = {VK_FORMAT_D32_SFLOAT, storage}}), {"depth", "126", "R32_SFLOAT"}},
        {stored({.image = {bytes, storage}}), {"37", "97"}},
        {stored({.format = bytes, .image = {VK_FORMAT_R8G8B8A8_UINT, storage}}), {"41", "37"}},
        {stored({.format = bytes, .image = {VK_FORMAT_R8G8B8A8_SRGB, storage}}),
         {"isSrgb is false", "43"}},
        {stored({.format = bytes, .isSrgb = true, .image = {VK_FORMAT_B8G8R8A8_SRGB, storage}}),
         {"isBgr is false", "50", "blue first"}},
        {stored({.format = bytes, .isBgr = true, .image = {bytes, storage}}),
         {"isBgr is true", "37", "red first"}}};
    for (const auto& [change, words] : wrong) {
        HostView view = view_;
        change(view);
        expectMisuse([&] { beginWith(grass, view); }, words);
    }
    HostView right = view_;
    right.depth = HostDepth{.view = some, .image = {VK_FORMAT_D32_SFLOAT, sampled | attachment}};
    beginWith(grass, right);
    right.depth->image = {};
    beginWith(grass, right);
}

TEST_F(GrassMisuseTest, ATargetOfOtherSamplesIsNoSilentSlowPath)
{
    if (!context().features.bufferInt64Atomics || !context().features.sampleRateShading)
        GTEST_SKIP() << "the device does not rasterise";
    Grass grass(context(), oneSlot_);
    grass.add({resident_, {}});
    constexpr VkFormat color = VK_FORMAT_R8G8B8A8_SRGB;
    const BladeTarget one(context(), {.colorFormats = {color}});
    const BladeTarget four(context(), {.colorFormats = {color}, .samples = 4});
    const BladeTarget forward(context(), {.colorFormats = {color}, .hasReversedZ = false});
    HostView view = view_;
    view.geometry = Geometry::raster;
    for (const std::uint32_t samples : {1u, 4u}) {
        view.samples = samples;
        beginWith(grass, view);
        EXPECT_EQ(grass.whyTessellated(0), nullptr);
        EXPECT_EQ(grass.whyTessellated(0, samples == 1 ? one : four), nullptr);
        EXPECT_THAT(grass.whyTessellated(0, samples == 1 ? four : one), HasSubstr("samples"));
        expectMisuse([&] { grass.whyTessellated(0, forward); }, {"hasReversedZ"});
        expectMisuse([&] { grass.whyTessellated(1, one); }, {"view 1"});
    }
    view.geometry = Geometry::tessellation;
    beginWith(grass, view);
    EXPECT_THAT(grass.whyTessellated(0, four), HasSubstr("tessellator"));
}

TEST_F(GrassMisuseTest, InstancesAreOfAFieldOfTheDeviceAndPlaced)
{
    Grass grass(context(), oneSlot_);
    expectMisuse([&] { grass.add({nullptr, {}}); }, {"field is null"});
    const std::pair<const char*, Placement> placements[]{
        {"scale is 0", {.scale = 0.0}},
        {"scale is -1", {.scale = -1.0}},
        {"scale is nan", {.scale = notANumber}},
        {"position", {.position = {0.0, notANumber, 0.0}}},
        {"rotation has length 2", {.rotation = {2.0, 0.0, 0.0, 0.0}}}};
    const InstanceId id = grass.add({resident_, {}});
    for (const auto& [words, placement] : placements) {
        expectMisuse([&, &place = placement] { grass.add({resident_, place}); }, {words});
        expectMisuse([&, &place = placement] { grass.move(id, place); }, {words});
    }
    const auto unknown = InstanceId(static_cast<std::uint64_t>(id) + 1);
    expectMisuse([&] { grass.move(unknown, {}); }, {"no instance 2"});
    expectMisuse([&] { grass.remove(unknown); }, {"no instance 2"});
    grass.remove(id);
    expectMisuse([&] { grass.remove(id); }, {"no instance 1"});

    const gpu::Device other = otherDevice();
    const auto elsewhere = std::make_shared<ResidentField>(other.context(), field::viewOf(field_));
    expectMisuse([&] { grass.add({elsewhere, {}}); }, {"another device"});
}

TEST_F(GrassMisuseTest, AFrameThatIsWrongLeavesTheFrameBefore)
{
    Grass grass(context(), {.framesInFlight = 1, .maxViews = 1});
    grass.add({resident_, {}});
    const std::array two{view_, view_};
    const auto begin = [&](const GrassFrame& frame) { grass.begin(0, frame); };
    beginWith(grass, view_);

    expectMisuse([&] { begin({.views = two, .settings = settings_}); },
                 {"2 views", "maxViews is 1"});
    expectMisuse([&] { grass.begin(1, {.settings = settings_}); },
                 {"slot 1", "framesInFlight is 1"});
    expectMisuse([&] { begin({.time = notANumber, .settings = settings_}); }, {"time"});
    expectMisuse([&] { begin({.time = 1e12, .settings = settings_}); }, {"time", "8589934592 s"});
    const std::pair<Change, std::vector<std::string>> wrongViews[]{
        {[](HostView& view) {
             view.size = {0, 90};
         },
         {"view 0", "0 x 90"}},
        {[](HostView& view) {
             view.size = {90, 100000};
         },
         {"100000", "32768"}},
        {[](HostView& view) { view.samples = 3; }, {"3 samples"}},
        {[](HostView& view) { view.worldToClip[1][1] = notANumber; }, {"worldToClip", "finite"}},
        {[](HostView& view) { view.worldToClip = glm::dmat4(0.0); }, {"worldToClip", "inverse"}},
        {[](HostView& view) { view.cullViewFrom = glm::dmat4(0.0); }, {"cullViewFrom"}},
        {[](HostView& view) { view.hasReversedZ = false; },
         {"hasReversedZ is false", "falls with distance by worldToClip"}},
        {[](HostView& view) {
             view.cullViewFrom = lookingFrom({1.0, 2.0, 4.0}, false).worldToClip;
         },
         {"hasReversedZ is true", "grows with distance by cullViewFrom"}},
        {[](HostView& view) { view.clipBefore = glm::dmat4(0.0); }, {"clipBefore"}},
        {[](HostView& view) { view.depth = HostDepth{}; }, {"depth", "null"}},
        {[](HostView& view) { view.shadow = HostShadow{}; }, {"shadow map", "null"}},
        {[](HostView& view) { view.stored = StoredPicture{}; }, {"stored picture"}}};
    for (const auto& [change, words] : wrongViews) {
        HostView view = view_;
        change(view);
        expectMisuse([&] { beginWith(grass, view); }, words);
    }
    const std::vector<HostCollider> many(maxColliders + 1);
    expectMisuse([&] { begin({.settings = settings_, .colliders = many}); }, {"257", "256"});
    const HostCollider flat{.radius = 0.0};
    expectMisuse(
        [&] {
            begin({.settings = settings_, .colliders = {&flat, 1}});
        },
        {"collider 0", "radius is 0"});
    const std::vector<HostLamp> lamps(maxLamps + 1);
    expectMisuse([&] { begin({.settings = settings_, .light = {.lamps = lamps}}); },
                 {"17 lamps", "16"});
    FrameSettings settings = settings_;
    settings.winds.assign(maxWindSources + 1, windSource(windGusts));
    expectMisuse([&] { begin({.settings = settings}); },
                 {std::to_string(maxWindSources + 1) + " winds"});
    settings = settings_;
    settings.sunDirection = glm::vec3(0.0f);
    expectMisuse([&] { begin({.settings = settings}); }, {"sun"});

    // The frame that was begun first is drawn as if nothing had happened.
    const HostPicture picture(context(), {});
    record([&](VkCommandBuffer commands) {
        grass.recordUpdate(commands);
        grass.recordCull(commands, 0);
        picture.record(commands, grass, 0);
    });
    EXPECT_GT(picture.covered(), 500u);
}

TEST_F(GrassMisuseTest, CallsThatAreOutOfOrderRecordNothing)
{
    Grass grass(context(), {.framesInFlight = 1, .maxViews = 2});
    grass.add({resident_, {}});
    const HostPicture picture(context(), {});
    const BladeTarget target(context(), {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB}});
    const BladeTarget forward(context(),
                              {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB}, .hasReversedZ = false});
    const BladeTarget motion(
        context(),
        {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R16G16_SFLOAT}, .writesMotion = true});
    const gpu::Device other = otherDevice();
    const BladeTarget elsewhere(other.context(), {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB}});
    record([&](VkCommandBuffer commands) {
        expectMisuse([&] { grass.recordUpdate(commands); }, {"begin() comes first"});
        expectMisuse([&] { grass.whyTessellated(0); }, {"view 0", "0 views"});
        beginWith(grass, view_);
        expectMisuse([&] { grass.recordUpdate(VK_NULL_HANDLE); }, {"command buffer is null"});
        expectMisuse([&] { grass.recordCull(commands, 0); }, {"recordUpdate()"});
        grass.recordUpdate(commands);
        expectMisuse([&] { grass.recordUpdate(commands); }, {"a second time"});
        expectMisuse([&] { grass.recordRaster(commands, 0); }, {"recordCull()"});
        expectMisuse([&] { grass.recordDraw(commands, 0, target); }, {"recordCull()"});
        expectMisuse([&] { grass.recordCull(commands, 1); }, {"view 1", "1 views"});
        expectMisuse([&] { grass.whyNotStored(1); }, {"view 1"});
        grass.recordCull(commands, 0);
        expectMisuse([&] { grass.recordDraw(VK_NULL_HANDLE, 0, target); }, {"is null"});
        expectMisuse([&] { grass.recordDraw(commands, 0, forward); }, {"hasReversedZ"});
        expectMisuse([&] { grass.recordDraw(commands, 0, motion); }, {"keepsMotion"});
        expectMisuse([&] { grass.recordDraw(commands, 0, elsewhere); }, {"another device"});
        expectMisuse([&] { grass.recordDepth(commands, 0, target); }, {"without colours"});
        picture.record(commands, grass, 0);
    });
    expectMisuse([&] { grass.stats(2, 0); }, {"view 2", "maxViews is 2"});
    expectMisuse([&] { grass.stats(0, 1); }, {"slot 1"});
    EXPECT_GT(picture.covered(), 500u);
}

TEST_F(GrassMisuseTest, UploadsAreRecordedBeforeTheirMemoryIsReleased)
{
    ResidentField field(context(), field::viewOf(field_));
    expectMisuse([&] { field.recordUpload(VK_NULL_HANDLE); }, {"is null"});
    expectMisuse([&] { field.releaseStaging(); }, {"recordUpload()"});
    record([&](VkCommandBuffer commands) { field.recordUpload(commands); });
    field.releaseStaging();
    EXPECT_EQ(field.stagingBytes(), 0u);
}

TEST_F(GrassMisuseTest, AWholePictureRefusesWhatItCannotDraw)
{
    FieldRenderer renderer(context(), field::viewOf(field_), {});
    FieldRenderer::Target target;
    const Camera camera;
    record([&](VkCommandBuffer commands) {
        expectMisuse([&] { renderer.record(VK_NULL_HANDLE, target, camera, settings_, 0.0); },
                     {"command buffer"});
        expectMisuse([&] { renderer.record(commands, target, camera, settings_, 0.0); },
                     {"Target", "null"});
        expectMisuse([&] { renderer.recordUpdateOnly(commands, settings_, 0.0, 1); },
                     {"slot 1", "framesInFlight is 1"});
        FrameSettings settings = settings_;
        settings.colliders.resize(maxColliders + 1);
        expectMisuse([&] { renderer.recordUpdateOnly(commands, settings, 0.0); }, {"257", "256"});
        settings = settings_;
        settings.debug = DebugMode::reason;
        const gpu::Image picture(context(), {.name = "picture",
                                             .format = VK_FORMAT_R8G8B8A8_SRGB,
                                             .extent = {16, 16},
                                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                      VK_IMAGE_USAGE_TRANSFER_DST_BIT});
        target = {.image = picture.get(), .view = picture.view(), .size = {16, 16}};
        expectMisuse([&] { renderer.record(commands, target, camera, settings, 0.0); },
                     {"recordCullResults"});
        expectMisuse([&] { renderer.record(commands, target, {.fovY = 200.0f}, settings_, 0.0); },
                     {"200 degrees"});
        target.size = {0, 16};
        expectMisuse([&] { renderer.record(commands, target, camera, settings_, 0.0); },
                     {"0 x 16"});
    });
    expectMisuse([&] { renderer.stats(1); }, {"slot 1"});
    expectMisuse([&] { renderer.dumpPatch(field::viewOf(field_), 1u << 30); }, {"patch"});
    expectMisuse(
        [&] { const FieldRenderer made(context(), field::viewOf(field_), {.samples = 3}); },
        {"samples is 3"});
}

} // namespace
} // namespace sward::render
