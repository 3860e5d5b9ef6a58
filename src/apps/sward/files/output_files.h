#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::apps {

/// requireOutput(); throws Error{usage} also if the output is one of `sources`, which are read
/// later.
void checkOutput(const std::string& output, std::string_view extension,
                 const std::vector<std::string>& sources, bool overwrite);

/// Whether both names refer to the same file, existing or not.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace sward::apps
