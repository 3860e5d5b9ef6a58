// What the pixels of a frame show, against rays and poses of the CPU.

#include "core/error.h"
#include "gpu/frame/picture.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/frame_ring.h"
#include "presentation/camera_presets.h"
#include "render/layers/frame_layers.h"
#include "shaders/shared/bezier.h"
#include "shaders/shared/layers/layers_table.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "trace/camera.h"
#include "trace/ray_scene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sward::render {
namespace {

constexpr glm::uvec2 size{240, 150};
constexpr double step = 1.0 / 30.0; ///< [s] between frames
constexpr glm::vec3 up(0.0f, 1.0f, 0.0f);

using Records = std::vector<FieldRenderer::BladeRecord>;

/// A frame as it has been drawn.
struct Drawn {
    Camera camera;
    FrameLayers layers;
    Records blades;
    std::vector<std::byte> picture;
};

/// A meadow in wind, seen by a camera that moves.
class Meadow {
public:
    Meadow(const gpu::Device& device, std::uint32_t samples, double eyeHeight = 0.8)
        : context_(device.context())
        , scene_(device, test::makeField({.blades = 2500, .extent = 3.0f, .seed = 5}),
                 settingsFor(samples))
        , target_(context_, size)
    {
        scene_.settings.levelOfDetail = false;
        // Segments, too, are level of detail.
        scene_.settings.tessellationLevel = 64;
        scene_.settings.maxEdgeOn = 1.0f;
        scene_.settings.bladeShadows = true;
        scaleWind(scene_.settings.winds, 6.0f);
        scene_.camera = {.eye = {0.4, eyeHeight, 1.7}, .target = {0.0, 0.2, 0.0}, .fovY = 45.0f};
    }

    /// Draws the next frame.
    Drawn draw(LayerMask wanted = allLayers)
    {
        Camera camera = scene_.camera;
        camera.eye += double(frame_) * glm::dvec3(0.013, 0.004, -0.009);
        const double time = 1.0 + step * double(frame_++);
        target_.drawLayers(scene_.renderer, camera, scene_.settings, time, wanted);
        Drawn drawn{.camera = camera, .layers = {}, .blades = {}, .picture = target_.pixels()};
        if (wanted != 0)
            drawn.layers = layersOf(scene_.renderer.layerWords(view()), view());
        drawn.blades = scene_.renderer.dumpBlades(view());
        return drawn;
    }

    field::FieldView view() const { return field::viewOf(scene_.field); }
    test::FieldScene& scene() { return scene_; }

private:
    static FieldRenderer::Settings settingsFor(std::uint32_t samples)
    {
        FieldRenderer::Settings settings;
        settings.samples = samples;
        settings.geometry = Geometry::raster;
        settings.castsShadows = true;
        settings.keepsMotion = true;
        return settings;
    }

    const gpu::DeviceContext& context_;
    test::FieldScene scene_;
    test::Picture target_;
    std::uint32_t frame_ = 0;
};

/// A blade as the CPU poses it.
struct Pose {
    glm::dvec3 v0, v1, v2, axis;

    glm::dvec3 at(double t) const
    {
        return (1 - t) * (1 - t) * v0 + 2 * t * (1 - t) * v1 + t * t * v2;
    }
};

std::map<std::uint64_t, Pose> posesOf(const field::FieldView& field, const Records& records)
{
    std::map<std::uint64_t, Pose> poses;
    for (const shared::Patch& cell : field.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = cell.firstBlade + i;
            const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
            const FieldRenderer::BladeRecord& record = records[index];
            poses[LayerId::of(record.id)] = {record.root, record.v1, record.v2,
                                             glm::dvec3(shared::widthAxis(blade.up, blade.facing))};
        }
    return poses;
}

/// Rays of a camera, and places on its picture.
class Rays {
public:
    explicit Rays(const Camera& camera)
        : eye_(camera.eye)
        , forward_(glm::normalize(camera.target - camera.eye))
        , right_(glm::normalize(glm::cross(forward_, glm::dvec3(camera.up))))
        , down_(glm::cross(forward_, right_))
        , focal_(0.5 * size.y / std::tan(glm::radians(0.5 * double(camera.fovY))))
    {
    }

