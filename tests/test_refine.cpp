// New triangles: halving moves nothing, joining keeps the books, and worlds with them give what fine grids give.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bvh.h"
#include "geometry/solid.h"
#include "refine/edges.h"
#include "refine/join.h"
#include "refine/refine.h"
#include "state/region.h"
#include "support.h"

namespace divot::refine {
namespace {

// ---- halving and joining

// A sheet of soil that has been through something, everything at rest where it is.
struct Worked {
  test::Sheet s;
  std::vector<state::Blast> blasts;
  std::vector<std::uint32_t> touched;
  test::Random random{11};

  explicit Worked(bool pressed = true) : s(test::make_sheet({.columns = 12, .rows = 11, .spacing = 1}, {soil()})) {
    s.surface.bisection.start(s.surface.mesh);
    for (std::size_t c = 0; c < s.soil.size(); ++c) {
      const float sunk = random.in(0.0f, 0.1f);
      s.surface.position[s.soil.vertex[c]].z = s.particles.z[c] = -sunk;
      s.soil.rest[c].z = pressed ? 0.001f - sunk : -sunk;
      s.soil.plastic[c] = 0.5f + sunk;  // so that it answers elastically
      s.soil.gained[c] = random.in(-0.1, 0.1), s.soil.compacted[c] = random.in(0.0, 0.1);
      s.soil.loose[c] = random.in(0.0f, 0.1f);
    }
  }
  static Material soil() {
    Material m = *find_material({}, "dry_sand");
    m.cohesion = 1e9;  // it answers to the pull of any height
    return m;
  }
  std::function<std::uint8_t(double x, double y)> material_at;
  Ground ground() { return {s.surface, s.soil, s.particles, blasts, s.media, material_at, touched}; }
  void halve(int times) {
    Ground g = ground();
    const auto squared = [&](std::uint32_t h) { return squared_length(s.surface, s.soil, h); };
    for (int k = 0; k < times; ++k)
      halve_edge(g, longest_ahead(s.surface.mesh, random.below(s.surface.mesh.face_count()), squared));
    sort_rows(s.particles, s.soil);
  }
  void sleep() {
    s.particles.for_each_array([](auto& array) { array.clear(); });
    std::fill(s.soil.particle.begin(), s.soil.particle.end(), kNone);
  }
  double sum(const std::vector<double>& of) const {
    double all = 0;
    for (const double one : of) all += one;
    return all;
  }
  double sum(const std::vector<float>& of) const {
    double all = 0;
    for (const float one : of) all += static_cast<double>(one);
    return all;
  }
  // Between the surface and z = 0, m^3.
  double volume() const {
    double all = 0;
    for (std::uint32_t face = 0; face < s.surface.mesh.face_count(); ++face) {
      std::array<Vec3d, 3> p;
      for (std::uint32_t k = 0; k < 3; ++k) p[k] = to_double(s.surface.position[s.surface.mesh.origin(3 * face + k)]);
      const double twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
      all += twice * (p[0].z + p[1].z + p[2].z) / 6;
    }
    return all;
  }
  Vec3d force(float cutoff) {
    test::bond(s, cutoff);
    forces::Scratch scratch;
    const forces::Field field{s.soil, s.media, blasts, Cohesion::lennard_jones, cutoff, {1e18f}};
    forces::evaluate(s.particles, s.bonds, s.motion(), 0, field, forces::Renew::no, scratch, Jobs(1));
    return {sum(s.particles.fx), sum(s.particles.fy), sum(s.particles.fz)};
  }
};

TEST(Refine, HalvingKeepsEverySum) {
  Worked w;
  state::Blast blast;
  for (std::uint32_t c = 20; c < 90; ++c) {
    if (c % 3 == 0) continue;
    const bool inside = c < 50;
    (inside ? blast.column : blast.landing).push_back(c);
    if (inside) blast.push.push_back(w.random.in(0.0f, 1.0f)), blast.thrown.push_back(0.5f);
    if (!inside) blast.landing_height.push_back(w.random.in(0.0f, 1.0f));
  }
  w.blasts.push_back(blast);
  const auto landing = [&] {
    double all = 0;
    const state::Blast& b = w.blasts[0];
    for (std::size_t k = 0; k < b.landing.size(); ++k)
      all += static_cast<double>(b.landing_height[k]) * static_cast<double>(w.s.soil.area[b.landing[k]]);
    return all;
  };
  const state::Soil before = w.s.soil;
  const double volume = w.volume(), mass = w.sum(w.s.particles.mass), lands = landing();
  const std::vector<Vec3> places = w.s.surface.position;
  w.halve(400);
  const state::Soil& soil = w.s.soil;
  EXPECT_EQ(soil.size(), before.size() + 400);
  EXPECT_NEAR(w.sum(soil.area), w.sum(before.area), 1e-4);
  EXPECT_NEAR(w.sum(soil.cell), w.sum(before.cell), 1e-4);
  EXPECT_NEAR(w.sum(soil.gained), w.sum(before.gained), 1e-12);
  EXPECT_NEAR(w.sum(soil.compacted), w.sum(before.compacted), 1e-12);
  EXPECT_NEAR(w.sum(w.s.particles.mass), mass, 1e-5 * mass);
  EXPECT_NEAR(w.volume(), volume, 1e-5);
  EXPECT_NEAR(landing(), lands, 1e-5 * lands);
  EXPECT_TRUE(std::equal(places.begin(), places.end(), w.s.surface.position.begin())) << "nothing moves";
  for (std::size_t c = 0; c < soil.size(); ++c)
    EXPECT_NEAR(soil.area[c], state::vertex_area(w.s.surface, soil.vertex[c]), 1e-5) << "column " << c;
  EXPECT_TRUE(std::is_sorted(w.s.particles.vertex.begin(), w.s.particles.vertex.end()));
  for (std::uint32_t i = 0; i < w.s.particles.size(); ++i) EXPECT_EQ(soil.particle[w.s.particles.column[i]], i);
}

// New bonds are at rest; the ground's pressure is that of the halfway sinkage.
TEST(Refine, HalvingAtRestChangesNoForce) {
  Worked still(false);
  still.halve(300);
  still.force(1.6f);
  for (std::size_t i = 0; i < still.s.particles.size(); ++i) {
    EXPECT_NEAR(still.s.particles.fx[i], 0, 1e-3);
    EXPECT_NEAR(still.s.particles.fz[i], 0, 1e-3);
  }
  Worked w;
  const Vec3d before = w.force(0.1f);
  w.halve(300);
  const Vec3d after = w.force(0.1f);
  ASSERT_GT(before.z, 1e3);
  EXPECT_NEAR(after.z, before.z, 1e-4 * before.z);
  EXPECT_NEAR(after.x, before.x, 1e-6 * before.z);
}

// Borders of materials get as sharp as their map, but what has been broken stays so.
TEST(Refine, NewVerticesAskTheMapOfMaterials) {
  Worked w;
  w.s.media.push_back(w.s.media[0]);
  w.material_at = [](double x, double) { return static_cast<std::uint8_t>(x > 0.3); };
  for (std::uint32_t v = 0; v < w.s.surface.position.size(); ++v)
    w.s.surface.material[v] = static_cast<std::uint8_t>(w.s.surface.position[v].x > 0.3f);
  w.s.surface.material[8] = 0;
  w.halve(400);
  int broken = 0;
  for (std::uint32_t v = 132; v < w.s.surface.position.size(); ++v) {
    const bool right = w.s.surface.position[v].x > 0.3f;
    broken += w.s.surface.material[v] != (right ? 1 : 0);
    if (w.s.surface.position[v].y <= -3) continue;
    EXPECT_EQ(w.s.surface.material[v], right ? 1 : 0);
  }
  EXPECT_GT(broken, 0);
}

TEST(Refine, JoiningUndoesHalving) {
  Worked w;
  w.sleep();
  const state::Soil before = w.s.soil;
  const std::vector<Vec3> places = w.s.surface.position;
  w.halve(300);
  Ground g = w.ground();
  for (bool any = true; any;) {
    any = false;
    for (std::uint32_t v = 132; v < w.s.surface.mesh.vertex_count(); ++v) {
      if (!w.s.surface.bisection.can_merge(w.s.surface.mesh, v)) continue;
      EXPECT_LT(bulge_at(g, v, 1e-3f), 1e-6);
      join_edge(g, v), any = true;
    }
  }
  EXPECT_FALSE(w.s.surface.bisection.any());
  EXPECT_EQ(w.s.surface.mesh.validate(), "");
  EXPECT_TRUE(std::equal(places.begin(), places.end(), w.s.surface.position.begin()));
  EXPECT_NEAR(w.sum(w.s.soil.gained), w.sum(before.gained), 1e-9);
  EXPECT_NEAR(w.sum(w.s.soil.compacted), w.sum(before.compacted), 1e-5);
  for (std::size_t c = 0; c < before.size(); ++c) EXPECT_NEAR(w.s.soil.area[c], before.area[c], 1e-5);
}

// What a vertex moved away from the middle of its edge is in the books when it goes.
TEST(Refine, JoiningKeepsTheVolume) {
  Worked w(false);
  w.sleep();
  w.halve(1);
  const std::uint32_t v = 132;
  w.s.surface.position[v].z += 0.02f;
  Ground g = w.ground();
  EXPECT_NEAR(bulge_at(g, v, 1e-3f), 0.02, 1e-4);
  const double volume = w.volume(), compacted = w.sum(w.s.soil.compacted);
  join_edge(g, v);
  EXPECT_GT(volume - w.volume(), 1e-3);
  EXPECT_NEAR(w.sum(w.s.soil.compacted) - compacted, volume - w.volume(), 1e-6);
}

TEST(Refine, WhatIsAwakeOrOfAnotherSoilStays) {
  Worked w;
  w.halve(1);
  const std::uint32_t v = 132;
  Ground g = w.ground();
  EXPECT_FALSE(std::isfinite(bulge_at(g, v, 1e-3f))) << "awake";
  w.sleep();
  EXPECT_TRUE(std::isfinite(bulge_at(g, v, 1e-3f)));
  w.s.soil.plastic[w.s.surface.column[v]] += 0.01f;
  EXPECT_FALSE(std::isfinite(bulge_at(g, v, 1e-3f)));
  w.s.soil.plastic[w.s.surface.column[v]] -= 0.01f;
  w.s.surface.material[w.s.surface.bisection.parents(v)[1]] = 1;
  EXPECT_FALSE(std::isfinite(bulge_at(g, v, 1e-3f)));
}

// Boxes over the faces that the terrain started with find what became of them, wherever it moved.
TEST(Refine, FacesAreFoundBelowThoseTheyCameFrom) {
  Worked w;
  geometry::Bvh bvh;
  bvh.build(w.s.surface.mesh.face_count(), geometry::corners_in(w.s.surface.mesh.triangles()), w.s.surface.position,
            0.01f, geometry::Bvh::Order::as_numbered, Jobs(1));
  w.halve(500);
  for (std::uint32_t v = 132; v < w.s.surface.position.size(); ++v) {
    Vec3& p = w.s.surface.position[v];
    p.x += w.random.in(-0.02f, 0.02f), p.y += w.random.in(-0.02f, 0.02f), p.z += w.random.in(-3.0f, 1.0f);
  }
  w.s.surface.strayed = 0.03f;
  for (int k = 0; k < 200; ++k) {
    math::Aabb box;
    for (int corner = 0; corner < 2; ++corner)
      box.include(Vec3{w.random.in(-6.0f, 6.0f), w.random.in(-6.0f, 6.0f), w.random.in(-2.0f, 1.0f)});
    std::vector<std::uint32_t> found;
    state::faces_near(w.s.surface, bvh, box, found);
    for (std::uint32_t face = 0; face < w.s.surface.mesh.face_count(); ++face) {
      math::Aabb own;
      for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h)
        own.include(w.s.surface.position[w.s.surface.mesh.origin(h)]);
      ASSERT_EQ(std::binary_search(found.begin(), found.end(), face), own.overlaps(box));
    }
  }
}

// ---- edges

double edge_of(const Shape& shape, double load, const char* material = "dry_sand", const Accuracy& accuracy = {}) {
  return contact_edge(*geometry::make_solid(shape), {}, load, laws::make_medium(*find_material({}, material)),
                      accuracy);
}

// A chord of that length keeps off a ball by 4 % of the sinkage that Bekker's pressure gives it.
TEST(RefineEdges, FollowFromHowDeepABodySinks) {
  const double edge = edge_of(Sphere{0.6}, 600 * 9.81), sinkage = edge * edge / (8 * 0.6) / 0.04;
  EXPECT_NEAR(sinkage, 0.054, 0.002);
  EXPECT_GT(edge_of(Sphere{0.6}, 2000 * 9.81), edge);
  EXPECT_NEAR(edge_of(Sphere{0.6}, 600 * 9.81, "dry_sand", {0, 0.01}), 0.5 * edge, 1e-9);
  EXPECT_NEAR(edge_of(Sphere{0.6}, 1e6), 0.15, 1e-9) << "a quarter of its radius";
  EXPECT_NEAR(edge_of(Sphere{0.6}, 600 * 9.81, "asphalt"), std::sqrt(8 * 0.6 * 1e-3), 1e-9) << "a millimetre";
}

TEST(RefineEdges, FollowFromTheWidthThatIsPressed) {
  EXPECT_NEAR(edge_of(Cylinder{0.4, 0.3}, 5400, "mud"), 0.075, 1e-9);
  EXPECT_NEAR(edge_of(Box{{2, 1, 0.1}}, 5400), 0.25, 1e-9) << "a plate lies on its largest side";
  EXPECT_NEAR(edge_of(Box{{2, 0.1, 1}}, 5400), 0.025, 1e-9) << "a blade stands on its edge";
  const Compound both{{{Box{{2, 1, 0.1}}}, {Sphere{0.2}, {0, 0, -0.2}}}};
  EXPECT_LT(edge_of(both, 5400), edge_of(Box{{2, 1, 0.1}}, 5400)) << "the finest of its pieces";
}

// ---- worlds

Scene rolling(double spacing, double min_edge) {
  const int columns = static_cast<int>(std::lround(12.8 / spacing)) + 1;
  const int rows = static_cast<int>(std::lround(6.4 / spacing)) + 1;
  Scene scene{.duration = 2};
  scene.terrain = {.shape = GridTerrain{.columns = columns, .rows = rows, .spacing = spacing},
                   .material = "dry_sand",
                   .refine = {.min_edge = min_edge}};
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{.radius = 0.6},
                   .mass = 600,
                   .position = {-4, 0.03, 0},
                   .above_ground = true,
                   .velocity = {3, 0, 0},
                   .angular_velocity = {0, 5, 0}}};
  return scene;
}

