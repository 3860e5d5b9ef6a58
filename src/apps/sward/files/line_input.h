#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sward::apps {

/// Lines of a file descriptor, one after the other, as they arrive.
class LineInput {
public:
    /// `longest`: bytes of a line that is kept whole.
    LineInput(int descriptor, std::size_t longest);

    /// A line without its end.
    struct Line {
        std::string text;
        bool isTooLong = false; ///< the text is empty
    };

    /// Waits for the next line; none at the end of the input or after a request to end. The last line need
    /// not have an end. Throws Error{io} if it cannot be read.
    std::optional<Line> next();

private:
    bool fill();

    int descriptor_;
    std::size_t longest_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

} // namespace sward::apps
