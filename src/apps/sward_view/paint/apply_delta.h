#pragma once

#include <filesystem>

namespace sward::render {
class FieldRenderer;
} // namespace sward::render

namespace sward::view {

/// Applies a delta file of `sward edit` to a field, between two frames. Throws as field::readDelta()
/// and FieldRenderer::apply() do.
void applyDelta(render::FieldRenderer& renderer, const std::filesystem::path& delta);

} // namespace sward::view
