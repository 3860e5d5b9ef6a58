#include "apps/sward_view/interface/interface.h"

#include "core/math/srgb.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/recording/commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_vulkan.h>
#include <imgui_internal.h> // closes popups and ends typing from outside

#include <array>
#include <functional>
#include <string_view>

namespace sward::view {
namespace {

constexpr std::uint32_t bufferedFrames = 3; ///< more than are in flight
constexpr std::uint32_t imageSets = 8;      ///< the font atlas is the only image

// Hash of an element's bytes; equal outputs have equal hashes.
template <typename T>
std::size_t hashOf(const ImVector<T>& elements)
{
    const std::string_view bytes(reinterpret_cast<const char*>(elements.Data),
                                 static_cast<std::size_t>(elements.size_in_bytes()));
    return std::hash<std::string_view>()(bytes);
}

std::size_t hashOf(const ImDrawData& output)
{
    std::size_t hash = 0;
    const auto add = [&hash](std::size_t more) { hash = hash * 0x9e3779b97f4a7c15u + more; };
    for (int i = 0; i < output.CmdListsCount; ++i) {
        const ImDrawList& list = *output.CmdLists[i];
        add(hashOf(list.VtxBuffer));
        add(hashOf(list.IdxBuffer));
        for (const ImDrawCmd& command : list.CmdBuffer)
            for (const float edge :
                 {command.ClipRect.x, command.ClipRect.y, command.ClipRect.z, command.ClipRect.w})
                add(std::hash<float>()(edge));
    }
    return hash;
}

// Colours of controls are sRGB; a target that encodes what is drawn takes linear ones.
void makeLinear(ImDrawData& output)
{
    static const std::array<ImU32, 256> linear = [] {
        std::array<ImU32, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = static_cast<ImU32>(255.0f * linearOf(static_cast<float>(i) / 255.0f) + 0.5f);
        return table;
    }();
    for (int i = 0; i < output.CmdListsCount; ++i)
        for (ImDrawVert& corner : output.CmdLists[i]->VtxBuffer) {
            ImU32 color = corner.col & IM_COL32_A_MASK;
            for (const int shift : {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT})
                color |= linear[(corner.col >> shift) & 255u] << shift;
            corner.col = color;
        }
}

bool isLinear(VkFormat format)
{
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_R8G8B8A8_SRGB;
}

// Dear ImGui 1.86 does not support dynamic rendering.
VkRenderPass createRenderPass(const gpu::DeviceContext& context, VkFormat format)
{
    VkAttachmentDescription color{};
    color.format = format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    create.attachmentCount = 1;
    create.pAttachments = &color;
    create.subpassCount = 1;
    create.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    gpu::check(vkCreateRenderPass(context.device, &create, nullptr, &pass), "vkCreateRenderPass");
    return pass;
}

VkDescriptorPool createDescriptors(const gpu::DeviceContext& context)
{
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, imageSets};
    VkDescriptorPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    create.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    create.maxSets = imageSets;
    create.poolSizeCount = 1;
    create.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    gpu::check(vkCreateDescriptorPool(context.device, &create, nullptr, &pool),
               "vkCreateDescriptorPool");
    return pool;
}

void checkResult(VkResult result)
{
    gpu::check(result, "ImGui");
}

} // namespace

Interface::Context::Context()
{
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    // Save no settings file.
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    // No keyboard navigation of its own: KeyboardFocus leaves letters and Space to the window.
    io.ConfigWindowsMoveFromTitleBarOnly = true;
}

Interface::Context::~Context()
{
    ImGui::DestroyContext();
}

Interface::WindowBackend::WindowBackend(GLFWwindow* window)
{
    ImGui_ImplGlfw_InitForVulkan(window, true);
}

Interface::WindowBackend::~WindowBackend()
{
    ImGui_ImplGlfw_Shutdown();
}