double least_angle(const SurfaceView& surface) {
  double least = 180;
  for (std::size_t c = 0; c < surface.triangles.size(); c += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = surface.positions[surface.triangles[c + k]];
      const Vec3 a = surface.positions[surface.triangles[c + (k + 1) % 3]] - p;
      const Vec3 b = surface.positions[surface.triangles[c + (k + 2) % 3]] - p;
      const double cosine = (a.x * b.x + a.y * b.y) / (std::hypot(a.x, a.y) * std::hypot(b.x, b.y));
      least = std::min(least, test::degrees(std::acos(cosine)));
    }
  return least;
}

TEST(Refine, BallRollsAsOnAFineGrid) {
  World fine = test::make_world(rolling(0.05, 0)), refined = test::make_world(rolling(0.8, 0.05));
  EXPECT_NEAR(refined.refinement().edge, 0.1, 1e-6) << "as fine as the ball needs";
  test::run_to(fine, 2), test::run_to(refined, 2);
  const BodyView a = fine.bodies()[0], b = refined.bodies()[0];
  EXPECT_NEAR(b.max_sinkage, a.max_sinkage, 0.05 * a.max_sinkage);
  EXPECT_NEAR(b.position.x + 4, a.position.x + 4, 0.05 * (a.position.x + 4));
  EXPECT_NEAR(b.position.y, a.position.y, 0.05 * (a.position.x + 4));
  EXPECT_LT(refined.surface().positions.size(), fine.surface().positions.size() / 4);
  EXPECT_GE(least_angle(refined.surface()), 15);
  const SoilVolume soil = refined.soil_volume();
  EXPECT_GT(soil.displaced, 0.01);
  EXPECT_LT(soil.relative_error(), 0.01);
  EXPECT_NEAR(soil.displaced, fine.soil_volume().displaced, 0.05 * soil.displaced);
}

