// Slopes relax: loose soil to its angle of repose, cohesive soil to the height it stands; what nothing touched stays.
#include <algorithm>

#include "laws/slope.h"
#include "settle/slump.h"
#include "support.h"

namespace divot::settle {
namespace {

using test::degrees;
using test::radians;

/// Ground without particles.
struct Slope {
  Slope(const GridTerrain& grid, const char* material, int threads = 1)
      : surface(test::make_surface(grid)), media{laws::make_medium(*find_preset(material))}, jobs(threads) {}

  /// Moves every vertex inside the border by up to `share` of a spacing, so that no two triangles are alike.
  void jitter(float share) {
    test::Random random(5);
    for (std::uint32_t v = 0; v < surface.position.size(); ++v) {
      const Vec3 shift{random.in(-share, share) * surface.spacing, random.in(-share, share) * surface.spacing, 0};
      if (!surface.mesh.is_boundary(v)) surface.position[v] += shift;
    }
  }
  void pour(std::uint32_t vertex, double volume) {
    bring(ground, state::touch_column(surface, soil, vertex), volume);
    soil.restless.push_back(vertex);
  }
  /// Lets `volume` vanish, as if something had taken it away.
  void dig(std::uint32_t vertex, double volume) { pour(vertex, -volume); }
  /// Seconds until nothing moves any more.
  double rest(double dt = 1.0 / 60, double longest = 60) {
    double time = 0;
    for (; !soil.restless.empty() && time < longest; time += dt) step(dt);
    return time;
  }
  void step(double dt) {
    std::sort(soil.restless.begin(), soil.restless.end());
    slump(ground, {}, media, 9.81, dt, scratch, jobs);
  }
  std::uint32_t nearest(float x, float y) const {
    const auto away = [&](const Vec3& p) { return std::hypot(p.x - x, p.y - y); };
    const auto& all = surface.position;
    return static_cast<std::uint32_t>(
        std::min_element(all.begin(), all.end(), [&](auto& a, auto& b) { return away(a) < away(b); }) - all.begin());
  }
  double steepest_deg() const {
    double most = 0;
    for (std::uint32_t f = 0; f < surface.mesh.face_count(); ++f) {
      Vec3 p[3];
      for (std::uint32_t k = 0; k < 3; ++k) p[k] = surface.position[surface.mesh.origin(3 * f + k)];
      const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
      most = std::max<double>(most, degrees(std::atan2(std::hypot(n.x, n.y), n.z)));
    }
    return most;
  }
  double gained() const {
    double sum = 0;
    for (const double volume : soil.gained) sum += volume;
    return sum;
  }

