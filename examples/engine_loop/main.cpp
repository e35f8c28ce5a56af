// How an engine of one's own drives a world: frames of uneven length, a fixed step, and a copy of the vertices that
// stands for the graphics card's and is sent only what changed.
#include <divot/divot.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

namespace {

// What glBufferSubData and its kin do.
class VertexBuffer {
 public:
  explicit VertexBuffer(std::span<const divot::Vec3> positions) : memory_(positions.begin(), positions.end()) {}
  void send(std::size_t first, std::span<const divot::Vec3> part) {
    std::copy(part.begin(), part.end(), memory_.begin() + static_cast<std::ptrdiff_t>(first));
    bytes_sent_ += part.size_bytes();
  }
  const std::vector<divot::Vec3>& memory() const { return memory_; }
  std::size_t bytes_sent() const { return bytes_sent_; }

 private:
  std::vector<divot::Vec3> memory_;
  std::size_t bytes_sent_ = 0;
};

}  // namespace

int main() {
  divot::Scene scene;
  scene.dt = 1.0 / 60;
  scene.terrain = {
      .shape = divot::GridTerrain{.columns = 401,
                                  .rows = 401,
                                  .spacing = 0.25,
                                  .height = [](double x, double y) { return std::sin(0.1 * x) + 0.02 * y; }},
      .material = "dry_sand"};
  scene.bodies = {{.name = "boulder",
                   .shape = divot::Sphere{0.8},
                   .mass = 3000,
                   .position = {-10, 0, 0},
                   .above_ground = true,
                   .velocity = {6, 0, 0}}};
  auto world = divot::World::create(scene, std::make_shared<const divot::Jobs>(2));
  if (!world) return std::cerr << world.error().front().text() << '\n', 1;

  VertexBuffer buffer(world->surface().positions);
  world->take_dirty();  // the buffer has all of it
  double owed = 0;      // s of the engine's time that the world has not been stepped through
  int frames = 0;
  for (double shown = 0; shown < 3; ++frames) {
    const double frame_time = frames % 7 == 0 ? 0.031 : 0.012;  // as a display would have it
    shown += frame_time;
    owed += frame_time;
    // The player clicks.
    if (frames == 60)
      if (auto ok =
              world->add_bomb({.time = world->time(), .position = {4, 2, 0}, .above_ground = true, .yield = 0.002});
          !ok)
        return std::cerr << ok.error().front().text() << '\n', 1;
    for (; owed >= scene.dt; owed -= scene.dt) world->step();
    for (const auto& [first, last] : world->take_dirty())
      buffer.send(first, world->surface().positions.subspan(first, last - first));
  }

  const auto positions = world->surface().positions;
  const bool same = std::equal(positions.begin(), positions.end(), buffer.memory().begin());
  const double all = static_cast<double>(positions.size_bytes()) * frames;
  std::cout << frames << " frames, " << world->steps() << " steps; sent "
            << 100 * static_cast<double>(buffer.bytes_sent()) / all
            << " % of what sending everything takes; the buffer " << (same ? "is" : "is NOT")
            << " what the world has.\n";
  return same ? 0 : 1;
}
