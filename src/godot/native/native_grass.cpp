#include "godot/native/native_grass.h"

#include "core/error.h"
#include "godot/native/layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sward::godot {
namespace {

// Godot has at most 4 frames in flight, and frees what it made of an image some frames later.
constexpr std::uint64_t framesUntilFree = 8;

constexpr std::size_t viewStride = 17;
constexpr std::size_t colliderStride = 10;

template <class Handle>
Handle handle(std::int64_t value)
{
    return reinterpret_cast<Handle>(value);
}

// What the last call of the C interface says, if it failed.
std::string said(sward_status status)
{
    return status == SWARD_OK ? std::string{} : sward_last_error();
}

std::string said(VkResult result, const char* call)
{
    return result == VK_SUCCESS ? std::string{}
                                : fmt::format("{}: VkResult {}", call, static_cast<int>(result));
}

sward_collider colliderOf(const double* numbers)
{
    sward_collider collider{};
    std::copy_n(numbers, 3, collider.from);
    std::copy_n(numbers + 3, 3, collider.to);
    collider.radius = numbers[6];
    std::transform(numbers + 7, numbers + 10, collider.velocity,
                   [](double value) { return static_cast<float>(value); });
    return collider;
}

} // namespace

NativeGrass::~NativeGrass()
{
    stop();
}

std::string NativeGrass::start(std::int64_t instance, std::int64_t physical, std::int64_t device,
                               std::int64_t queue, std::int64_t queueFamily)
{
    stop();
    if (instance == 0 || physical == 0 || device == 0 || queue == 0)
        return "Godot gave no handles of Vulkan";
    const std::optional<LayeredDevice> known = layeredDevice(handle<VkDevice>(device));
    if (!known)
        return "the layer VK_LAYER_SWARD_features is not on Godot's device, and the features that "
               "Sward needs are not enabled without it";
    if (!known->refusal.empty())
        return known->refusal;

    physical_ = handle<VkPhysicalDevice>(physical);
    device_ = handle<VkDevice>(device);
    queue_ = handle<VkQueue>(queue);
    if (sward_features_create(physical_, &features_) != SWARD_OK)
        return sward_last_error();
    sward_context_info info{};
    info.instance = handle<VkInstance>(instance);
    info.physical = physical_;
    info.device = device_;
    info.queue = queue_;
    info.queue_family = static_cast<std::uint32_t>(queueFamily);
    info.features = features_;
    if (sward_context_create(&info, &context_) != SWARD_OK)
        return sward_last_error();
    const sward_grass_info grass{framesInFlight, static_cast<std::uint32_t>(maxViews), false};
    if (sward_grass_create(context_, &grass, &grass_) != SWARD_OK)
        return sward_last_error();
    return startCommands(info.queue_family);
}

std::string NativeGrass::startCommands(std::uint32_t family)
{
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = family;
    if (const VkResult made = vkCreateCommandPool(device_, &pool, nullptr, &pool_);
        made != VK_SUCCESS)
        return said(made, "vkCreateCommandPool");
    VkCommandBufferAllocateInfo buffers{};
    buffers.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffers.commandPool = pool_;
    buffers.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffers.commandBufferCount = framesInFlight;
    if (const VkResult made = vkAllocateCommandBuffers(device_, &buffers, commands_.data());
        made != VK_SUCCESS)
        return said(made, "vkAllocateCommandBuffers");
    for (VkFence& fence : fences_) {
        VkFenceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        if (const VkResult made = vkCreateFence(device_, &info, nullptr, &fence);
            made != VK_SUCCESS)
            return said(made, "vkCreateFence");
    }
    return {};
}

std::string NativeGrass::load(std::string path, std::int64_t mebibytes)
{
    unload();
    if (grass_ == nullptr)
        return "the renderer has not been started";
    if (sward_field_open(path.c_str(), &field_) != SWARD_OK)
        return sward_last_error();
    sward_budget budget{};
    budget.bytes = static_cast<std::uint64_t>(std::max<std::int64_t>(mebibytes, 0)) << 20U;
    budget.instances = 1;
    budget.views = static_cast<std::uint32_t>(maxViews);
    budget.frames_in_flight = framesInFlight;
    const sward_placement placement{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, 1.0};
    std::string wrong = said(sward_resident_create_within(context_, field_, &budget, &resident_));
    if (wrong.empty())
        wrong = said(sward_settings_create(field_, &settings_));
    if (wrong.empty())
        wrong = said(sward_grass_add(grass_, resident_, &placement, &placed_));
    if (!wrong.empty())
        unload();
    return wrong;
}

