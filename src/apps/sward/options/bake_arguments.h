#pragma once

#include "apps/sward/options/bake_options.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::apps {

/// The options of `app` that determine a bake's result; another process needs them to bake the
/// same.
std::vector<std::string> bakeArguments(const CLI::App& app);

/// Parses such arguments to a request. Throws Error{input} naming `place` if they are not options
/// of a bake, and as BakeOptions::request() does.
BakeRequest requestOf(const std::vector<std::string>& arguments, const std::string& place);

} // namespace sward::apps
