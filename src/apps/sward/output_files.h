#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::apps {

/// Checks an output before any work. Throws Error{usage} if it is one of `sources`, Error{io} if it
/// exists and `overwrite` is false or its folder is not writable.
void checkOutput(const std::string& output, const std::vector<std::string>& sources,
                 bool overwrite);

/// Whether both names refer to the same file, existing or not.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace sward::apps
