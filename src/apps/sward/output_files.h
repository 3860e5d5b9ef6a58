#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::apps {

/// Refuses, before any work, an output that could not be written after it: Error{usage} if it is
/// one of `sources`, Error{io} if it exists and `overwrite` is false or its folder takes no files.
void checkOutput(const std::string& output, const std::vector<std::string>& sources,
                 bool overwrite);

/// Whether both names mean the same file, there or not.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace sward::apps
