#pragma once

#include "core/bounds.h"
#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/memory/upload.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// The display ground in device memory: vertices, triangles, materials, base colour images. The
/// triangles of each material are cut into clusters that start at multiples of
/// shared::clusterTriangles. GroundCullPass culls the clusters of large parts.
class GroundBuffers {
public:
    /// Begins the upload; it is complete after `uploader.finish()`.
    GroundBuffers(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                  const field::DisplayGround& ground);

    /// Triangles of one material.
    struct Part {
        std::uint32_t firstIndex = 0;
        std::uint32_t indexCount = 0;
        std::uint32_t material = 0;
        bool isDoubleSided = false;
        std::uint32_t image = 0; ///< index in imageSet()
        std::uint32_t place = 0; ///< index among the parts
        std::uint32_t firstCluster = 0;
        std::uint32_t clusterCount = 0;
        bool isDrawnWhole = false; ///< the graphics pipeline draws it without culling
    };

    std::span<const Part> parts() const { return parts_; } ///< of the finest level
    const gpu::Buffer& indices() const { return indices_; }
    VkDeviceAddress vertices() const { return vertices_.address(); }
    VkDeviceAddress materials() const { return materials_.address(); }
    std::uint32_t imageCount() const { return static_cast<std::uint32_t>(images_.size()); }
    VkImageView imageView(std::uint32_t image) const { return images_[image].view(); }
    VkSampler sampler() const { return sampler_.get(); }
    VkDeviceAddress clusters() const { return clusters_.address(); } ///< shared::GroundCluster
    std::uint32_t clusterCount() const { return clusterCount_; }     ///< of all parts
    std::uint32_t triangleCount() const
    {
        return clusterCount_ * shared::clusterTriangles;
    } ///< including empty ones
    VkDescriptorSetLayout imageLayout() const { return imageLayout_.get(); }
    const gpu::ImageSet& imageSet(std::uint32_t image) const { return imageSets_[image]; }
    const Aabb& box() const { return box_; } ///< of all vertices, relative to the field's origin
    VkDeviceSize bytes() const { return bytes_; }

private:
    void addParts(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                  const field::DisplayGround& ground);
    void addClusters(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                     const field::DisplayGround& ground);
    void addImage(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                  const field::Image& source, const std::string& name);

    VkDeviceSize bytes_ = 0;
    Aabb box_;
    gpu::Buffer vertices_;
    gpu::Buffer indices_;
    gpu::Buffer materials_;
    gpu::Sampler sampler_;
    gpu::ImageSetLayout imageLayout_;
    std::vector<gpu::Image> images_; ///< the last is white, for materials without image
    std::vector<gpu::ImageSet> imageSets_;
    std::vector<Part> parts_;
    gpu::Buffer clusters_;
    std::uint32_t clusterCount_ = 0;
};

} // namespace sward::render
