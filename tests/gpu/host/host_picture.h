#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "render/grass.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vulkan/vulkan.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sward::test {

constexpr glm::uvec2 hostSize(160, 90); ///< [pixels]
constexpr std::size_t hostPixels = std::size_t(hostSize.x) * hostSize.y;

/// Perspective in either convention of depth, 0.1 m to 200 m away, and the depth of something.
glm::dmat4 perspective(bool isReversed);
float depthAt(double distance, bool isReversed);

/// A view of the origin.
render::HostView lookingFrom(glm::dvec3 eye, bool isReversed = true);

/// A host's colour and depth, and functions to draw grass into them.
class HostPicture {
public:
    struct Settings {
        glm::uvec2 size = hostSize;
        bool isReversed = true;
        std::uint32_t samples = 1;
        bool hasColor = true;       ///< else depth alone
        bool hasMotion = false;     ///< beside the colour
        bool keepsRadiance = false; ///< in floats
    };

    HostPicture(const gpu::DeviceContext& context, const Settings& settings);

    /// Clears the depth to the far plane, and the left half to a wall at `distance`; leaves it
    /// ready to be sampled.
    void recordWall(VkCommandBuffer commands, double distance) const;
    render::HostDepth depth() const; ///< after recordWall()
    const gpu::Image& depthImage() const { return depth_; }

    /// Records a picture with only one view's grass, and the wall if there is one.
    void record(VkCommandBuffer commands, const render::Grass& grass, std::uint32_t view,
                bool hasWall = false) const;

    std::vector<std::byte> pixels() const;
    std::size_t covered() const; ///< pixels that show grass
    std::vector<float> depths() const;
    std::vector<glm::vec4> radiance() const; ///< 0 where there is no grass
    std::vector<glm::vec2> motion() const;   ///< 0 where there is no grass

private:
    const gpu::DeviceContext& context_;
    Settings settings_;
    VkExtent2D extent_;
    gpu::Image color_;
    gpu::Image resolved_;
    gpu::Image motion_;
    gpu::Image depth_;
    render::BladeTarget target_;
};

/// Pixels in which two pictures differ by more than `most` of 255.
std::size_t pixelsApart(const std::vector<std::byte>& a, const std::vector<std::byte>& b, int most);

/// Grass on a field of some square metres, drawn frame by frame.
class GrassTest : public GpuTest {
protected:
    static std::shared_ptr<render::ResidentField> upload(const field::Field& made);

    /// Draws one frame and waits: each view into its own picture, with a wall at a distance before
    /// the first, if given.
    void drawFrame(render::Grass& grass, double time, std::span<const render::HostView> views,
                   std::span<const HostPicture* const> pictures,
                   std::span<const render::HostCollider> colliders = {},
                   std::optional<double> wall = std::nullopt) const;

    std::vector<std::byte> drawnAlone(render::Grass& grass, double time,
                                      const render::HostView& view) const;

    field::Field field_ = makeField({.blades = 3000, .extent = 4.0f, .seed = 11});
    render::FrameSettings settings_ = render::FrameSettings::of(field::viewOf(field_));
    const render::Grass::Settings oneSlot_{.framesInFlight = 1};
    render::HostLight light_{};
    bool rasters_ = false; ///< drawFrame() calls recordRaster()
};

} // namespace sward::test
