#include "viewer/live_world.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace divot::viewer {
namespace {

constexpr int kMostSteps = 4;          // a picture
constexpr double kStepBudget = 0.04;   // s a picture, after which no further step begins
constexpr double kLagShown = 0.5;      // s
constexpr double kFactorMemory = 0.5;  // s
constexpr double kSlowdown = 4, kSlowest = 1.0 / 16;

}  // namespace

Result<LiveWorld> LiveWorld::create(const Scene& scene, std::shared_ptr<const Jobs> jobs) {
  return World::create(scene, jobs).map([&](World&& world) {
    world.keep_commands();
    return LiveWorld(std::move(world), jobs);
  });
}

void LiveWorld::advance(double real) {
  const double before = world_.time(), dt = world_.scene().dt;
  if (!paused_) due_ += real * speed_;
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  for (int steps = 0; due_ >= dt && steps < kMostSteps && spent() < kStepBudget; ++steps) {
    world_.step();
    due_ -= dt;
  }
  lag_ = due_ >= dt ? kLagShown : std::max(lag_ - real, 0.0);
  due_ = std::fmod(due_, dt);
  if (!(real > 0)) return;
  const double share = 1 - std::exp(-real / kFactorMemory);
  factor_ = paused_ ? 0 : factor_ + share * ((world_.time() - before) / real - factor_);
}

void LiveWorld::step() { world_.step(); }

Result<void> LiveWorld::restart() {
  return World::create(world_.scene(), jobs_).map([&](World&& world) {
    world_ = std::move(world);
    world_.keep_commands();
    due_ = lag_ = 0;
  });
}

void LiveWorld::next_speed() { speed_ = speed_ <= kSlowest ? 1 : speed_ / kSlowdown; }

}  // namespace divot::viewer
