// Whatever numbers a scene holds, it is refused with a reason, or runs and stays a matter of numbers.
#include <chrono>
#include <limits>

#include "scene/describe.h"
#include "support.h"

namespace divot {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Puts a hostile value into the n-th number of a scene, counting the components of vectors.
class Saboteur : public scene::HeldVisitor {
 public:
  /// `which`: of the values that are tried at each number.
  Saboteur(std::size_t number, std::size_t which) : number_(number), which_(which) {}
  static constexpr std::size_t kValues = 12;
  std::string where;  // path of the key; empty where the scene has fewer numbers
  double value = 0;

  void number(const scene::Key& key, double& target) override {
    if (is_here(key)) target = value;
  }
  void integer(const scene::Key& key, std::int64_t& target) override {
    if (is_here(key)) target = static_cast<std::int64_t>(std::clamp(std::isnan(value) ? 0 : value, -9.2e18, 9.2e18));
  }
  void flag(const scene::Key&, bool&) override {}
  void text(const scene::Key&, std::string&) override {}
  void vector(const scene::Key& key, Vec3d& target) override {
    for (double* component : {&target.x, &target.y, &target.z}) number(key, *component);
  }
  void place(const scene::Key& position, const scene::Key&, Vec3d& target, bool&) override { vector(position, target); }
  void maybe_number(const scene::Key& key, std::optional<double>& target) override {
    if (is_here(key)) target = value;
  }
  void maybe_vector(const scene::Key& key, std::optional<Vec3d>& target) override {
    if (is_here(key)) target = Vec3d{value, value, value};
  }
  void profile(const scene::Key& key, Profile& target) override {
    if (is_here(key)) target = value;
  }
  void option(const scene::Key&, scene::Names, std::size_t&) override {}
  void options(const scene::Key&, scene::Names, std::vector<std::string>&) override {}
  void legend(const scene::Key&, std::vector<LegendEntry>&) override {}
  void policy(const scene::Key&, UpdatePolicy&) override {}
  void base(const scene::Key&, Material&, std::span<const Material>) override {}

 private:
  // The ends of the key's own range are the worst of what is allowed.
  bool is_here(const scene::Key& key) {
    if (seen_++ != number_) return false;
    const double values[kValues] = {0,    -1,    1e30, -1e30,         1e-310,         std::nan(""),
                                    kInf, 1e-30, 1e9,  key.range.low, key.range.high, 0.999 * key.range.high};
    value = values[which_];
    where = path_to(key.name);
    return true;
  }
  std::size_t number_, which_, seen_ = 0;
};

// Something of everything, on little ground.
Scene everything() {
  Scene scene;
  Material soil = *find_preset("sandy_loam"), road = *find_preset("asphalt");
  soil.name = "soil", road.name = "road", road.over = "soil", road.over_thickness = 0.05;
  scene.materials = {soil, road};
  scene.terrain = {
      .shape = GridTerrain{.columns = 15, .rows = 15, .spacing = 0.2}, .material = "road", .max_vertices = 5000};
  scene.duration = 1;
  scene.bodies = {
      {.name = "ball", .shape = Sphere{0.3}, .mass = 200, .position = {-0.6, 0, 0}, .above_ground = true},
      {.name = "box", .shape = Box{{0.4, 0.4, 0.3}}, .mass = 90, .position = {0.5, 0.5, 0}, .above_ground = true},
      {.name = "wheel", .shape = Cylinder{0.3, 0.2}, .mass = 30, .position = {0.5, -0.4, 0.2}, .above_ground = true},
      {.name = "cone",
       .shape = Compound{{{Cone{0.2, 0.4}, {0, 0, 0}, {}}, {Capsule{0.1, 0.3}, {0, 0, 0.2}, {}}}},
       .mass = 20,
       .position = {-0.4, -0.8, 1}}};
  scene.joints = {{.name = "w",
                   .type = JointType::wheel,
                   .first = "box",
                   .second = "wheel",
                   .stiffness = 5000,
                   .damping = 300,
                   .motor_speed = 3,
                   .motor_force = 50,
                   .steering_deg = 5},
                  {.name = "s", .type = JointType::spring, .first = "", .second = "ball", .stiffness = 50},
                  {.name = "h", .type = JointType::hinge, .first = "box", .second = "cone", .lower = -10, .upper = 10}};
  scene.bombs = {{.time = 0.02, .position = {0, 0, 0}, .above_ground = true, .yield = 1e-4}};
  return scene;
}

// Runs what is not refused; false where it was.
bool survives(const Scene& scene, int steps) {
  auto world = World::create(scene);
  if (!world) {
    EXPECT_FALSE(world.error().empty() || world.error()[0].text().empty());
    return false;
  }
  for (int k = 0; k < steps; ++k) world->step();
  EXPECT_TRUE(test::all_finite(*world));
  const SoilVolume soil = world->soil_volume();
  EXPECT_TRUE(std::isfinite(soil.displaced) && std::isfinite(soil.compacted) && std::isfinite(soil.deposited));
  for (const Crater& crater : world->craters())
    EXPECT_TRUE(std::isfinite(crater.width) && std::isfinite(crater.depth) && std::isfinite(crater.volume));
  return true;
}

// Sanitized programs are slower by so much.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kSlower = 10;
#else
constexpr double kSlower = 1;
#endif

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kSlower;
}

