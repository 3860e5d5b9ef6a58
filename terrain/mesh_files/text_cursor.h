#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace sward::terrain {

/// Reads text by lines and words. Numbers are independent of the locale.
class TextCursor {
public:
    explicit TextCursor(std::string_view text)
        : text_(text)
    {
    }

    bool atEnd() const { return at_ >= text_.size(); }

    /// The rest of this line without its end (LF, CR LF or CR); goes to the next one.
    std::string_view line();

    /// The next word, across lines; empty at the end.
    std::string_view word();

    /// The next word as a number; none if it is invalid or not finite.
    std::optional<double> number();

    std::size_t lineNumber() const { return lineNumber_; } ///< of the line begun last, from 1
    std::size_t offset() const { return at_; }             ///< bytes read

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t lineNumber_ = 0;
};

/// The number of the line of byte `offset`, from 1.
std::size_t lineAt(std::string_view text, std::size_t offset);

/// How many lines hold more than white space, of which `comment` (0: none) begins more.
std::size_t filledLines(std::string_view text, char comment = '\0');

/// A whole word as a finite number.
std::optional<double> parseNumber(std::string_view word);

/// A whole word as a count.
std::optional<std::size_t> parseCount(std::string_view word);

} // namespace sward::terrain
