// What the sower needs of the system, of compression.cpp, and of exceptions, in a module of
// WebAssembly.
#include "core/error.h"
#include "core/expect.h"
#include "core/plain_text.h"
#include "core/uninitialized.h"
#include "field/file/compression.h"

#include <__verbose_abort>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

/// Throws an error of JavaScript. `kind`: an ErrorKind; 0: a fault of the program.
extern "C" [[noreturn, clang::import_module("sward"), clang::import_name("refuse")]] void
swardRefuse(std::uint32_t kind, const char* message, std::size_t bytes);

extern "C" {

void* __cxa_allocate_exception(std::size_t bytes)
{
    return std::malloc(bytes);
}

/// Sward throws nothing but Error, and the library is built without exceptions. A module is not
/// used after it has thrown, so nothing is unwound.
[[noreturn]] void __cxa_throw(void* thrown, void*, void (*)(void*))
{
    const auto& error = *static_cast<const sward::Error*>(thrown);
    swardRefuse(static_cast<std::uint32_t>(error.kind()), error.what(), std::strlen(error.what()));
}

void __cxa_free_exception(void*) {}
void* __cxa_begin_catch(void*)
{
    return nullptr;
}
void __cxa_end_catch() {}

/// Ends of the program that the library and its allocator know.
_Noreturn void abort()
{
    constexpr std::string_view message = "no memory, or a fault of the program";
    swardRefuse(0, message.data(), message.size());
}

/// What the library says before it ends the program, which would need files.
[[noreturn]] void abort_message(const char*, ...)
{
    abort();
}
[[noreturn]] void __abort_message(const char*, ...)
{
    abort();
}

} // extern "C"

_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char*, ...)
{
    abort();
}
_LIBCPP_END_NAMESPACE_STD

namespace sward {

// Texts of this module come from its own sources, and names of files are shown by JavaScript.
std::string plainText(std::string_view text)
{
    return std::string(text);
}

void expectationFailed(const char* message, std::source_location)
{
    swardRefuse(0, message, std::strlen(message));
}

void* takePages(std::size_t bytes)
{
    return ::operator new(bytes);
}

void returnPages(void* pages, std::size_t) noexcept
{
    ::operator delete(pages);
}

namespace field {

// JavaScript has undone zstd, and checked what a frame claims. What is left is the order of bytes.
std::uint64_t claimedBytes(std::span<const std::byte> stored)
{
    return stored.size();
}

void checkClaim(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place)
{
    if (stored.size() != rawBytes)
        fail(ErrorKind::input, "{}: the compressed data does not hold {} bytes", place, rawBytes);
}

void decompress(std::span<const std::byte> stored, std::size_t elementBytes,
                std::span<std::byte> raw, const std::string&)
{
    const std::size_t count = raw.size() / elementBytes;
    for (std::size_t byte = 0; byte < elementBytes; ++byte)
        for (std::size_t i = 0; i < count; ++i)
            raw[i * elementBytes + byte] = stored[byte * count + i];
}

} // namespace field
} // namespace sward
