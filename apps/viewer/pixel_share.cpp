#include "viewer/pixel_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace divot::viewer {
namespace {

// Stretching has a price of its own, so that shares near 1 would save nothing.
constexpr std::array kShares = {1.0, 0.7, 0.5};
constexpr double kMemory = 0.25;                          // s that the mean looks back
constexpr double kWorthwhile = 0.93;                      // of what pictures took with more pixels
constexpr double kSoonest = 0.5;                          // s of slow pictures that make a share one with fewer pixels
constexpr double kRest = 15;                              // likewise, after that had gained nothing
constexpr double kPatience = 3;                           // s to one with more, as a change of sharpness is seen
constexpr double kTooSlow = 1.05, kFastEnough = 1 / 1.8;  // of what a picture may take
constexpr double kLongest = 2;  // likewise; a longer picture counts as this: something else may have held it up

}  // namespace

PixelShare::PixelShare(double wanted) : wanted_(wanted), hold_(kSoonest) {}

double PixelShare::share() const { return kShares[level_]; }

void PixelShare::see(double seconds) {
  const double counted = std::min(seconds, kLongest * wanted_);
  const auto approach = [this](double& mean, double value) {
    mean += (settled_ > 0 ? 1 - std::exp(-value / kMemory) : 1) * (value - mean);
  };
  approach(mean_, counted);
  approach(whole_, seconds);
  settled_ += seconds;
  slow_ = mean_ > kTooSlow * wanted_ ? slow_ + counted : 0;
  if (before_ > 0 && settled_ > kSoonest) {
    const bool gained = whole_ < kWorthwhile * before_;
    before_ = 0;
    hold_ = gained ? kSoonest : kRest;
    if (!gained) return change(level_ - 1);
  }
  if (settled_ > hold_ && slow_ > kSoonest && level_ + 1 < kShares.size()) {
    before_ = whole_;
    return change(level_ + 1);
  }
  if (settled_ > kPatience && mean_ < kFastEnough * wanted_ && level_ > 0) change(level_ - 1);
}

void PixelShare::change(std::size_t level) {
  level_ = level;
  settled_ = slow_ = 0;
}

}  // namespace divot::viewer
