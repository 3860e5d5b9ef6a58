#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace sward {

/// Leaves what it makes room for as it is, where std::allocator would write zeros: memory is then
/// touched first by the thread that fills it, and never where nothing is written.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {
        using other = UninitializedAllocator<U>;
    };

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
};

/// A vector whose resize() leaves new elements unwritten; for plain structs by the million.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace sward