// The truck of the scenes drives off, and its rut is a fine grid's.
Scene driving(double spacing, double min_edge, double duration) {
  Scene scene = *load_scene(std::string(test::source_dir()) + "/scenes/truck.toml");
  const auto count = [&](double length) { return static_cast<int>(std::lround(length / spacing)) + 1; };
  scene.duration = duration;
  scene.terrain = {.shape = GridTerrain{.columns = count(22), .rows = count(4), .spacing = spacing},
                   .material = "wheat_field",
                   .refine = {.min_edge = min_edge}};
  return scene;
}

TEST(Refine, TruckDrivesAsOnAFineGrid) {
  World fine = test::make_world(driving(0.025, 0, 3.5)), refined = test::make_world(driving(1, 0.025, 3.5));
  test::run_to(fine, 3.5), test::run_to(refined, 3.5);
  const auto deepest = [](const World& world) {
    double most = 0;
    for (const BodyView& body : world.bodies()) most = std::max(most, body.max_sinkage);
    return most;
  };
  // Depth and width of the left rut, where front and rear wheels have been.
  const auto rut = [](const World& world) {
    double depth = 0, area = 0;
    int sections = 0;
    for (double x = -9.5; x < -8.5; x += 0.05, ++sections) {
      double lowest = 0;
      for (double y = 0.3; y < 1.3; y += 0.01) {
        const double sunk = std::max(0.0, -world.ground_height(x, y));
        lowest = std::max(lowest, sunk), area += 0.01 * sunk;
      }
      depth += lowest;
    }
    return std::array{depth / sections, area / depth};
  };
  const double way = fine.bodies()[0].position.x + 9;
  ASSERT_GT(way, 2);
  EXPECT_NEAR(refined.bodies()[0].position.x + 9, way, 0.05 * way);
  EXPECT_NEAR(refined.bodies()[0].position.y, fine.bodies()[0].position.y, 0.05 * way);
  EXPECT_NEAR(deepest(refined), deepest(fine), 0.05 * deepest(fine));
  EXPECT_NEAR(rut(refined)[0], rut(fine)[0], 0.05 * rut(fine)[0]);
  EXPECT_NEAR(rut(refined)[1], rut(fine)[1], 0.05 * rut(fine)[1]);
  const RefinementCounts counts = refined.refinement();
  EXPECT_LT(counts.base_vertices + counts.most, fine.surface().positions.size() / 10);
}

