#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace divot {

/// Worker threads that a caller lends to a world. Nothing that runs on them may depend on how a range is cut.
class Jobs {
 public:
  /// Runs `work(begin, end)` on ranges that cover [0, count) once, none cut below half of `grain`, and returns when all
  /// are done. Work throws nothing and asks for no jobs itself.
  using Runner = std::function<void(std::size_t count, std::size_t grain,
                                    const std::function<void(std::size_t begin, std::size_t end)>& work)>;

  /// `threads`: 1 runs everything on the calling thread; 0 takes one for each core of the machine.
  explicit Jobs(int threads = 1);
  /// Threads of an engine's own: `runner` is called in place of divot's. `threads` >= 1 is how many it has.
  Jobs(int threads, Runner runner);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  int thread_count() const;  ///< >= 1

  /// Calls `work(begin, end)` on ranges that cover [0, count) once. Ranges are not cut below half of `grain`.
  /// Returns when all are done. A count of at most `grain` runs on the calling thread.
  void for_ranges(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& work) const;

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;  // null with a runner
  Runner runner_;
  int threads_ = 1;
};

}  // namespace divot
