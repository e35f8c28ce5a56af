#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace divot::core {

/// Adds up wall time and calls by stage. A stage that runs inside another takes its time away from it, so that the sum
/// is the whole. Nothing is allocated.
template <std::size_t kCount>
class Timers {
 public:
  /// Runs `work` and adds its time to timer `index`.
  template <class Work>
  auto time(std::size_t index, Work&& work) {
    const Running running(*this, index);
    return work();
  }
  double ms(std::size_t index) const { return ms_[index]; }
  std::uint64_t calls(std::size_t index) const { return calls_[index]; }

  /// What has been added up so far, and to go on from that.
  struct Totals {
    std::array<double, kCount> ms{};
    std::array<std::uint64_t, kCount> calls{};
  };
  Totals totals() const { return {ms_, calls_}; }
  void go_on_from(const Totals& totals) { ms_ = totals.ms, calls_ = totals.calls; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kNobody = kCount;

  class Running {
   public:
    Running(Timers& timers, std::size_t index) : timers_(timers), outer_(timers.current_) { timers_.switch_to(index); }
    ~Running() {
      ++timers_.calls_[timers_.current_];
      timers_.switch_to(outer_);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    Timers& timers_;
    std::size_t outer_;
  };

  void switch_to(std::size_t index) {
    const Clock::time_point now = Clock::now();
    if (current_ != kNobody) ms_[current_] += std::chrono::duration<double, std::milli>(now - since_).count();
    current_ = index;
    since_ = now;
  }

  std::array<double, kCount> ms_{};
  std::array<std::uint64_t, kCount> calls_{};
  std::size_t current_ = kNobody;
  Clock::time_point since_;
};

}  // namespace divot::core