    glm::dvec3 direction(glm::dvec2 pixel) const
    {
        const glm::dvec2 off = (pixel - 0.5 * glm::dvec2(size)) / focal_;
        return glm::normalize(forward_ + off.x * right_ + off.y * down_);
    }
    glm::dvec2 pixelOf(glm::dvec3 point) const
    {
        const glm::dvec3 to = point - eye_;
        return 0.5 * glm::dvec2(size) + focal_ *
                                            glm::dvec2(glm::dot(to, right_), glm::dot(to, down_)) /
                                            glm::dot(to, forward_);
    }
    double depthOf(glm::dvec3 point) const { return glm::dot(point - eye_, forward_); }
    glm::dvec3 eye() const { return eye_; }

private:
    glm::dvec3 eye_, forward_, right_, down_;
    double focal_; ///< [pixels]
};

/// Where on its curve the blade is nearest to a plane across its axis through `point`: the best of
/// some places, then of those between its neighbours.
double placeAlong(const Pose& pose, glm::dvec3 point)
{
    double best = 0.0;
    double least = 1e30;
    const auto search = [&](double from, double to, int steps) {
        for (int i = 0; i <= steps; ++i) {
            const double t = from + (to - from) * double(i) / steps;
            glm::dvec3 off = point - pose.at(t);
            off -= glm::dot(off, pose.axis) * pose.axis;
            if (const double square = glm::dot(off, off); square < least) {
                least = square;
                best = t;
            }
        }
    };
    constexpr int places = 60;
    search(0.0, 1.0, places);
    search(std::max(0.0, best - 1.0 / places), std::min(1.0, best + 1.0 / places), 128);
    return best;
}

glm::dvec2 middleOf(std::size_t pixel)
{
    return {double(pixel % size.x) + 0.5, double(pixel / size.x) + 0.5};
}

using LayersTest = test::GpuTest;

TEST_F(LayersTest, LeaveThePictureAsItIs)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        Meadow with(device(), samples);
        Meadow without(device(), samples);
        for (int frame = 0; frame < 3; ++frame) {
            const Drawn layered = with.draw();
            EXPECT_EQ(layered.picture, without.draw(0).picture)
                << samples << " samples, frame " << frame;
            EXPECT_TRUE(layered.layers.has(Layer::sun));
            EXPECT_EQ(layered.layers.has(Layer::flowForward), frame > 0);
        }
    }
}

TEST_F(LayersTest, HoldTheBladesThatRaysMeet)
{
    Meadow meadow(device(), 1);
    meadow.draw(0);
    const Drawn drawn = meadow.draw();
    const field::FieldView view = meadow.view();
    std::vector<field::BladePose> poses;
    const auto posed = posesOf(view, drawn.blades);
    for (const FieldRenderer::BladeRecord& record : drawn.blades) {
        const Pose& pose = posed.at(LayerId::of(record.id));
        poses.push_back(
            {glm::vec3(pose.v0), glm::vec3(pose.v1), glm::vec3(pose.v2), glm::vec3(pose.axis)});
    }
    const trace::SurfaceSettings exact{.errors = {.curve = 0.003f, .outline = 0.001f}};
    const trace::RayScene rays(trace::surfacesOf(view, poses, exact));
    const trace::Lens lens({.eye = drawn.camera.eye,
                            .target = drawn.camera.target,
                            .up = glm::dvec3(drawn.camera.up),
                            .fovY = double(drawn.camera.fovY)},
                           view.origin, size);
    const auto ids = drawn.layers.as<std::uint64_t>(Layer::blade);
    const auto kinds = drawn.layers.as<std::uint8_t>(Layer::kind);
    const auto depths = drawn.layers.as<float>(Layer::depth);
    const auto species = drawn.layers.as<std::uint8_t>(Layer::species);
    std::size_t equal = 0;
    std::size_t blades = 0;
    std::size_t near = 0;
    for (std::size_t pixel = 0; pixel < ids.size(); ++pixel) {
        trace::RayHit hit;
        const bool isHit = rays.meets(lens.eye(), lens.direction(glm::vec2(middleOf(pixel))), hit);
        const bool isBlade = isHit && hit.part == trace::Part::blades;
        const std::uint64_t id =
            isBlade ? LayerId::of(view.idOf(rays.surfaces().strips[hit.strip].blade)) : 0;
        const std::uint32_t kind = !isHit    ? shared::kindSky
                                   : isBlade ? shared::kindBlade
                                             : shared::kindGround;
        const bool isEqual = ids[pixel] == id && kinds[pixel] == kind;
        equal += isEqual ? 1u : 0u;
        blades += isBlade ? 1u : 0u;
        near += isEqual && (!isHit || std::abs(depths[pixel] - hit.distance) < 1e-3) ? 1u : 0u;
        EXPECT_EQ(species[pixel], ids[pixel] != 0 ? 1u : 0u);
    }
    EXPECT_GT(blades, ids.size() / 4);
    EXPECT_GE(double(equal), 0.995 * double(ids.size())) << ids.size() - equal << " differ";
    EXPECT_GE(double(near), 0.99 * double(ids.size()));
}

