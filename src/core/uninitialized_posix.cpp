#include "core/uninitialized.h"

#include <sys/mman.h>

#include <new>

namespace sward {

void* takePages(std::size_t bytes)
{
    void* const pages =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED)
        throw std::bad_alloc();
    ::madvise(pages, bytes, MADV_HUGEPAGE); // a hint; failure is harmless
    return pages;
}

void returnPages(void* pages, std::size_t bytes) noexcept
{
    ::munmap(pages, bytes);
}

} // namespace sward
