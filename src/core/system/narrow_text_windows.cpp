// Narrow text is UTF-8 for std::filesystem::path on Linux; here too. The C++ library widens it by
// mbrtowc(), for which the C library of Windows knows no UTF-8. The linker calls this function
// instead (--wrap, cmake/windows.cmake). The other direction, path::string(), is UTF-8 already.

#include <cerrno>
#include <cstddef>
#include <cwchar>

namespace {

constexpr std::size_t isWrong = static_cast<std::size_t>(-1);
constexpr std::size_t isIncomplete = static_cast<std::size_t>(-2);

struct Start {
    std::size_t size;  ///< bytes of the character; 0 if no character begins so
    char32_t bits;     ///< of the first byte
    char32_t smallest; ///< what needs so many bytes
};

Start startOf(unsigned char byte)
{
    if (byte < 0x80)
        return {1, byte, 0};
    if (byte >= 0xc0 && byte < 0xe0)
        return {2, byte & 0x1fU, 0x80};
    if (byte >= 0xe0 && byte < 0xf0)
        return {3, byte & 0x0fU, 0x800};
    if (byte >= 0xf0 && byte < 0xf8)
        return {4, byte & 0x07U, 0x10000};
    return {0, 0, 0};
}

} // namespace

// A character beyond U+FFFF has two units of UTF-16: the first call takes three of its bytes and
// leaves the second unit in `state`, the next takes the last byte.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t size,
                                      std::mbstate_t* state)
{
    static thread_local std::mbstate_t own{};
    std::mbstate_t& kept = state != nullptr ? *state : own;
    if (from == nullptr) {
        kept = {};
        return 0;
    }
    if (size == 0)
        return isIncomplete;
    wchar_t ignored;
    wchar_t& out = to != nullptr ? *to : ignored;
    if (kept != 0) {
        out = static_cast<wchar_t>(kept);
        kept = 0;
        return 1;
    }
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(from[i]); };
    const Start start = startOf(byteAt(0));
    char32_t character = start.bits;
    std::size_t used = 1;
    for (; used < start.size && used < size && (byteAt(used) & 0xc0U) == 0x80; ++used)
        character = (character << 6) | (byteAt(used) & 0x3fU);
    if (start.size > used && used == size)
        return isIncomplete;
    if (start.size != used || character < start.smallest || character > 0x10ffff ||
        (character >= 0xd800 && character < 0xe000)) {
        errno = EILSEQ;
        return isWrong;
    }
    if (character < 0x10000) {
        out = static_cast<wchar_t>(character);
        return character == 0 ? 0 : used;
    }
    out = static_cast<wchar_t>(0xd800 + ((character - 0x10000) >> 10));
    kept = static_cast<std::mbstate_t>(0xdc00 + (character & 0x3ffU));
    return used - 1;
}