TEST(Hostile, AnyNumberOfASceneIsRefusedOrRuns) {
  int refused = 0, ran = 0;
  for (std::size_t number = 0;; ++number) {
    for (std::size_t which = 0; which < Saboteur::kValues; ++which) {
      Scene scene = everything();
      Saboteur saboteur(number, which);
      describe(saboteur, scene);
      if (saboteur.where.empty()) {
        EXPECT_GT(refused, 500);
        EXPECT_GT(ran, 300);
        return;
      }
      SCOPED_TRACE(testing::Message() << saboteur.where << " = " << saboteur.value);
      const double took = seconds_of([&] { (survives(scene, 6) ? ran : refused) += 1; });
      EXPECT_LT(took, 20) << "it hangs";
      if (HasFailure()) return;
    }
  }
}

TEST(Hostile, NoStepIsTooLong) {
  Scene scene = everything();
  scene.dt = 10, scene.duration = 100;
  EXPECT_FALSE(survives(scene, 1)) << "a step of 10 s is out of range";
  scene.dt = 1;
  EXPECT_TRUE(survives(scene, 10));
}

TEST(Hostile, ThousandsOfBombsInOnePlace) {
  Scene scene = everything();
  for (int k = 0; k < 2000; ++k)
    scene.bombs.push_back(
        {.time = 0.02 + 1e-4 * (k % 7), .position = {0.1, 0.1, 0}, .above_ground = true, .yield = 1e-3});
  EXPECT_LT(seconds_of([&] { EXPECT_TRUE(survives(scene, 8)); }), 60);
}

TEST(Hostile, BodiesBornInsideEachOther) {
  Scene scene = everything();
  for (int k = 0; k < 40; ++k) {
    scene.bodies.push_back(
        {.name = "twin " + std::to_string(k), .shape = Box{{0.3, 0.3, 0.3}}, .mass = 10.0 + k, .position = {0, 0, 1}});
    scene.bodies.push_back(
        {.name = "ball " + std::to_string(k), .shape = Sphere{0.2}, .mass = 1e-3, .position = {0, 0, 1}});
  }
  EXPECT_LT(seconds_of([&] { EXPECT_TRUE(survives(scene, 30)); }), 60);
}

TEST(Hostile, BodiesBelowTheGroundAreRefused) {
  Scene scene = everything();
  scene.bodies[0].above_ground = false;
  scene.bodies[0].position = {0, 0, -5};
  EXPECT_FALSE(survives(scene, 1));
}

// What would take too much memory is refused before any is taken, with the number.
TEST(Hostile, MemoryHasLimits) {
  Scene scene = everything();
  scene.terrain.max_vertices = TerrainSource{}.max_vertices;
  scene.terrain.shape = GridTerrain{.columns = 1'000'000, .rows = 1'000'000, .spacing = 1};
  const auto world = World::create(scene);
  ASSERT_FALSE(world);
  EXPECT_NE(world.error()[0].text().find("1000000000000"), std::string::npos) << world.error()[0].text();
}

}  // namespace
}  // namespace divot
