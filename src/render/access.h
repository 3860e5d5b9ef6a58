#pragma once

#include "render/resident/resident_field.h"
#include "render/tessellation/blade_target.h"

namespace sward::render {

/// Members of the classes that hosts see, for Sward's own passes. Not installed.
struct Access {
    static const ResidentField::Parts& of(const ResidentField& field) { return *field.parts_; }
    static ResidentField::Parts& of(ResidentField& field) { return *field.parts_; }
    static const BladeTarget::Parts& of(const BladeTarget& target) { return *target.parts_; }
};

} // namespace sward::render
