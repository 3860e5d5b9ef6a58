#include "render/frame_tables.h"

#include "core/expect.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace sward::render {
namespace {

struct Tables {
    shared::WindSource winds[shared::maxWindSources];
    shared::Collider colliders[shared::maxColliders];
};

} // namespace

FrameTables::FrameTables(const gpu::DeviceContext& context)
    : buffer_(context, {.name = "frame/tables",
                        .bytes = sizeof(Tables),
                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        .memory = gpu::MemoryUse::upload})
{
}

VkDeviceSize FrameTables::bytes()
{
    return sizeof(Tables);
}

void FrameTables::write(const FieldShape& field, const FrameSettings& settings, double time,
                        double before, shared::Frame& frame) const
{
    expect(settings.winds.size() <= shared::maxWindSources, "at most maxWindSources blow at once");
    expect(settings.colliders.size() <= shared::maxColliders, "at most maxColliders collide");
    std::byte* mapped = buffer_.mapped().data();

    const std::vector<shared::WindSource> winds = blowing(settings.winds, field.origin);
    std::memcpy(mapped + offsetof(Tables, winds), winds.data(),
                winds.size() * sizeof(shared::WindSource));
    for (std::size_t i = 0; i < settings.colliders.size(); ++i) {
        const shared::Collider collider =
            colliderAt(settings.colliders[i], field.origin, time, before);
        std::memcpy(mapped + offsetof(Tables, colliders) + i * sizeof collider, &collider,
                    sizeof collider);
    }

    shared::Nature& nature = frame.nature;
    const glm::vec3 size = field.content.isEmpty() ? glm::vec3(0.0f) : field.content.size();
    nature.wind = together(winds, std::max({size.x, size.y, size.z}));
    nature.wind.sources.address = buffer_.address() + offsetof(Tables, winds);
    nature.colliderCount = static_cast<std::uint32_t>(settings.colliders.size());
    nature.colliders.address = buffer_.address() + offsetof(Tables, colliders);
}

} // namespace sward::render
