#include "render/viewer/field_target.h"

namespace sward::render {

TargetSettings targetFor(const gpu::DeviceContext& context, const field::FieldView& field,
                         const FieldRendererSettings& wanted)
{
    const bool isForCpu = wanted.rastersForCpu.value_or(context.isCpu());
    return {.colorFormat = wanted.colorFormat,
            .keepsRadiance = wanted.keepsRadiance,
            .samples = wanted.samples,
            .mayBePaged = wanted.deviceBytes > 0,
            .looks = looksOf(field),
            .groupsDrawLarge = !isForCpu,
            .sortsTiles = isForCpu};
}

} // namespace sward::render
