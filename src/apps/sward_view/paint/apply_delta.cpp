#include "apps/sward_view/paint/apply_delta.h"

#include "core/error.h"
#include "render/field_renderer.h"

namespace sward::view {

void applyDelta(render::FieldRenderer& /*renderer*/, const std::filesystem::path& delta)
{
    fail(ErrorKind::unsupported, "{}: this renderer takes no changes", delta.string());
}

} // namespace sward::view
