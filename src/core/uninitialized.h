#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace sward {

/// Memory that comes from the system in whole pages, not written to yet; in huge pages where the
/// system has them. Throws std::bad_alloc.
void* takePages(std::size_t bytes);

/// Gives it back at once. `bytes` as it was taken.
void returnPages(void* pages, std::size_t bytes) noexcept;

/// Allocator that leaves new elements uninitialised, where std::allocator would write zeros. The
/// thread that fills memory then touches it first, and unwritten memory is never touched. Large
/// blocks come from the system in huge pages where available (a page fault per 2 MiB, not per 4
/// KiB) and return to it at once.
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
        return static_cast<T*>(takePages(bytes));
    }

    void deallocate(T* place, std::size_t count) noexcept
    {
        if (count * sizeof(T) < large)
            std::allocator<T>().deallocate(place, count);
        else
            returnPages(place, count * sizeof(T));
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
    static constexpr std::size_t large = std::size_t(1) << 18; ///< [bytes]
};

/// A vector whose resize() leaves new elements unwritten; for millions of plain structs.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace sward
