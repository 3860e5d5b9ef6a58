#include "render/preview/ground_buffers.h"

#include "core/expect.h"
#include "render/preview/ground_clusters.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace sward::render {
namespace {

gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes,
                     VkBufferUsageFlags usage)
{
    return {context,
            {.name = name, .bytes = bytes, .usage = usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT}};
}

/// Default image of materials without one.
const field::Image& whiteImage()
{
    static const field::Image white{1, 1, {255, 255, 255, 255}};
    return white;
}

/// Minimum triangles of one material for sorting them into spatial clusters.
constexpr std::uint32_t fewestSorted = 8192;

/// Whether to draw `triangles` triangles of one material by clusters. Culling costs more than
/// drawing a few of them.
bool isWorthClusters(const gpu::DeviceContext& context, std::uint32_t triangles)
{
    return triangles >= fewestSorted && context.features.multiDrawIndirect &&
           context.features.drawIndirectCount &&
           triangles / shared::clusterTriangles < context.limits.maxDrawIndirectCount;
}

} // namespace

GroundBuffers::GroundBuffers(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                             const field::DisplayGround& ground)
    : vertices_(allocate(context, "ground/vertices",
                         ground.vertices.size() * sizeof(shared::GroundVertex),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT))
    , materials_(allocate(context, "ground/materials",
                          ground.materials.size() * sizeof(shared::GroundMaterial),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT))
    , sampler_(gpu::createSampler(context, {.name = "ground"}))
    , imageLayout_(
          context,
          {.name = "ground/base color", .sampledCount = 1, .stages = VK_SHADER_STAGE_FRAGMENT_BIT})
{
    uploader.toBuffer(vertices_, std::span<const shared::GroundVertex>(ground.vertices));
    uploader.toBuffer(materials_, std::span<const shared::GroundMaterial>(ground.materials));
    for (const shared::GroundVertex& corner : ground.vertices)
        box_.add(corner.position);
    bytes_ = vertices_.bytes() + materials_.bytes();

    // One set per image, so that shaders need no dynamic indexing.
    for (std::size_t i = 0; i < ground.images.size(); ++i)
        addImage(context, uploader, ground.images[i], "ground/image " + std::to_string(i));
    addImage(context, uploader, whiteImage(), "ground/white");

    addParts(context, uploader, ground);
}

void GroundBuffers::addParts(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                             const field::DisplayGround& ground)
{
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0 || range.indexCount == 0)
            continue;
        expect(range.material < ground.materials.size(), "a ground range's material exists");
        const shared::GroundMaterial& material = ground.materials[range.material];
        const std::size_t white = images_.size() - 1;
        expect(material.image == shared::noImage || material.image < white,
               "a ground material's image exists");
        parts_.push_back({range.firstIndex, range.indexCount, range.material,
                          (material.flags & shared::groundDoubleSided) != 0,
                          std::min(material.image, static_cast<std::uint32_t>(white)), 0, 0, 0,
                          false});
    }
    // Group parts by pipeline.
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
        return a.isDoubleSided < b.isDoubleSided;
    });

    addClusters(context, uploader, ground);
}

void GroundBuffers::addClusters(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                                const field::DisplayGround& ground)
{
    std::vector<std::uint32_t> indices;
    std::vector<shared::GroundCluster> clusters;
    for (Part& part : parts_) {
        const auto first = ground.indices.begin() + std::ptrdiff_t(part.firstIndex);
        std::vector<std::uint32_t> own(first, first + std::ptrdiff_t(part.indexCount));
        if (part.indexCount / 3 >= fewestSorted)
            sortTriangles(ground.vertices, own);
        const std::vector<shared::GroundCluster> cut =
            clustersOf(ground.vertices, own, part.material);
        part.place = static_cast<std::uint32_t>(&part - parts_.data());
        part.isDrawnWhole = !isWorthClusters(context, part.indexCount / 3);
        part.firstCluster = static_cast<std::uint32_t>(clusters.size());
        part.clusterCount = static_cast<std::uint32_t>(cut.size());
        part.firstIndex = 3 * shared::clusterTriangles * part.firstCluster;
        clusters.insert(clusters.end(), cut.begin(), cut.end());
        // Fill the last cluster with empty triangles.
        own.resize(3 * shared::clusterTriangles * cut.size());
        indices.insert(indices.end(), own.begin(), own.end());
    }
    clusterCount_ = static_cast<std::uint32_t>(clusters.size());
    if (clusters.empty())
        return;
    indices_ = allocate(context, "ground/indices", indices.size() * sizeof(std::uint32_t),
                        VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    uploader.toBuffer(indices_, std::span<const std::uint32_t>(indices));
    clusters_ =
        allocate(context, "ground/clusters", clusters.size() * sizeof(shared::GroundCluster),
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    uploader.toBuffer(clusters_, std::span<const shared::GroundCluster>(clusters));
    bytes_ += indices_.bytes() + clusters_.bytes();
}

void GroundBuffers::addImage(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                             const field::Image& source, const std::string& name)
{
    const VkExtent2D extent{source.width, source.height};
    gpu::Image image(context,
                     {.name = name,
                      .format = VK_FORMAT_R8G8B8A8_SRGB,
                      .extent = extent,
                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                               VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                      .mips = gpu::completeMips(extent)});
    uploader.toImage(image, std::as_bytes(std::span(source.rgba)));
    gpu::ImageSet set(context, imageLayout_, name);
    set.setSampled(0, image.view(), sampler_.get());
    bytes_ += image.memoryBytes();
    images_.push_back(std::move(image));
    imageSets_.push_back(std::move(set));
}

} // namespace sward::render
