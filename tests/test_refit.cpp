// The BVH follows the ground: queries on a surface that moves against brute force, policies against each other.
#include <algorithm>

#include "refit/refit.h"
#include "state/region.h"
#include "support.h"

namespace divot::refit {
namespace {

using Policy = UpdatePolicy::Kind;

Tree make_tree(const state::Surface& surface, float margin) {
  Tree tree;
  tree.margin = margin;
  build(tree, surface, Jobs(1));
  return tree;
}

// Every face whose own box meets `box` must be among those the tree finds.
void expect_nothing_missed(const Tree& tree, const state::Surface& s, const math::Aabb& box) {
  std::vector<std::uint32_t> found;
  tree.bvh.query(box, found);
  for (std::uint32_t face = 0; face < s.mesh.face_count(); ++face) {
    math::Aabb own;
    for (std::uint32_t k = 0; k < 3; ++k) own.include(s.position[s.mesh.origin(3 * face + k)]);
    ASSERT_TRUE(!own.overlaps(box) || std::binary_search(found.begin(), found.end(), face)) << "face " << face;
  }
}

math::Aabb random_box(test::Random& random) {
  math::Aabb box;
  const Vec3 corner{random.in(-12.0f, 12.0f), random.in(-12.0f, 12.0f), random.in(-4.0f, 1.0f)};
  box.include(corner);
  box.include(corner + Vec3{random.in(0.0f, 3.0f), random.in(0.0f, 3.0f), random.in(0.0f, 2.0f)});
  return box;
}

// Ground that sinks here and there, a little or a lot at a time.
TEST(Refit, QueriesFindAllOnGroundThatMoves) {
  state::Surface s = test::make_surface({.columns = 25, .rows = 25, .spacing = 1});
  Tree tree = make_tree(s, 0.1f);
  test::Random random(4);
  for (int step = 0; step < 300; ++step) {
    std::vector<std::uint32_t> moved;
    const float most = step % 50 == 0 ? 0.5f : 0.02f;
    for (int k = 0; k < 20; ++k) {
      const std::uint32_t v = random.below(s.position.size());
      if (std::find(moved.begin(), moved.end(), v) != moved.end()) continue;
      s.position[v] +=
          random.in(0.0f, 0.57f) * Vec3{random.in(-most, most), random.in(-most, most), random.in(-most, most)};
      moved.push_back(v);
      moved.push_back(v);
    }
    update(tree, s, moved, most, {}, Jobs(1));
    for (int k = 0; k < 3; ++k) expect_nothing_missed(tree, s, random_box(random));
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(tree.refits, 4u);
  EXPECT_LT(tree.refits + tree.rebuilds, 300u) << "most steps need nothing";
}

TEST(Refit, NothingIsDoneUntilSomethingLeftItsMargin) {
  state::Surface s = test::make_surface({.columns = 9, .rows = 9, .spacing = 1});
  Tree tree = make_tree(s, 0.1f);
  for (int step = 0; step < 9; ++step) {
    s.position[40].z -= 0.01f;
    update(tree, s, {40}, 0.01f, {}, Jobs(1));
  }
  EXPECT_EQ(tree.refits, 0u);
  for (int step = 0; step < 9; ++step) {
    s.position[40].z -= 0.01f;
    update(tree, s, {40}, 0.01f, {}, Jobs(1));
  }
  EXPECT_EQ(tree.refits, 1u);
  EXPECT_EQ(tree.rebuilds, 1u) << "the first build";
}

TEST(Refit, BoxesThatHaveGrownAreBuiltAnew) {
  state::Surface s = test::make_surface({.columns = 9, .rows = 9, .spacing = 1});
  Tree tree = make_tree(s, 0.1f);
  for (int step = 0; step < 20; ++step) {
    for (std::uint32_t v = 0; v < 81; v += 5) s.position[v].z -= 0.5f;
    std::vector<std::uint32_t> moved;
    for (std::uint32_t v = 0; v < 81; v += 5) moved.push_back(v);
    update(tree, s, moved, 0.5f, {}, Jobs(1));
  }
  EXPECT_GT(tree.rebuilds, 1u);
  EXPECT_LE(tree.bvh.degradation(), 3 * kWorn);
}

TEST(Refit, PoliciesAskForWhatTheySay) {
  const state::Surface s = test::make_surface({.columns = 5, .rows = 5, .spacing = 1});
  Tree each = make_tree(s, 0.1f), third = make_tree(s, 0.1f);
  for (int step = 0; step < 9; ++step) {
    update(each, s, {}, 0, {Policy::every_step}, Jobs(1));
    update(third, s, {}, 0, {Policy::every, 3}, Jobs(1));
  }
  EXPECT_EQ(each.rebuilds, 10u);
  EXPECT_EQ(third.rebuilds, 4u);
}

// ---- in a world: a ball that rolls over dry sand into a crater

Scene rolling_scene(UpdatePolicy policy) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 61, .rows = 41, .spacing = 0.25}, .material = "dry_sand"};
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{0.8},
                   .mass = 1500,
                   .position = {-4, 0.1, 0},
                   .above_ground = true,
                   .velocity = {3, 0, 0}}};
  scene.bombs = {{.time = 0.3, .position = {1.5, 0.3, 0}, .yield = 0.0005}};
  scene.solver.bvh_update = policy;
  return scene;
}

