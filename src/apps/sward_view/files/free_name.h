#pragma once

#include "apps/sward_view/question.h"

#include <filesystem>
#include <functional>
#include <string>

namespace sward::view {

/// `path` if nothing of that name exists, else the first of NAME-2.EXT, NAME-3.EXT … that does not.
std::filesystem::path freeName(const std::filesystem::path& path);

/// Name of a file for a field baked on `input`.
std::string fieldNameFor(const std::string& input);

/// Name of a file for the strokes painted on the field of `input`.
std::string strokesNameFor(const std::string& input);

/// Asks whether a file that exists shall be replaced, or the new one get the next free name. Then
/// calls `write` with the path, and whether it may replace a file.
Question replaceQuestion(const std::filesystem::path& path,
                         std::function<void(const std::filesystem::path&, bool)> write);

} // namespace sward::view
