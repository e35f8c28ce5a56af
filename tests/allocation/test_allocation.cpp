// Nothing is allocated in a step once all arrays have grown: every operator new of the program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

#include "divot/divot.h"

namespace {
std::atomic<std::size_t> allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
// As std::stable_sort asks for its buffer.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace divot {
namespace {

// Balls that roll to and fro in a bowl, over ground that they have touched before, and the craters of two bombs.
Scene bowl() {
  Scene scene;
  scene.terrain.shape = GridTerrain{
      .columns = 65, .rows = 65, .spacing = 1, .height = [](double x, double y) { return 0.02 * (x * x + y * y); }};
  scene.terrain.material = "dry_sand";
  for (int k = 0; k < 5; ++k)
    scene.bodies.push_back({.name = "ball " + std::to_string(k),
                            .shape = Sphere{1},
                            .mass = 3000,
                            .position = {4.0 * k - 8, 3.0 * k - 6, 0},
                            .above_ground = true,
                            .velocity = {0, 2, 0}});
  scene.bombs = {{.time = 0.1, .position = {15, 15, 0}, .above_ground = true, .yield = 0.05},
                 {.time = 0.2, .position = {-15, 12, 0}, .above_ground = true, .yield = 0.05}};
  return scene;
}

// Allocations in steps (first, last].
std::size_t count(const Scene& scene, int threads, int first, int last) {
  auto world = World::create(scene, std::make_shared<const Jobs>(threads));
  EXPECT_TRUE(world);
  for (int k = 0; k < first; ++k) world->step();
  const std::size_t before = allocations;
  for (int k = first; k < last; ++k) world->step();
  return allocations - before;
}

TEST(Allocation, OperatorNewIsCounted) {
  const std::size_t before = allocations;
  const auto held = std::make_unique<int>(1);
  EXPECT_EQ(allocations, before + 1);
}

// Ground that moves everywhere, by both integrators.
TEST(Allocation, NoneInStepsOfMovingGround) {
  for (const Integrator integrator : {Integrator::euler, Integrator::rk4})
    for (const int threads : {1, 2}) {
      Scene scene;
      scene.terrain.shape = GridTerrain{.columns = 65, .rows = 65, .spacing = 10.9};
      scene.solver.integrator = integrator;
      auto world = World::create(scene, std::make_shared<const Jobs>(threads));
      ASSERT_TRUE(world);
      ASSERT_TRUE(world->push_ground({.radius = 2000, .velocity = {0.2, 0, 0.5}}));
      for (int k = 0; k < 5; ++k) world->step();
      const std::size_t before = allocations;
      for (int k = 0; k < 15; ++k) world->step();
      EXPECT_EQ(allocations - before, 0u) << threads;
      EXPECT_GT(world->particles().x.size(), 4000u);
    }
}

// Balls still come to ground that nobody has touched, for which an array doubles now and then: a few in a second, where
// anything that allocates by itself would do so in each of the 60 steps.
TEST(Allocation, AlmostNoneWithBallsAndCratersOnceArraysHaveGrown) {
  for (const int threads : {1, 2}) EXPECT_LT(count(bowl(), threads, 240, 300), 12u) << threads;
}

}  // namespace
}  // namespace divot
