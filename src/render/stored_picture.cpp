#include "render/stored_picture.h"

#include "core/error.h"

#include <glm/vector_relational.hpp>

namespace sward::render {
void requireValid(const StoredPicture& picture, glm::uvec2 viewSize)
{
    if (picture.color == VK_NULL_HANDLE)
        fail(ErrorKind::usage, "stored picture: it has no colour");
    const bool isOfBytes = picture.format == VK_FORMAT_R8G8B8A8_UNORM;
    if (!isOfBytes && picture.format != VK_FORMAT_R16G16B16A16_SFLOAT)
        fail(ErrorKind::usage, "stored picture: grass is not stored as format {}",
             static_cast<int>(picture.format));
    if (picture.isSrgb && !isOfBytes)
        fail(ErrorKind::usage, "stored picture: halves are linear, not sRGB");
    if (picture.isSrgb && picture.keepsRadiance)
        fail(ErrorKind::usage, "stored picture: radiance has no sRGB encoding");
    // Subtract: a sum could overflow.
    if (glm::any(glm::lessThan(picture.size, viewSize)) ||
        glm::any(glm::greaterThan(picture.first, picture.size - viewSize)))
        fail(ErrorKind::usage,
             "stored picture: {} x {} pixels do not contain a view of {} x {} at {}, {}",
             picture.size.x, picture.size.y, viewSize.x, viewSize.y, picture.first.x,
             picture.first.y);
}

} // namespace sward::render
