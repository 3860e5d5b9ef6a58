#pragma once

#include "apps/sward/bake_options.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::apps {

/// The options that decide a bake's result, as they were given to `app`: what another process must
/// be given to bake the same.
std::vector<std::string> bakeArguments(const CLI::App& app);

/// The request that such arguments stand for. Throws Error{input} naming `place` if they are not
/// options of a bake, and what BakeOptions::request() throws.
BakeRequest requestOf(const std::vector<std::string>& arguments, const std::string& place);

} // namespace sward::apps