// Triangles are as fine as the body above them needs.
TEST(Refine, EachBodyHasItsOwnEdge) {
  Scene scene = rolling(0.8, 0.05);
  scene.bodies.push_back({.name = "plate", .shape = Box{{2.4, 2.4, 0.2}}, .mass = 3000, .position = {3, -1.2, 0}});
  scene.bodies.back().above_ground = true;
  World world = test::make_world(scene);
  test::run_to(world, 0.2);
  const SurfaceView surface = world.surface();
  const auto finest = [&](double x, double y) {
    double least = 1e9;
    for (std::size_t c = 0; c < surface.triangles.size(); c += 3) {
      const Vec3 a = surface.positions[surface.triangles[c]], b = surface.positions[surface.triangles[c + 1]];
      if (std::hypot(a.x - x, a.y - y) < 0.6) least = std::min<double>(least, std::hypot(a.x - b.x, a.y - b.y));
    }
    return least;
  };
  EXPECT_NEAR(finest(world.bodies()[0].position.x, 0.03), 0.1, 0.015);
  EXPECT_NEAR(finest(3, -1.2), 0.4, 0.06);
}

TEST(Refine, CraterIsAsOnAFineGrid) {
  const auto scene = [](double spacing, double min_edge) {
    Scene s{.duration = 3};
    const int count = static_cast<int>(std::lround(128 / spacing)) + 1;
    s.terrain = {.shape = GridTerrain{.columns = count, .rows = count, .spacing = spacing},
                 .material = "dry_sand",
                 .refine = {.min_edge = min_edge}};
    s.bombs = {{.time = 0.1, .position = {1, 2, 0}, .yield = 5}};
    return s;
  };
  World fine = test::make_world(scene(0.5, 0)), refined = test::make_world(scene(8, 0.5));
  test::run_to(fine, 3), test::run_to(refined, 3);
  const Crater a = fine.craters()[0], b = refined.craters()[0];
  ASSERT_GT(a.width, 5);
  EXPECT_NEAR(b.width, a.width, 0.05 * a.width);
  EXPECT_NEAR(b.depth, a.depth, 0.05 * a.depth);
  EXPECT_LT(refined.soil_volume().relative_error(), 0.01);
  EXPECT_LT(refined.surface().positions.size(), fine.surface().positions.size() / 10);
}

