#include "render/blade_dump.h"

#include "gpu/check.h"
#include "gpu/readback.h"
#include "shaders/shared/frame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sward::render {
namespace {

/// Where a blade stands and how it is bent, in world space.
FieldRenderer::BladeRecord recordOf(const shared::Blade& blade, const shared::BladeState& state,
                                    glm::dvec3 origin)
{
    const glm::vec3 axis = shared::widthAxis(blade.up, blade.facing);
    const shared::Pose pose = shared::poseOfState(blade.up, shared::frontOf(blade.up, axis), state);
    FieldRenderer::BladeRecord record;
    record.root = origin + glm::dvec3(blade.root);
    record.v1 = record.root + glm::dvec3(blade.height * pose.v1);
    record.v2 = record.root + glm::dvec3(blade.height * pose.v2);
    record.up = blade.up;
    record.eta = shared::etaOf(state);
    return record;
}

/// `count` elements of a buffer from the one at `first` on.
template <typename T>
std::vector<T> readPart(const gpu::DeviceContext& context, const gpu::Buffer& buffer,
                        std::size_t first, std::size_t count)
{
    const std::vector<std::byte> bytes =
        gpu::readBuffer(context, buffer, first * sizeof(T), count * sizeof(T));
    std::vector<T> elements(count);
    if (count > 0)
        std::memcpy(elements.data(), bytes.data(), bytes.size());
    return elements;
}

} // namespace

std::vector<FieldRenderer::BladeRecord> readBlades(const gpu::DeviceContext& context,
                                                   const FieldBuffers& buffers,
                                                   const field::FieldView& field)
{
    gpu::check(vkDeviceWaitIdle(context.device), "vkDeviceWaitIdle");
    const auto states = gpu::readBufferAs<shared::BladeState>(context, buffers.states());
    const auto visible = gpu::readBufferAs<shared::VisibleBlade>(context, buffers.visible());
    const auto draw = gpu::readBufferAs<shared::DrawArguments>(context, buffers.draw());
    std::vector<std::uint32_t> fates;
    if (buffers.fates().bytes() > 0)
        fates = gpu::readBufferAs<std::uint32_t>(context, buffers.fates());

    // Pose each blade of each patch.
    std::vector<FieldRenderer::BladeRecord> records(field.blades.size());
    for (const shared::Patch& cell : field.patches) {
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = cell.firstBlade + i;
            records[index] = recordOf(shared::unpackBlade(field.blades[index], cell), states[index],
                                      field.origin);
            records[index].id = field.idOf(index);
            records[index].fate = fates.empty() ? shared::fatePatch : fates[index];
        }
    }

    // The list knows which were drawn, and how wide.
    const std::size_t drawn =
        std::min<std::size_t>(draw[0].fates[shared::fateDrawn], visible.size());
    for (std::size_t i = 0; i < drawn; ++i) {
        records[visible[i].blade].lodWidth = visible[i].widthFactor;
        records[visible[i].blade].fate = shared::fateDrawn;
    }
    return records;
}

std::vector<FieldRenderer::BladeRecord> readPatch(const gpu::DeviceContext& context,
                                                  const FieldBuffers& buffers,
                                                  const field::FieldView& field,
                                                  std::uint32_t patch)
{
    const shared::Patch& cell = field.patches[patch];
    const auto states =
        readPart<shared::BladeState>(context, buffers.states(), cell.firstBlade, cell.bladeCount);
    std::vector<std::uint32_t> fates(cell.bladeCount, shared::fatePatch);
    if (buffers.fates().bytes() > 0)
        fates = readPart<std::uint32_t>(context, buffers.fates(), cell.firstBlade, cell.bladeCount);
    std::vector<FieldRenderer::BladeRecord> records(cell.bladeCount);
    for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
        const std::size_t index = cell.firstBlade + i;
        records[i] =
            recordOf(shared::unpackBlade(field.blades[index], cell), states[i], field.origin);
        records[i].id = field.idOf(index);
        records[i].fate = fates[i];
    }
    return records;
}

} // namespace sward::render
