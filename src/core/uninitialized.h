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
/// in huge pages where the system grants them: a page fault for every 2 MiB, not every 4 KiB.
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
        if (!isLarge(bytes))
            return std::allocator<T>().allocate(count);
        void* const place = ::operator new(bytes, std::align_val_t(hugePage));
        ::madvise(place, bytes / hugePage * hugePage, MADV_HUGEPAGE); // a wish, not a condition
        return static_cast<T*>(place);
    }

    void deallocate(T* place, std::size_t count) noexcept
    {
        if (isLarge(count * sizeof(T)))
            ::operator delete(place, std::align_val_t(hugePage));
        else
            std::allocator<T>().deallocate(place, count);
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
    static constexpr std::size_t hugePage = std::size_t(2) << 20;

    static bool isLarge(std::size_t bytes) { return bytes >= 4 * hugePage; }
};

/// A vector whose resize() leaves new elements unwritten; for plain structs by the million.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace sward