TEST(Refine, BudgetIsKeptAndSaidToBeUsedUp) {
  Scene scene = rolling(0.8, 0.05);
  scene.terrain.refine.budget = 300;
  World world = test::make_world(scene);
  bool told = false;
  while (world.time() < 0.5) {
    told |= world.step().refinement_limited;
    ASSERT_LE(world.refinement().vertices, 300u);
  }
  EXPECT_TRUE(told);
  EXPECT_GT(world.refinement().short_steps, 0u);
  EXPECT_TRUE(test::all_finite(world));
}

// Coarser ground than it wants still carries a wheel, as the same ground without refinement would.
TEST(Refine, WithoutBudgetWheelsAreCarriedByCoarseTriangles) {
  double before = 0;
  for (const std::uint64_t budget : {0, 200, 1500, 200000}) {
    Scene scene = driving(1, 0.025, 3);
    scene.terrain.refine.budget = budget;
    World world = test::make_world(scene);
    test::run_to(world, 3);
    double deepest = 0;
    for (const BodyView& body : world.bodies()) deepest = std::max(deepest, body.max_sinkage);
    EXPECT_LT(deepest, 0.12) << budget;
    EXPECT_GT(world.bodies()[0].position.z, 0.75) << budget;
    EXPECT_GE(deepest, 0.6 * before) << budget;
    EXPECT_LE(world.refinement().most, budget);
    EXPECT_EQ(world.refinement().short_steps > 0, budget < 200000) << budget;
    before = deepest;
  }
}

