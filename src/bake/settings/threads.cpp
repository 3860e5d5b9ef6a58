#include "bake/settings/threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace sward::bake {

int threadCount(int threads)
{
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

void withThreads(int threads, const std::function<void()>& work)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(work);
}

} // namespace sward::bake
