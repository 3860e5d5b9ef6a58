// The layers of a field's frames, and frames without a past.

#include "core/error.h"
#include "render/cull/pass_scope.h"
#include "render/frame/frame.h"
#include "render/resident/resident_ids.h"
#include "render/viewer/field_renderer_parts.h"

namespace sward::render {

LayerWords FieldRenderer::layerWords(const field::FieldView& field, std::uint32_t slot) const
{
    const Parts& parts = *parts_;
    requireUsage(slot < parts.settings.framesInFlight, "slot {} of {}", slot,
                 parts.settings.framesInFlight);
    requireUsage(parts.layers.has_value(), "no frame with layers has been recorded");
    LayerWords words = parts.layers->wordsOf(slot);
    if ((words.wanted & (bitOf(Layer::blade) | bitOf(Layer::plant))) != 0)
        words.ids = residentIdsOf(*parts.field, field);
    return words;
}

void FieldRenderer::forgetMotion()
{
    Parts& parts = *parts_;
    parts.blades->forgetMotion();
    parts.frameNumber = 0;
    parts.lastTime = 0.0;
    parts.seenBefore.reset();
    if (parts.layers)
        parts.layers->forgetPlaces();
}

/// Throws unless the target's layers can be written.
void FieldRenderer::Parts::checkLayers(const Target& target) const
{
    if (target.layers == 0)
        return;
    if (geometry != Geometry::raster && settings.geometry == Geometry::tessellation)
        fail(
            ErrorKind::unsupported,
            "layers need blades that compute shaders draw, and geometry tessellation is asked for");
    if (geometry != Geometry::raster)
        fail(ErrorKind::unsupported,
             "layers need blades that compute shaders draw, and {} draws them by the tessellator",
             context.name);
    requireUsage((target.layers & ~allLayers) == 0, "FieldRenderer::Target::layers: {:#x}",
                 target.layers);
    requireUsage((target.layers & flowLayers) == 0 || settings.keepsMotion,
                 "layers of flow need FieldRendererSettings::keepsMotion");
}

/// Projection of the frame before; none if there is none.
std::optional<glm::mat4> FieldRenderer::Parts::projectionBefore(const Target& target,
                                                                glm::uvec2 whole) const
{
    if (target.cameraBefore == nullptr)
        return seenBefore;
    ViewMatrices before =
        viewMatrices(*target.cameraBefore, field->shape.origin, whole, field->shape.content);
    if (target.whole != glm::uvec2(0))
        before = partOf(before, whole, target.first, target.size);
    return before.viewProjection;
}

void FieldRenderer::Parts::prepareLayers(const FrameSettings& wanted)
{
    if (!layers)
        layers.emplace(context, ground, targetSettings, settings.framesInFlight);
    layers->prepare(recorder.shaders, {.debugMode = knownDebugMode(wanted.debug),
                                       .limitsLeafArea = testsOf(wanted).maxLeafArea > 0.0f});
}

void FieldRenderer::Parts::recordLayers(const gpu::Recording& commands, const Target& target,
                                        const shared::RasterPush& push, gpu::Timestamps* timestamps)
{
    const LayersPass::Input input{.wanted = target.layers,
                                  .push = push,
                                  .frame = frame(),
                                  .motion = blades->motion(recorder.slot, 0),
                                  .elapsed = elapsed,
                                  .into = target.layerBuffer};
    layers->fit(recorder.slot, input);
    const DispatchScope scope(context, commands, timestamps, "layers");
    layers->record(commands, recorder.slot, input);
}

} // namespace sward::render