// A ball on a road leaves nothing behind it for which triangles would be worth keeping.
TEST(Refine, FlatGroundIsCoarseAgain) {
  Scene scene = rolling(0.8, 0.05);
  scene.terrain.material = "asphalt";
  scene.duration = 4;
  World world = test::make_world(scene);
  test::run_to(world, 1);
  const std::uint64_t halved = world.refinement().halved;
  const SurfaceView before = world.surface();
  test::run_to(world, 4);
  EXPECT_EQ(world.surface().positions.data(), before.positions.data()) << "views stay where they are";
  EXPECT_EQ(world.surface().triangles.data(), before.triangles.data());
  EXPECT_GT(world.refinement().joined, halved / 2);
  EXPECT_LT(world.refinement().vertices, world.refinement().most);
  EXPECT_LT(world.soil_volume().displaced, 1e-3);
}

// Pixels between the nodes of the terrain's grid have the ground's height.
TEST(Refine, RastersShowWhatLiesBetweenTheNodes) {
  World world = test::make_world(rolling(0.8, 0.05));
  test::run_to(world, 1);
  const RasterView coarse = *world.raster(), fine = *world.raster(0.11);
  ASSERT_EQ(fine.columns, (coarse.columns - 1) * 8 + 1);
  ASSERT_EQ(fine.rows, (coarse.rows - 1) * 8 + 1);
  EXPECT_EQ(fine.dx, 0.1);
  EXPECT_EQ(fine.x0, coarse.x0);
  EXPECT_EQ(fine.y0, coarse.y0);
  float deepest = 0;
  for (std::uint32_t row = 0; row < fine.rows; ++row)
    for (std::uint32_t column = 0; column < fine.columns; ++column) {
      const std::size_t pixel = row * fine.columns + column;
      ASSERT_FALSE(fine.holes[pixel]);
      deepest = std::min(deepest, fine.change[pixel]);
      const double ground = world.ground_height(fine.x0 + column * fine.dx, fine.y0 - row * fine.dy);
      // Places on an edge may be told from outside.
      if (!std::isnan(ground)) {
        EXPECT_NEAR(fine.heights[pixel], ground, 1e-4) << column << ' ' << row;
      }
      if (row % 8 == 0 && column % 8 == 0) {
        const std::size_t node = row / 8 * coarse.columns + column / 8;
        EXPECT_EQ(fine.heights[pixel], coarse.heights[node]);
        EXPECT_EQ(fine.change[pixel], coarse.change[node]);
      }
    }
  EXPECT_LT(deepest, -0.05f);  // there is a rut
}

