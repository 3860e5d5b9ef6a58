#pragma once

#include "render/frame/colliders.h"

#include <string_view>

namespace sward::view {

/// "sphere:x,y,z,r" or "capsule:x,y,z,x,y,z,r", world space [m]. Throws Error{usage}.
render::Collider parseCollider(std::string_view text);

} // namespace sward::view