  state::Surface surface;
  state::Soil soil;
  state::Particles particles;
  Moved moved;
  std::vector<laws::Medium> media;
  Jobs jobs;
  SlumpScratch scratch;
  Ground ground{particles, soil, surface, moved};
};

constexpr double kRepose = 34;  // dry sand

TEST(Slump, APouredHeapStandsAtTheAngleOfRepose) {
  for (const float uneven : {0.0f, 0.3f}) {
    Slope s({.columns = 61, .rows = 61, .spacing = 0.1}, "dry_sand");
    s.jitter(uneven);
    for (int k = 0; k < 60; ++k) s.pour(s.nearest(0, 0), 0.01), s.step(1.0 / 60);
    EXPECT_LT(s.rest(), 10) << "a slide of a metre takes about a second";
    EXPECT_LE(s.steepest_deg(), kRepose + 2) << uneven;
    EXPECT_GE(s.steepest_deg(), kRepose - 1) << uneven;
    EXPECT_NEAR(s.gained(), 0.6, 1e-9);
    // A cone of that volume and slope: h = (3 V tan^2 / pi)^(1/3).
    const double tan = std::tan(radians(kRepose)), height = std::cbrt(3 * 0.6 * tan * tan / std::numbers::pi);
    EXPECT_NEAR(s.surface.position[s.nearest(0, 0)].z, height, 0.1 * height) << uneven;
  }
}

TEST(Slump, TheHeapDependsNeitherOnTheStepNorOnTheSpacing) {
  const auto height = [](double spacing, double dt) {
    Slope s(
        {.columns = static_cast<int>(6 / spacing) + 1, .rows = static_cast<int>(6 / spacing) + 1, .spacing = spacing},
        "dry_sand");
    for (int k = 0; k < 20; ++k) s.pour(s.nearest(0, 0), 0.02), s.step(dt);
    s.rest(dt, 1000 * dt);
    EXPECT_LE(s.steepest_deg(), kRepose + 2) << spacing << ' ' << dt;
    return s.surface.position[s.nearest(0, 0)].z;
  };
  const float reference = height(0.1, 1.0 / 60);
  EXPECT_NEAR(height(0.1, 1.0 / 120), reference, 0.05 * reference);
  EXPECT_NEAR(height(0.1, 0.5), reference, 0.05 * reference) << "stable for any step";
  EXPECT_NEAR(height(0.05, 1.0 / 60), reference, 0.1 * reference);
}

// Beside a track that goes on and on slopes must not creep towards rest for ever.
TEST(Slump, ALongSlopeComesToRestInAFiniteTime) {
  for (const double spacing : {0.1, 0.05}) {
    Slope s({.columns = static_cast<int>(4 / spacing) + 1, .rows = 9, .spacing = spacing}, "dry_sand");
    const auto count = static_cast<std::uint32_t>(s.surface.position.size());
    for (std::uint32_t v = 0; v < count; ++v)
      if (s.surface.position[v].x < -1e-4f) s.dig(v, 0.3 * state::vertex_area(s.surface, v));
    EXPECT_LT(s.rest(1.0 / 500), 1) << spacing;
    EXPECT_LE(s.steepest_deg(), kRepose + 1) << spacing;
  }
}

TEST(Slump, OnlyWhatWasDisturbedSlides) {
  // A slope of 45 degrees, steeper than sand can rest, as a model of real ground may hold.
  Slope s({.columns = 41, .rows = 41, .spacing = 0.1, .height = [](double x, double) { return x; }}, "dry_sand");
  for (std::uint32_t v = 0; v < s.surface.position.size(); ++v) s.soil.restless.push_back(v);
  const std::vector<Vec3> before = s.surface.position;
  s.rest();
  EXPECT_EQ(s.surface.position, before) << "looked at, but not touched";

  s.dig(s.nearest(0, 0), 0.003);
  const float uphill = s.surface.position[s.nearest(0.1f, 0)].z;
  s.rest();
  EXPECT_LT(s.surface.position[s.nearest(0.1f, 0)].z, uphill) << "the rim falls";
  EXPECT_EQ(s.surface.position[s.nearest(1, 0)].z, before[s.nearest(1, 0)].z) << "but not all that lies above";
  EXPECT_EQ(s.surface.position[s.nearest(0, 1)].z, before[s.nearest(0, 1)].z);
  for (const float x : {-1.5f, -1.0f, -0.5f})
    EXPECT_GE(s.surface.position[s.nearest(x, 0)].z, before[s.nearest(x, 0)].z - 0.02f)
        << "soil passes there and takes next to nothing along";

  s.pour(s.nearest(1, 0), 0.001);
  s.rest();
  EXPECT_NEAR(s.gained(), -0.002, 1e-9);
  EXPECT_LT(s.soil.loose[s.surface.column[s.nearest(1, 0)]], 0.02) << "loose soil does not stay on it";
}

// A terrace with a step of `height` over one spacing, dug into level ground.
double left_of_step(const char* material, double spacing, double height) {
  const int n = static_cast<int>(8 / spacing) + 1;
  Slope s({.columns = n, .rows = 5, .spacing = spacing}, material);
  const auto count = static_cast<std::uint32_t>(s.surface.position.size());
  for (std::uint32_t v = 0; v < count; ++v)
    if (s.surface.position[v].x < -1e-4f) s.dig(v, height * state::vertex_area(s.surface, v));
  s.rest(1.0 / 60, 5);
  // What stands over the foot of the step within its own height, less what repose explains.
  const float near = s.surface.position[s.nearest(static_cast<float>(0.25 * height), 0)].z;
  return near + height;
}

TEST(Slump, CohesiveSoilStandsUpToItsCriticalHeight) {
  const laws::Medium mud = laws::make_medium(*find_preset("mud"));
  const double stands = laws::critical_height(mud, 9.81);
  EXPECT_GT(stands, 0.5);
  EXPECT_LT(stands, 2);
  for (const double spacing : {0.2, 0.1}) {
    EXPECT_NEAR(left_of_step("mud", spacing, 0.9 * stands), 0.9 * stands, 1e-5) << spacing;
    EXPECT_LT(left_of_step("mud", spacing, 2.5 * stands), 2.25 * stands) << spacing;
    EXPECT_LT(left_of_step("dry_sand", spacing, 0.9 * stands), 0.85 * stands) << spacing;
  }
  EXPECT_EQ(laws::critical_height(laws::make_medium(*find_preset("dry_sand")), 9.81), 0);
  EXPECT_GT(laws::critical_height(laws::make_medium(*find_preset("asphalt")), 9.81), 100);
}

// News of what lies below go from vertex to vertex: where the ground goes up and down they must not add up on their way
// round, or a rut in mud falls in that is a tenth as deep as mud stands.
TEST(Slump, NoGroundIsFoundToFallFurtherThanItEverDid) {
  Slope s({.columns = 31, .rows = 31, .spacing = 0.1}, "mud");
  test::Random random(3);
  float lowest = 0, highest = 0, most = 0;
  for (int k = 0; k < 400; ++k) {
    // A hole that wanders to and fro, and a heap behind it.
    const float x = std::sin(0.1f * static_cast<float>(k)), y = random.in(-0.1f, 0.1f);
    for (const float beside : {-0.1f, 0.0f, 0.1f}) s.dig(s.nearest(x, y + beside), 0.002);
    for (const float beside : {-0.1f, 0.0f, 0.1f}) s.pour(s.nearest(x - 0.3f, y + beside), 0.002);
    s.step(1.0 / 60);
    for (const Vec3& p : s.surface.position) lowest = std::min(lowest, p.z), highest = std::max(highest, p.z);
    for (const float excess : s.soil.excess) most = std::max(most, excess);
  }
  EXPECT_GT(most, 0.3f * (highest - lowest));
  EXPECT_LE(most, highest - lowest + 0.02f);
}

TEST(Slump, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto heap = [](int threads) {
    Slope s({.columns = 61, .rows = 61, .spacing = 0.1}, "dry_sand", threads);
    s.jitter(0.3f);
    for (int k = 0; k < 30; ++k) s.pour(s.nearest(0, 0), 0.02), s.step(1.0 / 60);
    s.rest();
    return s.surface.position;
  };
  const std::vector<Vec3> one = heap(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(heap(threads), one) << threads;
}

TEST(Slump, CostsNothingAtRestAndNothingWithoutGravity) {
  Slope s({.columns = 21, .rows = 21, .spacing = 0.1}, "dry_sand");
  s.pour(s.nearest(0, 0), 0.05);
  slump(s.ground, {}, s.media, 0, 1, s.scratch, s.jobs);
  EXPECT_TRUE(s.soil.restless.empty());
  EXPECT_GT(s.steepest_deg(), 60);
  s.soil.restless = {s.nearest(0, 0)};
  s.rest();
  EXPECT_TRUE(s.soil.restless.empty());
}

// A crater in dry sand, by a bomb, as it lies at rest.
TEST(Slump, CratersInSandEndAtTheAngleOfRepose) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 61, .rows = 61, .spacing = 0.3}, .material = "dry_sand"};
  scene.bombs = {{.time = 0, .position = {0.03, 0, 0}, .yield = 1}};
  World world = test::make_world(scene);
  test::run_to(world, 6);
  const SurfaceView view = world.surface();
  double most = 0;
  for (std::size_t f = 0; f < view.triangles.size(); f += 3) {
    const Vec3 a = view.positions[view.triangles[f]], b = view.positions[view.triangles[f + 1]],
               c = view.positions[view.triangles[f + 2]], n = cross(b - a, c - a);
    most = std::max<double>(most, degrees(std::atan2(std::hypot(n.x, n.y), n.z)));
  }
  EXPECT_LE(most, kRepose + 2);
  EXPECT_GT(most, 20) << "there is a crater";
}

