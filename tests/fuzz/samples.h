#pragma once

#include <string>
#include <vector>

namespace sward::fuzz {

/// A valid input, small, for the corpus of an entry.
struct Sample {
    std::string entry;
    std::string name;
    std::string bytes;
};

/// One sample of every kind of input; creates them on each call.
std::vector<Sample> samples();

} // namespace sward::fuzz