Interface::DeviceBackend::DeviceBackend(const Interface& interface)
{
    const gpu::DeviceContext& device = interface.device_;
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = interface.instance_;
    info.PhysicalDevice = device.physical;
    info.Device = device.device;
    info.QueueFamily = device.queueFamily;
    info.Queue = device.queue;
    info.DescriptorPool = interface.descriptors_.get();
    info.MinImageCount = bufferedFrames;
    info.ImageCount = bufferedFrames;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = checkResult;
#if IMGUI_VERSION_NUM >= 19040
    info.RenderPass = interface.renderPass_.get();
    ImGui_ImplVulkan_Init(&info);
#else
    ImGui_ImplVulkan_Init(&info, interface.renderPass_.get());
#endif
#if IMGUI_VERSION_NUM >= 19000
    ImGui_ImplVulkan_CreateFontsTexture();
#else
    gpu::submitAndWait(
        device, [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

Interface::DeviceBackend::~DeviceBackend()
{
    ImGui_ImplVulkan_Shutdown();
}

Interface::Interface(const gpu::Instance& instance, const gpu::Device& device,
                     const gpu::Swapchain& swapchain, GLFWwindow* window)
    : instance_(instance.get())
    , device_(device.context())
    , swapchain_(swapchain)
    , isLinear_(isLinear(swapchain.format()))
    , style_(std::make_unique<Style>())
    , renderPass_(device_.device, createRenderPass(device_, swapchain.format()))
    , descriptors_(device_.device, createDescriptors(device_))
    , windowBackend_(window)
{
    resize({});
}

void Interface::resize(const Style::Scale& scale)
{
    if (deviceBackend_ && scale == style_->scale())
        return;
    // The fonts are part of the backend, and frames in flight use them.
    gpu::check(vkDeviceWaitIdle(device_.device), "vkDeviceWaitIdle");
    deviceBackend_.reset();
    style_->resize(scale);
    deviceBackend_ = std::make_unique<DeviceBackend>(*this);
}

Interface::~Interface() = default;

void Interface::begin()
{
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Interface::end()
{
    ImGui::Render();
    if (isLinear_)
        makeLinear(*ImGui::GetDrawData());
}

bool Interface::hasChanged() const
{
    return hashOf(*ImGui::GetDrawData()) != recorded_;
}

bool Interface::closePopup()
{
    const int open = ImGui::GetCurrentContext()->OpenPopupStack.Size;
    if (open == 0)
        return false;
    ImGui::ClosePopupToLevel(open - 1, true);
    return true;
}

void Interface::endTyping()
{
    ImGui::ClearActiveID();
}

bool Interface::takesMouse() const
{
    return ImGui::GetIO().WantCaptureMouse;
}

bool Interface::takesKeys() const
{
    // Also if a control of this frame has begun to be typed into.
    return ImGui::GetIO().WantTextInput || ImGui::GetCurrentContext()->WantTextInputNextFrame == 1;
}

VkFramebuffer Interface::framebufferFor(const gpu::Swapchain::Target& target)
{
    // The swapchain waited for the device before it destroyed the old images.
    if (generation_ != swapchain_.generation()) {
        framebuffers_.clear();
        framebuffers_.resize(swapchain_.imageCount());
        generation_ = swapchain_.generation();
    }
    Framebuffer& framebuffer = framebuffers_.at(target.index);
    if (!framebuffer) {
        const VkExtent2D extent = swapchain_.extent();
        VkFramebufferCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        create.renderPass = renderPass_.get();
        create.attachmentCount = 1;
        create.pAttachments = &target.view;
        create.width = extent.width;
        create.height = extent.height;
        create.layers = 1;
        VkFramebuffer made = VK_NULL_HANDLE;
        gpu::check(vkCreateFramebuffer(device_.device, &create, nullptr, &made),
                   "vkCreateFramebuffer");
        framebuffer = {device_.device, made};
    }
    return framebuffer.get();
}

void Interface::record(VkCommandBuffer commands, const gpu::Swapchain::Target& target)
{
    const gpu::LabelScope label(device_, commands, "interface");
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = renderPass_.get();
    begin.framebuffer = framebufferFor(target);
    begin.renderArea = {{0, 0}, swapchain_.extent()};
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    recorded_ = hashOf(*ImGui::GetDrawData());
    vkCmdEndRenderPass(commands);
}

} // namespace sward::view
