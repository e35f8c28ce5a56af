#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "viewer/renderer.h"
#include "viewer/test_surface.h"

// What tests of pictures share: a plain with the paper's ball and bomb, and where its points appear.
namespace divot::viewer {

inline TestSurface paper_ground() {
  return TestSurface(37, 40, 10.9, [](double, double) { return 0.0; });
}

// The paper's ball beside the crater to come.
inline BodyView paper_ball(const TestSurface& ground) {
  BodyView ball;
  ball.radius = 75;
  ball.position = ground.place(-150, 20, 76);
  return ball;
}

inline BombView paper_bomb(const TestSurface& ground, bool exploded) {
  BombView bomb;
  bomb.position = ground.place(0, 0, 10);
  bomb.yield = 5000;
  bomb.exploded = exploded;
  return bomb;
}

// Ranges that hold every vertex there can be.
inline constexpr std::array<DirtyRange, 1> kAll = {DirtyRange{0, 0xffffffffu}};

// What a test shows; drawn small, as the software driver is slow.
struct Shown {
  explicit Shown(const TestSurface& on) : ground(on), bodies{paper_ball(on)}, bombs{paper_bomb(on, true)} {}

  Renderer renderer(RenderOptions options = {}) const {
    options.width = 320;
    options.height = 180;
    auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().front().text());
    return std::move(*made);
  }
  void update(Renderer& renderer, std::span<const DirtyRange> dirty = {}, double time = 0) const {
    renderer.update(
        ground.view(), dirty, bodies, bombs, [&](std::uint32_t v) { return ground.sinkage(v); }, time);
  }
  Image draw(const RenderOptions& options = {}) const {
    Renderer made = renderer(options);
    update(made);
    return made.pixels().value();
  }

  const TestSurface& ground;
  std::vector<BodyView> bodies;
  std::vector<BombView> bombs;
};

// Pixels that differ by more than rounding, within columns [left, right) and rows [top, bottom).
inline int differing(const Image& a, const Image& b, int left, int top, int right, int bottom) {
  int count = 0;
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      int largest = 0;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t i =
            3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(a.width) + column) + channel;
        largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
      }
      count += largest > 2;
    }
  }
  return count;
}

inline int differing(const Image& a, const Image& b) { return differing(a, b, 0, 0, a.width, a.height); }

// Where a point of the terrain appears in a picture of `camera`.
inline std::pair<double, double> project(const Camera& camera, const Vec3d& point, int width, int height) {
  const Vec3d toward = camera.target - camera.eye, forward = toward * (1 / length(toward));
  const Vec3d side = cross(forward, {0, 0, 1}), right = side * (1 / length(side)), up = cross(right, forward);
  const Vec3d p = point - camera.eye;
  const double scale = height / 2.0 / std::tan(camera.fov_deg * std::numbers::pi / 360) / dot(p, forward);
  return {width / 2.0 + scale * dot(p, right), height / 2.0 - scale * dot(p, up)};
}

}  // namespace divot::viewer