TEST(Refine, SameBitsForAnyNumberOfThreads) {
  World one = test::make_world(rolling(0.8, 0.1), 1), three = test::make_world(rolling(0.8, 0.1), 3);
  test::run_to(one, 1), test::run_to(three, 1);
  EXPECT_GT(one.refinement().vertices, 100u);
  EXPECT_EQ(one.state_hash(), three.state_hash());
}

// What a body could touch is looked up now and then; a vertex that a bomb beside it brings meanwhile is found all the
// same.
TEST(Refine, BodiesMissNoVertexThatCame) {
  Scene scene = rolling(0.8, 0.025);
  scene.bodies[0].velocity = scene.bodies[0].angular_velocity = {};
  scene.bombs = {{.time = 0.5, .position = {-3.4, 0.1, 0}, .yield = 0.001}};
  World adaptive = test::make_world(scene);
  scene.solver.bvh_update = {UpdatePolicy::Kind::every_step, 1};
  World each = test::make_world(scene);
  test::run_to(adaptive, 0.4);
  const std::uint64_t halved = adaptive.refinement().halved;
  test::run_to(adaptive, 1.5), test::run_to(each, 1.5);
  EXPECT_GT(adaptive.refinement().halved, halved + 100);
  EXPECT_EQ(adaptive.state_hash(), each.state_hash());
}

