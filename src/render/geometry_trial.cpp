#include "render/geometry_trial.h"

#include <fmt/core.h>

#include <span>
#include <vector>

namespace sward::render {
namespace {

/// By how much the tessellator must be faster: it hides no grass behind grass, which pays more the
/// closer one gets.
constexpr double clearlyFaster = 0.95;

/// [ms], without the first.
double medianOf(const std::vector<double>& times)
{
    return gpu::statisticsOf(std::span(times).subspan(1)).median;
}

} // namespace

GeometryTrial::GeometryTrial(const gpu::DeviceContext& context, std::uint32_t slots)
    : timestamps_(context, {.slots = slots, .scopes = 1, .historyFrames = 2 * framesEach})
{
}

Geometry GeometryTrial::begin(VkCommandBuffer commands, std::uint32_t slot)
{
    isMeasured_ = false;
    if (isDecided_)
        return geometry_;
    timestamps_.beginFrame(commands, slot);
    decide();
    if (isDecided_)
        return geometry_;
    isMeasured_ = frames_ < 2 * framesEach;
    geometry_ = frames_ < framesEach || !isMeasured_ ? Geometry::raster : Geometry::hybrid;
    ++frames_;
    return geometry_;
}

void GeometryTrial::beginBlades(VkCommandBuffer commands)
{
    if (isMeasured_)
        scope_ = timestamps_.begin(commands, nameOf(geometry_));
}

void GeometryTrial::endBlades(VkCommandBuffer commands)
{
    if (isMeasured_)
        timestamps_.end(commands, scope_);
}

void GeometryTrial::decide()
{
    const std::vector<double> raster = timestamps_.history(nameOf(Geometry::raster));
    const std::vector<double> hybrid = timestamps_.history(nameOf(Geometry::hybrid));
    if (raster.size() < framesEach || hybrid.size() < framesEach)
        return;
    isDecided_ = true;
    geometry_ =
        medianOf(hybrid) < clearlyFaster * medianOf(raster) ? Geometry::hybrid : Geometry::raster;
    reason_ =
        fmt::format("measured: blades take {:.3g} ms by compute shaders, {:.3g} ms with large "
                    "ones by the tessellator",
                    medianOf(raster), medianOf(hybrid));
}

} // namespace sward::render
