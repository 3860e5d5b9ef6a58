#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/buffer_upload.h"
#include "gpu/memory/image.h"
#include "gpu/recording/commands.h"

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sward::gpu {

/// Copies bytes from the CPU into buffers and images through a staging buffer of bounded size. The
/// device copies one half while the CPU fills the other.
class Uploader : public BufferUpload {
public:
    static constexpr VkDeviceSize defaultStagingBytes = VkDeviceSize(32) << 20;

    explicit Uploader(const DeviceContext& context,
                      VkDeviceSize stagingBytes = defaultStagingBytes);
    ~Uploader() override;

    using BufferUpload::toBuffer;
    void toBuffer(const Buffer& target, std::span<const std::byte> bytes,
                  VkDeviceSize offset = 0) override;

    /// Fills level 0 with tightly packed rows, makes the other levels by downsampling, and leaves
    /// the image in ImageUse::sampled. Former contents are discarded.
    void toImage(const Image& target, std::span<const std::byte> pixels);

    /// Submits the remaining copies and waits for all. Uploads are complete only afterwards.
    void finish();

private:
    struct Half {
        Buffer staging;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        Fence done;
        VkDeviceSize used = 0;
        bool isRecording = false;
    };

    /// The half being filled, in recording state, with room for at least `bytes`.
    Half& halfWithRoom(VkDeviceSize bytes);
    void flush();
    void makeMips(const Image& target);

    const DeviceContext& context_;
    CommandPool pool_;
    std::array<Half, 2> halves_;
    std::size_t current_ = 0;
};

} // namespace sward::gpu