// Whoever applies what take_topology() says to a copy has the triangles.
TEST(Refine, TopologyFollowsTheTriangles) {
  World world = test::make_world(rolling(0.8, 0.1));
  std::vector<std::uint32_t> triangles(world.surface().triangles.begin(), world.surface().triangles.end());
  std::vector<bool> there(world.surface().positions.size(), true);
  while (world.time() < 1.5) {
    world.step();
    const Topology change = world.take_topology();
    const SurfaceView surface = world.surface();
    triangles.resize(surface.triangles.size());
    for (const auto& [first, last] : change.triangles)
      for (std::size_t c = 3 * first; c < std::min<std::size_t>(3 * last, triangles.size()); ++c)
        triangles[c] = surface.triangles[c];
    ASSERT_TRUE(std::equal(triangles.begin(), triangles.end(), surface.triangles.begin()));
    there.resize(surface.positions.size(), false);
    for (const std::uint32_t v : change.added) {
      ASSERT_FALSE(there[v]);
      there[v] = true;
    }
    for (const std::uint32_t v : change.removed) {
      ASSERT_TRUE(there[v]);
      there[v] = false;
    }
    std::vector<bool> used(there.size(), false);
    for (const std::uint32_t v : surface.triangles) used[v] = true;
    ASSERT_EQ(used, there);
  }
  EXPECT_GT(world.refinement().joined, 0u);
  EXPECT_TRUE(world.take_topology().empty());
}

TEST(Refine, SavedWorldsGoOnToTheSameBits) {
  const Scene scene = rolling(0.8, 0.1);
  World whole = test::make_world(scene);
  test::run_to(whole, 0.8);
  ASSERT_GT(whole.refinement().joined, 0u);
  const std::string bytes = whole.save();
  auto resumed = World::restore(bytes, scene, std::make_shared<const Jobs>(2));
  ASSERT_TRUE(resumed.has_value());
  EXPECT_EQ(resumed->refinement().vertices, whole.refinement().vertices);
  EXPECT_EQ(resumed->refinement().edge, whole.refinement().edge);
  test::run_to(whole, 1.6), test::run_to(*resumed, 1.6);
  EXPECT_EQ(resumed->state_hash(), whole.state_hash());
  EXPECT_EQ(resumed->refinement().halved, whole.refinement().halved);

  test::Random random(4);  // nothing that is damaged leads out of an array
  for (int k = 0; k < 60; ++k) {
    std::string damaged = bytes;
    for (int n = 0; n < 4; ++n) damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    if (auto world = World::restore(damaged, scene)) world->step();
  }
}

// A mesh of any triangles, with a hole and without a raster.
TEST(Refine, AnyTrianglesAreRefined) {
  Scene scene = rolling(0.8, 0.05);
  MeshTerrain mesh;
  test::Random random(8);
  constexpr std::uint32_t kColumns = 17, kRows = 9;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c)
      mesh.vertices.push_back({0.8 * c - 6.4 + random.in(-0.2, 0.2), 0.8 * r - 3.2 + random.in(-0.2, 0.2), 0});
  for (std::uint32_t r = 0; r + 1 < kRows; ++r)
    for (std::uint32_t c = 0; c + 1 < kColumns; ++c) {
      if (r == 5 && c == 5) continue;
      const std::uint32_t v = r * kColumns + c, up = v + kColumns;
      for (const std::uint32_t corner : {v, v + 1, up + 1, v, up + 1, up}) mesh.triangles.push_back(corner);
    }
  scene.terrain.shape = mesh;
  World fine = test::make_world(rolling(0.05, 0)), world = test::make_world(scene);
  const double least = least_angle(world.surface());
  test::run_to(world, 2), test::run_to(fine, 2);
  EXPECT_GT(world.refinement().vertices, 1000u);
  EXPECT_GE(least_angle(world.surface()), 0.4 * least) << "half, before the ground is dragged along";
  EXPECT_LT(world.soil_volume().relative_error(), 0.01);
  EXPECT_NEAR(world.bodies()[0].max_sinkage, fine.bodies()[0].max_sinkage, 0.1 * fine.bodies()[0].max_sinkage);
}

TEST(Refine, WithoutItNothingIsTold) {
  World world = test::make_world(rolling(0.8, 0));
  world.step();
  EXPECT_FALSE(world.refinement().on);
  EXPECT_TRUE(world.take_topology().empty());
}

}  // namespace
}  // namespace divot::refine
