#pragma once

#include "field/field.h"
#include "field/poses/blade_poses.h"

#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// What moves the blades of a field.
struct MovedBy {
    double time = 0.0;                 ///< [s], rounded to a 60th
    std::optional<float> windStrength; ///< [1/s]; unset: the field's or the settings'
    std::string settingsFile;          ///< empty: none
    std::string device;                ///< see FrameOptions
    bool validation = false;
};

/// The poses of the blades of a field's file at a time, as the renderer moves them on a device in
/// steps of 1/60 s: from time 0 on, or over the last 2 s. Throws as Headless does, and
/// Error{unsupported} if the device does not hold all blades.
std::vector<field::BladePose> movedPoses(const std::string& file, const field::FieldView& field,
                                         const MovedBy& by);

} // namespace sward::view
