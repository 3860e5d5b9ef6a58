#include "terrain/load.h"

namespace sward::terrain {

bool globMatches(const std::string& glob, const std::string& text)
{
    std::size_t g = 0;
    std::size_t t = 0;
    // Position of the last * and the text length it matches; backtracking returns only to it.
    std::size_t star = std::string::npos;
    std::size_t swallowed = 0;
    while (t < text.size()) {
        if (g < glob.size() && glob[g] == '*') {
            star = g++;
            swallowed = t;
        } else if (g < glob.size() && (glob[g] == '?' || glob[g] == text[t])) {
            ++g;
            ++t;
        } else if (star != std::string::npos) {
            g = star + 1;
            t = ++swallowed;
        } else {
            return false;
        }
    }
    while (g < glob.size() && glob[g] == '*')
        ++g;
    return g == glob.size();
}

} // namespace sward::terrain
