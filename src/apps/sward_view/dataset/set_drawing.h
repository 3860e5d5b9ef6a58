#pragma once

#include "apps/sward_view/dataset/dataset_scene.h"
#include "apps/sward_view/dataset/frame_draws.h"
#include "apps/sward_view/scene/frame_options.h"
#include "field/read.h"
#include "gpu/device/device.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "render/layers/frame_layers.h"
#include "render/viewer/field_renderer.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sward::view {

/// Draws the frames of a set that show one field. Frames follow each other on the device without a
/// wait of the CPU: each leaves its layers and its picture in a place of memory that the CPU reads,
/// while the next ones are drawn into other places.
class SetDrawing {
public:
    /// A frame that has been submitted. All spans are memory of its place, for any thread, once
    /// wait() has returned and until the last copy of `place` goes.
    struct Submitted {
        gpu::FrameRing::Frame last{};         ///< of its commands
        render::LayerWords layers{};          ///< nothing wanted: there are none
        render::LayerWords ahead{};           ///< with the frame's forward flow, if that is wanted
        std::span<const std::byte> picture{}; ///< rows of four halves or, on film, of four bytes
        std::shared_ptr<void> place{};
    };

    /// All must outlive it. `isRadiance`: pictures are linear radiance. `readers`: threads that
    /// read places at the same time. Throws as FieldRenderer does.
    SetDrawing(const gpu::Device& device, const DatasetScene& scene, const FrameOptions& options,
               const field::FieldView& field, bool isRadiance, std::uint32_t readers);

    /// What all frames are drawn with.
    const render::FrameSettings& settings() const { return settings_; }

    /// Submits a frame without a past. Waits only while every place is in use.
    Submitted submit(const DrawnFrame& what);

    /// Waits until the device has drawn a frame.
    void wait(const Submitted& frame) const { ring_.wait(frame.last); }

    /// Waits for all frames.
    void finish()
    {
        ring_.finish();
        timestamps_.collect();
    }

    /// The layers of a frame, and its forward flow, as arrays; on any thread.
    render::FrameLayers layersOf(const Submitted& frame) const;

    /// Time of the device for frames that are known to have been drawn, since the last call [ms].
    double takeDeviceTime();

    /// The layers that frames have.
    static render::LayerMask layersOf(const DatasetScene& scene);

private:
    /// Memory that the CPU reads.
    struct Place {
        gpu::Buffer layers, ahead, picture;
        bool isFree = true;
    };

    std::uint32_t takePlace();
    void freePlace(std::uint32_t place);
    void move(const DrawnFrame& what, double time);
    gpu::FrameRing::Frame draw(const render::Camera& camera, const render::Camera& before,
                               const DrawnFrame& what, double time, render::LayerMask layers,
                               const gpu::Buffer& words, const gpu::Buffer* picture);

    const gpu::DeviceContext& context_;
    const DatasetScene& scene_;
    const field::FieldView& field_;
    render::LayerMask layers_;
    render::FrameSettings settings_;
    gpu::Image target_;
    bool hasDrawn_ = false; ///< the target has contents
    render::FieldRenderer renderer_;
    gpu::Timestamps timestamps_;
    std::vector<Place> places_;
    std::mutex mutex_; ///< of Place::isFree
    std::condition_variable freed_;
    gpu::FrameRing ring_; ///< ends before what its commands use
};

} // namespace sward::view