TEST_F(LayersTest, FollowThePosesOfBladesFromFrameToFrame)
{
    Meadow meadow(device(), 1);
    for (int frame = 0; frame < 4; ++frame)
        meadow.draw(0);
    const Drawn first = meadow.draw();
    const Drawn second = meadow.draw();
    const auto before = posesOf(meadow.view(), first.blades);
    const auto after = posesOf(meadow.view(), second.blades);
    const Rays raysBefore(first.camera);
    const Rays raysAfter(second.camera);
    const auto backward = second.layers.as<glm::vec2>(Layer::flowBackward);
    const auto forward = second.layers.as<glm::vec2>(Layer::flowForward);
    ASSERT_EQ(forward.size(), backward.size());

    double windiest = 0.0; // [pixels] beside the camera's motion
    const auto farShare = [&](const Drawn& from, const Rays& raysFrom, const auto& posesFrom,
                              const Rays& raysTo, const auto& posesTo, const auto& flow) {
        const auto ids = from.layers.as<std::uint64_t>(Layer::blade);
        const auto kinds = from.layers.as<std::uint8_t>(Layer::kind);
        const auto depths = from.layers.as<float>(Layer::depth);
        std::size_t all = 0;
        std::size_t far = 0;
        for (std::size_t pixel = 0; pixel < ids.size(); ++pixel) {
            const glm::dvec2 middle = middleOf(pixel);
            const glm::dvec3 point =
                raysFrom.eye() + double(depths[pixel]) * raysFrom.direction(middle);
            if (kinds[pixel] == shared::kindGround) {
                EXPECT_LT(glm::length(glm::dvec2(flow[pixel]) - (raysTo.pixelOf(point) - middle)),
                          0.02);
                continue;
            }
            if (ids[pixel] == 0)
                continue;
            const Pose& pose = posesFrom.at(ids[pixel]);
            const Pose& there = posesTo.at(ids[pixel]);
            const double along = placeAlong(pose, point);
            const double across = glm::dot(point - pose.at(along), pose.axis);
            const glm::dvec3 moved = there.at(along) + across * there.axis;
            const glm::dvec2 expected = raysTo.pixelOf(moved) - middle;
            windiest =
                std::max(windiest, glm::length(raysTo.pixelOf(moved) - raysTo.pixelOf(point)));
            ++all;
            far += glm::length(glm::dvec2(flow[pixel]) - expected) > 0.05 ? 1u : 0u;
        }
        EXPECT_GT(all, ids.size() / 4);
        return double(far) / double(all);
    };
    EXPECT_LE(farShare(second, raysAfter, after, raysBefore, before, backward), 0.01);
    EXPECT_LE(farShare(first, raysBefore, before, raysAfter, after, forward), 0.01);
    EXPECT_GT(windiest, 0.5); // the wind counts
}

