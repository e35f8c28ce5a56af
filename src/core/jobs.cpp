#include "divot/jobs.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>

namespace divot {

struct Jobs::Arena {
  explicit Arena(int threads) : arena(threads) {}
  // More threads than cores are allowed, and oneTBB does not complain about them. The least limit that is alive counts,
  // so that all have to be the same.
  tbb::global_control limit{tbb::global_control::max_allowed_parallelism, 1024};
  mutable tbb::task_arena arena;
};

Jobs::Jobs(int threads) : arena_(std::make_unique<Arena>(threads > 0 ? threads : tbb::info::default_concurrency())) {}
Jobs::Jobs(int threads, Runner runner) : runner_(std::move(runner)), threads_(threads) {}
Jobs::~Jobs() = default;

int Jobs::thread_count() const { return arena_ ? arena_->arena.max_concurrency() : threads_; }

void Jobs::for_ranges(std::size_t count, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& work) const {
  if (count == 0) return;
  if (count <= grain || thread_count() == 1) return work(0, count);
  if (runner_) return runner_(count, grain, work);
  arena_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) { work(range.begin(), range.end()); });
  });
}

}  // namespace divot
