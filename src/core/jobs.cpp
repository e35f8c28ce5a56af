#include "divot/jobs.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>

// oneTBB as installed is not instrumented, so that ThreadSanitizer cannot see that it starts work after what came
// before and returns after work is done. It is told here, rather than in suppressions, which would hide our own races
// as well. What oneTBB's headers do is none of its business: this file is compiled without it.
#ifdef DIVOT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace divot {
namespace {

/// What is ordered with what: the caller before all ranges and these before the caller, but no range before another.
struct Order {
#ifdef DIVOT_THREAD_SANITIZER
  void fork() { __tsan_release(&before_); }
  void begin() { __tsan_acquire(&before_); }
  void end() { __tsan_release(&after_); }
  void join() { __tsan_acquire(&after_); }

 private:
  char before_ = 0, after_ = 0;
#else
  void fork() {}
  void begin() {}
  void end() {}
  void join() {}
#endif
};

}  // namespace

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
#ifdef DIVOT_THREAD_SANITIZER
  grain = grain / 256 + 1;  // so that small worlds of tests are shared out as well
#endif
  if (count <= grain || thread_count() == 1) return work(0, count);
  if (runner_) return runner_(count, grain, work);
  Order order;
  order.fork();
  arena_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        order.begin();
                        work(range.begin(), range.end());
                        order.end();
                      });
  });
  order.join();
}

}  // namespace divot
