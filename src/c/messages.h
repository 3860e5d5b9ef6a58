#pragma once

#include <string>

namespace sward::c {

/// A message of the C++ library in the words of the C interface: `HostTarget::samples` becomes
/// sward_target_info::samples, `Grass::recordCull()` sward_grass_record_cull(). With
/// `hasMembersAlone`, names without their struct become those of C, too: `maxViews` max_views.
std::string inWordsOfC(const std::string& message, bool hasMembersAlone);

} // namespace sward::c
