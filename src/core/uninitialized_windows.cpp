#include "core/system/native_windows.h"
#include "core/uninitialized.h"

#include <new>

namespace sward {

// Windows gives huge pages only to users with a privilege for them.
void* takePages(std::size_t bytes)
{
    void* const pages = ::VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
    if (pages == nullptr)
        throw std::bad_alloc();
    return pages;
}

void returnPages(void* pages, std::size_t) noexcept
{
    ::VirtualFree(pages, 0, MEM_RELEASE);
}

} // namespace sward
