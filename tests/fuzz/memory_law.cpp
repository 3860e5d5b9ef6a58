#include "fuzz/memory_law.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace sward::fuzz {
namespace {

std::atomic<std::ptrdiff_t> held = 0;
std::atomic<std::ptrdiff_t> most = 0;
std::ptrdiff_t heldBefore = 0;

void* take(void* memory)
{
    if (memory == nullptr)
        throw std::bad_alloc();
    const auto size = static_cast<std::ptrdiff_t>(malloc_usable_size(memory));
    const std::ptrdiff_t now = held.fetch_add(size, std::memory_order_relaxed) + size;
    std::ptrdiff_t known = most.load(std::memory_order_relaxed);
    while (now > known && !most.compare_exchange_weak(known, now, std::memory_order_relaxed)) {
    }
    return memory;
}

void give(void* memory) noexcept
{
    if (memory != nullptr)
        held.fetch_sub(static_cast<std::ptrdiff_t>(malloc_usable_size(memory)),
                       std::memory_order_relaxed);
    std::free(memory);
}

} // namespace

MemoryPeak::MemoryPeak()
{
    heldBefore = held;
    most = heldBefore;
}

std::size_t MemoryPeak::bytes() const
{
    return static_cast<std::size_t>(most - heldBefore);
}

} // namespace sward::fuzz

// All other forms of the language end in these.

void* operator new(std::size_t size)
{
    return sward::fuzz::take(std::malloc(size == 0 ? 1 : size));
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
    const auto step = static_cast<std::size_t>(alignment);
    return sward::fuzz::take(std::aligned_alloc(step, (size + step - 1) / step * step));
}

void operator delete(void* memory) noexcept
{
    sward::fuzz::give(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
    sward::fuzz::give(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
    sward::fuzz::give(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    sward::fuzz::give(memory);
}
