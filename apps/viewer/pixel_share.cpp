#include "viewer/pixel_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace divot::viewer {
namespace {

// Stretching has a price of its own, so that shares near 1 would save nothing.
constexpr std::array kShares = {1.0, 0.7, 0.5};
constexpr double kMemory = 0.25;                          // s that the mean looks back
constexpr double kSoonest = 0.5;                          // s from one share to one with fewer pixels
constexpr double kPatience = 3;                           // s to one with more, as a change of sharpness is seen
constexpr double kTooSlow = 1.05, kFastEnough = 1 / 1.8;  // of what a picture may take
constexpr double kLongest = 2;  // likewise; a longer picture counts as this: something else may have held it up

}  // namespace

double PixelShare::share() const { return kShares[level_]; }

void PixelShare::see(double seconds) {
  seconds = std::min(seconds, kLongest * wanted_);
  mean_ = settled_ > 0 ? mean_ + (1 - std::exp(-seconds / kMemory)) * (seconds - mean_) : seconds;
  settled_ += seconds;
  if (settled_ > kSoonest && mean_ > kTooSlow * wanted_ && level_ + 1 < kShares.size()) return change(level_ + 1);
  if (settled_ > kPatience && mean_ < kFastEnough * wanted_ && level_ > 0) change(level_ - 1);
}

void PixelShare::change(std::size_t level) {
  level_ = level;
  settled_ = 0;
}

}  // namespace divot::viewer
