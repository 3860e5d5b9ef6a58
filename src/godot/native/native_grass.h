#pragma once

#include "c/sward.h"
#include "godot/native/grass_images.h"

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::godot {

/// Grass of one field on the device that Godot made, drawn into images that Godot shows. All calls
/// come from the thread that draws. Each function that returns a text returns an empty one where it
/// succeeded, and what is wrong otherwise.
class NativeGrass {
public:
    static constexpr std::int64_t maxViews = 4;

    NativeGrass() = default;
    ~NativeGrass();
    NativeGrass(const NativeGrass&) = delete;
    NativeGrass& operator=(const NativeGrass&) = delete;

    /// Handles as RenderingDevice.get_driver_resource() gives them. Once, before all others.
    std::string start(std::int64_t instance, std::int64_t physical, std::int64_t device,
                      std::int64_t queue, std::int64_t queueFamily);

    /// Opens a field for a number of MiB of device memory; 0: as many as it needs. Replaces a
    /// former field.
    std::string load(std::string path, std::int64_t mebibytes);
    void unload(); ///< waits for the device, and frees the field

    /// The field's own settings with the text of a settings file over them (docs/settings.md).
    std::string apply(std::string settings);

    /// Where the field stands: position [m] (3), unit quaternion (4), scale (1).
    std::string place(std::vector<double> placement);

    /// Makes the images of a view, below maxViews. Those that it replaces live for some more
    /// frames.
    std::string resize(std::int64_t view, std::int64_t width, std::int64_t height);
    std::int64_t colorImage(std::int64_t view); ///< VkImage; 0 if there is none
    std::int64_t depthImage(std::int64_t view); ///< VkImage; 0 if there is none

    /// Draws a frame. `views` has 17 numbers for each view: its number, and its matrix from the
    /// world to Vulkan's clip space with reversed depth, column after column. `colliders` has 10
    /// for each: two ends [m], radius [m], velocity [m/s].
    std::string draw(double time, std::vector<double> views, std::vector<double> colliders);

    /// Of the last frame whose commands have completed: blades that all its views have drawn.
    std::int64_t drawnBlades();

    /// Waits for the device, and frees all.
    void stop();

private:
    static constexpr std::uint32_t framesInFlight = 2;

    struct Retired {
        std::unique_ptr<GrassImages> images;
        std::uint64_t frame; // the first that did not use them
    };

    std::string startCommands(std::uint32_t family);
    std::string record(VkCommandBuffer commands, const std::vector<std::size_t>& numbers);
    void releaseRetired();

    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<VkCommandBuffer, framesInFlight> commands_{};
    std::array<VkFence, framesInFlight> fences_{};
    sward_features* features_ = nullptr;
    sward_context* context_ = nullptr;
    sward_field* field_ = nullptr;
    sward_resident* resident_ = nullptr;
    sward_grass* grass_ = nullptr;
    sward_settings* settings_ = nullptr;
    sward_instance placed_ = 0;
    std::array<std::unique_ptr<GrassImages>, maxViews> images_;
    std::vector<Retired> retired_;
    std::array<std::uint32_t, framesInFlight> drawnViews_{}; // of the frame last drawn in a slot
    std::uint64_t frame_ = 0;
    std::uint64_t uploadedIn_ = 0; // frame whose commands copy the field
    std::int64_t drawn_ = 0;
};

} // namespace sward::godot