void NativeGrass::unload()
{
    if (field_ == nullptr)
        return;
    vkDeviceWaitIdle(device_);
    if (placed_ != 0)
        sward_grass_remove(grass_, placed_);
    sward_resident_destroy(resident_);
    sward_settings_destroy(settings_);
    sward_field_destroy(field_);
    placed_ = 0;
    resident_ = nullptr;
    settings_ = nullptr;
    field_ = nullptr;
    uploadedIn_ = 0;
}

std::string NativeGrass::apply(std::string settings)
{
    if (field_ == nullptr)
        return "no field is loaded";
    sward_settings* changed = nullptr;
    if (sward_settings_create(field_, &changed) != SWARD_OK)
        return sward_last_error();
    if (!settings.empty() && sward_settings_read(changed, settings.c_str()) != SWARD_OK) {
        std::string wrong = sward_last_error();
        sward_settings_destroy(changed);
        return wrong;
    }
    sward_settings_destroy(settings_);
    settings_ = changed;
    return {};
}

std::string NativeGrass::place(std::vector<double> placement)
{
    if (placed_ == 0 || placement.size() != 8)
        return "no field is loaded, or a placement has not 8 numbers";
    sward_placement wanted{};
    std::copy_n(placement.begin(), 3, wanted.position);
    std::copy_n(placement.begin() + 3, 4, wanted.rotation);
    wanted.scale = placement[7];
    return said(sward_grass_move(grass_, placed_, &wanted));
}