// Height of the highest triangle over a point, looking at all of them.
double brute_force_height(const World& world, double x, double y) {
  const SurfaceView s = world.surface();
  double best = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t f = 0; f + 2 < s.triangles.size(); f += 3) {
    const Vec3d a = to_double(s.positions[s.triangles[f]]), b = to_double(s.positions[s.triangles[f + 1]]);
    const Vec3d c = to_double(s.positions[s.triangles[f + 2]]);
    const double whole = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / whole;
    const double v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / whole;
    if (u < 0 || v < 0 || u + v > 1) continue;
    const double z = u * a.z + v * b.z + (1 - u - v) * c.z;
    if (!(best >= z)) best = z;
  }
  return best;
}

TEST(Refit, GroundHeightIsBruteForcesAllAlong) {
  World world = test::make_world(rolling_scene({}));
  test::Random random(5);
  for (int step = 0; step < 120; ++step) {
    world.step();
    for (int k = 0; k < 20; ++k) {
      const double x = random.in(-7.4, 7.4), y = random.in(-4.9, 4.9);
      ASSERT_NEAR(world.ground_height(x, y), brute_force_height(world, x, y), 1e-5) << step << ": " << x << ' ' << y;
    }
  }
  EXPECT_GT(world.updates().bvh_refits, 0u);
  EXPECT_TRUE(std::isnan(world.ground_height(100, 0)));
}

// How often the tree is brought up to date must not show in the ground.
TEST(Refit, AdaptiveGivesTheGroundOfEveryStep) {
  World adaptive = test::make_world(rolling_scene({})), each = test::make_world(rolling_scene({Policy::every_step}));
  test::run_to(adaptive, 3), test::run_to(each, 3);
  double furthest = 0, deepest = 0;
  for (std::size_t v = 0; v < adaptive.surface().positions.size(); ++v) {
    furthest = std::max<double>(furthest, length(adaptive.surface().positions[v] - each.surface().positions[v]));
    deepest = std::max<double>(deepest, adaptive.sinkage(static_cast<std::uint32_t>(v)));
  }
  EXPECT_GT(deepest, 0.1);
  EXPECT_LT(furthest, 1e-3);
  EXPECT_LT(length(adaptive.bodies()[0].position - each.bodies()[0].position), 1e-3);
  EXPECT_LT(adaptive.updates().bvh_refits + adaptive.updates().bvh_rebuilds, each.updates().bvh_rebuilds);
}

}  // namespace
}  // namespace divot::refit