TEST_F(LayersTest, HaveDepthsAndNormalsOfThePosedBlade)
{
    Meadow meadow(device(), 1);
    meadow.draw(0);
    const Drawn drawn = meadow.draw();
    const auto poses = posesOf(meadow.view(), drawn.blades);
    const Rays rays(drawn.camera);
    const auto ids = drawn.layers.as<std::uint64_t>(Layer::blade);
    const auto depths = drawn.layers.as<float>(Layer::depth);
    const auto planes = drawn.layers.as<float>(Layer::planarDepth);
    const auto normals = drawn.layers.as<std::uint16_t>(Layer::normal);
    std::size_t all = 0;
    std::size_t off = 0;
    for (std::size_t pixel = 0; pixel < ids.size(); ++pixel) {
        if (ids[pixel] == 0)
            continue;
        const glm::dvec3 direction = rays.direction(middleOf(pixel));
        const glm::dvec3 point = rays.eye() + double(depths[pixel]) * direction;
        EXPECT_NEAR(rays.depthOf(point), planes[pixel], 1e-4);
        const Pose& pose = poses.at(ids[pixel]);
        const double along = placeAlong(pose, point);
        const glm::dvec3 out = point - pose.at(along);
        const double across = glm::dot(out, pose.axis);
        const glm::dvec3 normal(glm::unpackHalf1x16(normals[3 * pixel]),
                                glm::unpackHalf1x16(normals[3 * pixel + 1]),
                                glm::unpackHalf1x16(normals[3 * pixel + 2]));
        EXPECT_NEAR(glm::length(normal), 1.0, 2e-3);
        ++all;
        off += glm::length(out - across * pose.axis) > 1e-3 || std::abs(across) > 0.0125 ? 1u : 0u;
    }
    EXPECT_GT(all, ids.size() / 4);
    EXPECT_LE(off, all / 200);
}

/// A semaphore that the CPU raises.
class Gate {
public:
    explicit Gate(const gpu::DeviceContext& context)
        : context_(context)
    {
        VkSemaphoreTypeCreateInfo type{};
        type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
        type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
        VkSemaphoreCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        create.pNext = &type;
        EXPECT_EQ(vkCreateSemaphore(context.device, &create, nullptr, &semaphore_), VK_SUCCESS);
    }
    Gate(const Gate&) = delete;
    Gate& operator=(const Gate&) = delete;
    ~Gate() { vkDestroySemaphore(context_.device, semaphore_, nullptr); }

    VkSemaphoreSubmitInfo passed() const
    {
        VkSemaphoreSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
        info.semaphore = semaphore_;
        info.value = 1;
        info.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        return info;
    }
    void open() const
    {
        VkSemaphoreSignalInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
        info.semaphore = semaphore_;
        info.value = 1;
        EXPECT_EQ(vkSignalSemaphore(context_.device, &info), VK_SUCCESS);
    }

private:
    const gpu::DeviceContext& context_;
    VkSemaphore semaphore_ = VK_NULL_HANDLE;
};