std::string NativeGrass::resize(std::int64_t view, std::int64_t width, std::int64_t height)
{
    constexpr std::int64_t maxSide = 16384;
    if (view < 0 || view >= maxViews || width < 1 || height < 1 || width > maxSide ||
        height > maxSide)
        return fmt::format("view {} of {} × {} pixels: there are {} views, and a side has 1 to {}",
                           view, width, height, maxViews, maxSide);
    if (device_ == VK_NULL_HANDLE)
        return "the renderer has not been started";
    std::unique_ptr<GrassImages>& images = images_[static_cast<std::size_t>(view)];
    if (images)
        retired_.push_back({std::move(images), frame_});
    try {
        images =
            std::make_unique<GrassImages>(physical_, device_, static_cast<std::uint32_t>(width),
                                          static_cast<std::uint32_t>(height));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::int64_t NativeGrass::colorImage(std::int64_t view)
{
    const bool exists = view >= 0 && view < maxViews && images_[static_cast<std::size_t>(view)];
    return exists ? reinterpret_cast<std::int64_t>(
                        images_[static_cast<std::size_t>(view)]->color().image())
                  : 0;
}

std::int64_t NativeGrass::depthImage(std::int64_t view)
{
    const bool exists = view >= 0 && view < maxViews && images_[static_cast<std::size_t>(view)];
    return exists ? reinterpret_cast<std::int64_t>(
                        images_[static_cast<std::size_t>(view)]->depth().image())
                  : 0;
}

std::string NativeGrass::draw(double time, std::vector<double> views, std::vector<double> colliders)
{
    const std::size_t viewCount = views.size() / viewStride;
    if (field_ == nullptr || viewCount == 0)
        return {};
    std::vector<sward_stored_picture> stored(viewCount);
    std::vector<sward_view> drawn(viewCount);
    std::vector<std::size_t> numbers(viewCount);
    for (std::size_t i = 0; i < viewCount; ++i) {
        const double* const from = views.data() + i * viewStride;
        numbers[i] = static_cast<std::size_t>(from[0]);
        if (numbers[i] >= images_.size() || !images_[numbers[i]])
            return fmt::format("view {} has no images", numbers[i]);
        const GrassImages& images = *images_[numbers[i]];
        stored[i].color = images.color().view();
        stored[i].format = GrassImages::colorFormat;
        stored[i].keeps_radiance = true;
        stored[i].depth = images.depth().view();
        stored[i].width = drawn[i].width = images.width();
        stored[i].height = drawn[i].height = images.height();
        std::copy_n(from + 1, 16, drawn[i].world_to_clip);
        drawn[i].samples = 1;
        drawn[i].has_reversed_z = true;
        drawn[i].geometry = SWARD_GEOMETRY_RASTER;
        drawn[i].stored = &stored[i];
    }
    std::vector<sward_collider> spheres(
        std::min<std::size_t>(colliders.size() / colliderStride, 256));
    for (std::size_t i = 0; i < spheres.size(); ++i)
        spheres[i] = colliderOf(colliders.data() + i * colliderStride);

    // Wait for the frame that used this slot before.
    const std::size_t slot = frame_ % framesInFlight;
    if (const VkResult waited = vkWaitForFences(device_, 1, &fences_[slot], VK_TRUE, UINT64_MAX);
        waited != VK_SUCCESS)
        return said(waited, "vkWaitForFences");
    drawn_ = 0;
    for (std::uint32_t i = 0; i < drawnViews_[slot]; ++i) {
        sward_stats stats{};
        if (sward_grass_get_stats(grass_, i, static_cast<std::uint32_t>(slot), &stats) == SWARD_OK)
            drawn_ += static_cast<std::int64_t>(stats.drawn);
    }
    drawnViews_[slot] = 0;
    if (uploadedIn_ != 0 && frame_ >= uploadedIn_ + framesInFlight) {
        sward_resident_release_staging(resident_);
        uploadedIn_ = 0;
    }
    releaseRetired();

    sward_frame frame{};
    frame.time = time;
    frame.views = drawn.data();
    frame.view_count = static_cast<std::uint32_t>(viewCount);
    frame.settings = settings_;
    frame.colliders = spheres.data();
    frame.collider_count = static_cast<std::uint32_t>(spheres.size());
    if (sward_grass_begin(grass_, static_cast<std::uint32_t>(slot), &frame) != SWARD_OK)
        return sward_last_error();
    for (std::uint32_t i = 0; i < viewCount; ++i)
        if (const char* const why = sward_grass_why_not_stored(grass_, i))
            return why;
    VkCommandBuffer commands = commands_[slot];
    if (std::string wrong = record(commands, numbers); !wrong.empty())
        return wrong;
    vkResetFences(device_, 1, &fences_[slot]);
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    drawnViews_[slot] = static_cast<std::uint32_t>(viewCount);
    ++frame_;
    return said(vkQueueSubmit(queue_, 1, &submit, fences_[slot]), "vkQueueSubmit");
}

std::string NativeGrass::record(VkCommandBuffer commands, const std::vector<std::size_t>& numbers)
{
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    vkBeginCommandBuffer(commands, &info);
    sward_status status = SWARD_OK;
    if (!sward_resident_is_uploaded(resident_)) {
        status = sward_resident_record_upload(resident_, commands, VK_WHOLE_SIZE);
        uploadedIn_ = frame_ + 1; // frames are counted from 1 here: 0 is none
    }
    if (status == SWARD_OK)
        status = sward_grass_record_update(grass_, commands);
    for (std::uint32_t i = 0; i < numbers.size() && status == SWARD_OK; ++i) {
        images_[numbers[i]]->recordClear(commands);
        status = sward_grass_record_cull(grass_, commands, i);
    }
    for (std::uint32_t i = 0; i < numbers.size() && status == SWARD_OK; ++i) {
        status = sward_grass_record_raster(grass_, commands, i);
        images_[numbers[i]]->recordShow(commands);
    }
    std::string wrong = said(status);
    if (const VkResult ended = vkEndCommandBuffer(commands); wrong.empty())
        wrong = said(ended, "vkEndCommandBuffer");
    return wrong;
}

void NativeGrass::releaseRetired()
{
    std::erase_if(retired_, [this](const Retired& retired) {
        return retired.frame + framesUntilFree < frame_;
    });
}

std::int64_t NativeGrass::drawnBlades()
{
    return drawn_;
}

void NativeGrass::stop()
{
    if (device_ == VK_NULL_HANDLE)
        return;
    vkDeviceWaitIdle(device_);
    unload();
    sward_grass_destroy(grass_);
    sward_context_destroy(context_);
    sward_features_destroy(features_);
    for (VkFence& fence : fences_) {
        vkDestroyFence(device_, fence, nullptr);
        fence = VK_NULL_HANDLE;
    }
    vkDestroyCommandPool(device_, pool_, nullptr);
    images_ = {};
    retired_.clear();
    pool_ = VK_NULL_HANDLE;
    commands_ = {};
    grass_ = nullptr;
    context_ = nullptr;
    features_ = nullptr;
    drawnViews_ = {};
    frame_ = 0;
    drawn_ = 0;
    device_ = VK_NULL_HANDLE;
}

} // namespace sward::godot
