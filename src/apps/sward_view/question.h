#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sward::view {

/// A question to the user that waits for an answer. Escape is the answer that does nothing.
struct Question {
    struct Answer {
        std::string label;
        std::string about;
        std::function<void()> act; ///< empty: does nothing
    };
    std::string text;
    std::vector<Answer> answers;
};

} // namespace sward::view
