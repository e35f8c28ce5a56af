#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "divot/errors.h"

namespace divot::output {

/// A thread that does what writes to disk, in order, so that whoever steps a world does not wait for the disk. What
/// waits is bounded in memory: beyond it push() waits. After the first failure nothing more is written.
class Writer {
 public:
  using Task = std::function<Result<void>()>;

  /// `most_bytes`: what may wait in memory; one task is taken in any case.
  explicit Writer(std::size_t most_bytes);
  /// Waits until everything is written.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Adds a task that keeps `bytes` of memory until it is done.
  void push(std::size_t bytes, Task task);

  /// The first failure so far.
  Result<void> status() const;

  /// Waits until everything is written; then the first failure, if there was one.
  Result<void> drain();

 private:
  struct Waiting {
    std::size_t bytes;
    Task task;
  };
  void work();

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable added_, done_;
  std::deque<Waiting> queue_;  // the first stays until it is done
  std::size_t bytes_ = 0;
  bool closed_ = false;
  Errors failure_;
  std::thread thread_;
};

}  // namespace divot::output