TEST_F(LayersTest, OfAFrameAreReadWhileTheNextOneIsDrawn)
{
    constexpr LayerMask wanted = bitOf(Layer::depth) | bitOf(Layer::blade) | bitOf(Layer::normal);
    constexpr std::uint32_t frames = 3;
    FieldRenderer::Settings settings;
    settings.samples = 1;
    settings.geometry = Geometry::raster;
    settings.framesInFlight = 2 * frames;
    test::FieldScene scene(device(), test::makeField({.blades = 900, .extent = 2.0f, .seed = 5}),
                           settings);
    scaleWind(scene.settings.winds, 6.0f);
    const gpu::Image target(context(), {.name = "target",
                                        .format = VK_FORMAT_R8G8B8A8_SRGB,
                                        .extent = {size.x, size.y},
                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                 VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    std::vector<gpu::Buffer> places;
    for (std::uint32_t i = 0; i < frames; ++i)
        places.emplace_back(context(),
                            gpu::BufferSettings{.name = "place",
                                                .bytes = layerBytes(wanted, size),
                                                .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                .memory = gpu::MemoryUse::readback});
    const auto view = field::viewOf(scene.field);
    const auto recordMove = [&](VkCommandBuffer commands, std::uint32_t i, std::uint32_t slot) {
        scene.renderer.forgetMotion();
        scene.renderer.recordUpdateOnly(commands, scene.settings, 2.0 * i, slot);
    };
    const auto recordFrame = [&](VkCommandBuffer commands, std::uint32_t i, std::uint32_t slot) {
        const Camera camera{.eye = {0.3 * i, 0.6, 1.4}, .target = {0.0, 0.1, 0.0}, .fovY = 45.0f};
        gpu::transition(commands, target, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        scene.renderer.record(commands,
                              {.image = target.get(),
                               .view = target.view(),
                               .size = size,
                               .layers = wanted,
                               .layerBuffer = places[i].get()},
                              camera, scene.settings, 2.0 * i + step, slot);
    };
    const auto words = [&](std::uint32_t i) {
        const auto mapped = places[i].mappedAs<const std::uint32_t>();
        return std::vector<std::uint32_t>(mapped.begin(), mapped.end());
    };
    // One after another …
    std::vector<std::vector<std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < frames; ++i) {
        gpu::submitAndWait(context(), [&](VkCommandBuffer c) { recordMove(c, i, 0); });
        gpu::submitAndWait(context(), [&](VkCommandBuffer c) { recordFrame(c, i, 0); });
        expected.push_back(words(i));
        std::ranges::fill(places[i].mapped(), std::byte(0));
    }
    // … and all recorded and submitted before the first may begin.
    const Gate gate(context());
    gpu::FrameRing ring(context(), 2 * frames);
    std::vector<gpu::FrameRing::Frame> submitted;
    for (std::uint32_t i = 0; i < frames; ++i) {
        const gpu::FrameRing::Frame moved = ring.begin();
        recordMove(moved.commands, i, moved.slot);
        const VkSemaphoreSubmitInfo passed = gate.passed();
        ring.submit(moved, i == 0 ? std::span(&passed, 1) : std::span<VkSemaphoreSubmitInfo>());
        submitted.push_back(ring.begin());
        recordFrame(submitted.back().commands, i, submitted.back().slot);
        const LayerWords known = scene.renderer.layerWords(view, submitted.back().slot);
        EXPECT_EQ(known.wanted, wanted);
        EXPECT_TRUE(known.words.empty());
        ring.submit(submitted.back());
    }
    EXPECT_TRUE(std::ranges::all_of(words(0), [](std::uint32_t word) { return word == 0; }));
    gate.open();
    for (std::uint32_t i = 0; i < frames; ++i) {
        ring.wait(submitted[i]);
        EXPECT_EQ(words(i), expected[i]) << i;
    }
    const FrameLayers layers =
        layersOf({.size = size, .wanted = wanted, .words = expected[0]}, view);
    EXPECT_GT(std::ranges::count_if(layers.as<std::uint64_t>(Layer::blade),
                                    [](std::uint64_t id) { return id != 0; }),
              size.x * size.y / 20);
    ring.finish();
}

TEST_F(LayersTest, NeedComputeShadersAndWhatTheyAreOf)
{
    Meadow meadow(device(), 1);
    EXPECT_THROW(meadow.scene().renderer.layerWords(meadow.view()), Error);
    FieldRenderer::Settings still;
    still.geometry = Geometry::raster;
    test::FieldScene scene(device(), test::makeField({.blades = 10}), still);
    test::Picture target(context(), size);
    EXPECT_THROW(target.drawLayers(scene.renderer, {}, scene.settings, 0.0, flowLayers), Error);
    still.geometry = Geometry::tessellation;
    test::FieldScene tessellated(device(), test::makeField({.blades = 10}), still);
    EXPECT_THROW(
        target.drawLayers(tessellated.renderer, {}, tessellated.settings, 0.0, bitOf(Layer::depth)),
        Error);
}

} // namespace
} // namespace sward::render
