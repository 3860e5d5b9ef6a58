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

/// Something of every kind that the entries read, made anew each time.
std::vector<Sample> samples();

} // namespace sward::fuzz