// Heights c / (stability number x density g) at which cohesive slopes fail, as shares of that of a vertical one: ours
// are on the safe side of slip circles, by a third at most.
TEST(Slump, CohesiveSlopesStandAsSlipCirclesSay) {
  struct Row {
    double friction_deg, vertical, at_75, at_60, at_45, at_30;  // stability numbers [Taylor 1937]
  };
  for (const Row& row : {Row{5, 0.239, 0.195, 0.162, 0.136, 0.110},
                         {10, 0.218, 0.173, 0.138, 0.108, 0.075},
                         {15, 0.199, 0.152, 0.116, 0.083, 0.046},
                         {20, 0.182, 0.134, 0.097, 0.062, 0.025}}) {
    const double rest = std::tan(radians(row.friction_deg));
    const auto check = [&](double slope_deg, double number) {
      const double slope = std::tan(radians(slope_deg)), excess_of_a_metre = 1 - rest / slope;
      const double stands = 1 / laws::counted_height(excess_of_a_metre, slope, rest), circle = row.vertical / number;
      EXPECT_LE(stands, 1.01 * circle) << row.friction_deg << ' ' << slope_deg;
      EXPECT_GE(stands, 0.6 * circle) << row.friction_deg << ' ' << slope_deg;
    };
    check(75, row.at_75), check(60, row.at_60), check(45, row.at_45), check(30, row.at_30);
  }
}

}  // namespace
}  // namespace divot::settle
