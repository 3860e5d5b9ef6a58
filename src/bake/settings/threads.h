#pragma once

#include <functional>

namespace sward::bake {

/// Resolves a thread count; 0: all threads of the machine.
int threadCount(int threads);

/// Runs `work` on `threads` threads.
void withThreads(int threads, const std::function<void()>& work);

} // namespace sward::bake
