// What any engine has already: a device, a picture with depth, boxes. Nothing here knows of grass.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <sward/gpu/features.h>
#include <vulkan/vulkan.h>

#include <functional>
#include <vector>

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB, depthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkExtent2D size{640, 360};

/// A cube from −1 to 1, and where it is put.
struct Box {
    glm::dmat4 toWorld;
    glm::vec3 color;
};

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

class Host {
public:
    Host(bool isReversed, bool hasRenderPass);
    ~Host();

    void submitAndWait(const std::function<void(VkCommandBuffer)>& record) const;

    /// Begins a picture that is all sky: by dynamic rendering or a render pass. To be ended.
    void beginPicture(VkCommandBuffer commands) const;
    void endPicture(VkCommandBuffer commands) const;
    void draw(VkCommandBuffer commands, const std::vector<Box>& boxes, glm::dmat4 worldToClip, glm::vec3 sun) const;

    /// Perspective in the host's convention of depth, far away 100 m.
    glm::dmat4 projection(double fovY) const;
    void save(const char* path) const;

    bool isReversed, hasRenderPass;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;        ///< of family 0, which draws and computes on every desktop
    sward::gpu::OptionalFeatures features; ///< that Sward uses
    VkRenderPass renderPass = VK_NULL_HANDLE;

private:
    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const;
    Image picture(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) const;
    void makeRenderPass();
    void makeBoxes();

    Image color_, depth_;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline boxes_ = VK_NULL_HANDLE;
};
