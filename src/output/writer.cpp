#include "output/writer.h"

#include <exception>
#include <utility>

namespace divot::output {
namespace {

// What a task throws (out of memory, for one) must not end the program.
Result<void> carry_out(const Writer::Task& task) try { return task(); } catch (const std::exception& error) {
  return fail({.problem = std::string("results cannot be written: ") + error.what()});
}

}  // namespace

Writer::Writer(std::size_t most_bytes) : most_bytes_(most_bytes), thread_([this] { work(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  added_.notify_one();
  thread_.join();
}

void Writer::push(std::size_t bytes, Task task) {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return queue_.empty() || bytes_ + bytes <= most_bytes_; });
  if (!failure_.empty()) return;
  queue_.push_back({bytes, std::move(task)});
  bytes_ += bytes;
  added_.notify_one();
}

Result<void> Writer::status() const {
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) return {};
  return tl::unexpected(failure_);
}

Result<void> Writer::drain() {
  {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return queue_.empty(); });
  }
  return status();
}

void Writer::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    added_.wait(lock, [&] { return closed_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const bool failed = !failure_.empty();
    const Task task = std::move(queue_.front().task);
    lock.unlock();
    Result<void> result = failed ? Result<void>{} : carry_out(task);
    lock.lock();
    if (!result) failure_ = std::move(result.error());
    bytes_ -= queue_.front().bytes;
    queue_.pop_front();
    done_.notify_all();
  }
}

}  // namespace divot::output
