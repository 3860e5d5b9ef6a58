#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace sward {

/// Leaves what it makes room for as it is, where std::allocator would write zeros: memory is then
/// touched first by the thread that fills it, and never where nothing is written. Large blocks come
/// from the system and go back to it at once, in huge pages where it grants them: a page fault for
/// every 2 MiB, not every 4 KiB.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {
        using other = UninitializedAllocator<U>;
    };

    UninitializedAllocator() = default;
    template <typename U>
    UninitializedAllocator(const UninitializedAllocator<U>&) noexcept
    {
    }

    T* allocate(std::size_t count)
    {
        if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T))
            throw std::bad_array_new_length();
        const std::size_t bytes = count * sizeof(T);
        if (bytes < large)
            return std::allocator<T>().allocate(count);
        void* const place =
            ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (place == MAP_FAILED)
            throw std::bad_alloc();
        ::madvise(place, bytes, MADV_HUGEPAGE); // a wish, not a condition
        return static_cast<T*>(place);
    }

    void deallocate(T* place, std::size_t count) noexcept
    {
        if (count * sizeof(T) < large)
            std::allocator<T>().deallocate(place, count);
        else
            ::munmap(place, count * sizeof(T));
    }

    template <typename U>
    void construct(U* place) noexcept
    {
        ::new (static_cast<void*>(place)) U;
    }

    template <typename U, typename... Args>
    void construct(U* place, Args&&... args)
    {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }

private:
    static constexpr std::size_t large = std::size_t(1) << 20; ///< [bytes]
};

/// A vector whose resize() leaves new elements unwritten; for plain structs by the million.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace sward
