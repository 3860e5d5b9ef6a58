#pragma once

#include <string>
#include <vector>

namespace sward::apps {

/// Extensions of files on which grass can be grown, in lower case.
const std::vector<std::string>& groundExtensions();

/// Whether a name is one of ground, by its extension or as a built-in: what `sward bake` takes.
bool namesGround(const std::string& input);

/// Throws Error{input} with the command that bakes `input`, if it names ground instead of a field.
void requireField(const std::string& input);

} // namespace sward::apps
