#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "geometry/bvh.h"

namespace {

using divot::Jobs;
using divot::Vec3;
using divot::geometry::Bvh;
using divot::geometry::corners_in;
using divot::math::Aabb;
using Indices = std::vector<std::uint32_t>;

constexpr float kMargin = 0.05f;

struct Surface {
  Indices triangles;
  std::vector<Vec3> positions;
};

// A hilly grid of columns x rows vertices 1 m apart.
Surface hills(std::uint32_t columns, std::uint32_t rows) {
  Surface s;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const float x = static_cast<float>(c), y = static_cast<float>(r);
      s.positions.push_back({x, y, 3 * std::sin(0.2f * x) * std::cos(0.15f * y)});
      if (r + 1 == rows || c + 1 == columns) continue;
      const std::uint32_t v = r * columns + c, up = v + columns;
      s.triangles.insert(s.triangles.end(), {v, v + 1, up + 1, v, up + 1, up});
    }
  return s;
}

// Both ways to make leaves.
class BvhOf : public testing::TestWithParam<Bvh::Order> {
 protected:
  static void build(Bvh& bvh, const Surface& s, const Jobs& jobs) {
    bvh.build(static_cast<std::uint32_t>(s.triangles.size() / 3), corners_in(s.triangles), s.positions, kMargin,
              GetParam(), jobs);
  }
};
INSTANTIATE_TEST_SUITE_P(Orders, BvhOf, testing::Values(Bvh::Order::as_numbered, Bvh::Order::by_place),
                         [](const auto& order) { return order.param == Bvh::Order::by_place ? "place" : "number"; });

Aabb face_box(const Surface& s, std::size_t face) {
  Aabb box;
  for (std::size_t k = 0; k < 3; ++k) box.include(s.positions[s.triangles[3 * face + k]]);
  return box;
}

// Faces whose own box overlaps: none of them may be missed.
template <class Hit>
Indices brute_force(const Surface& s, const Hit& hit) {
  Indices faces;
  for (std::uint32_t face = 0; face < s.triangles.size() / 3; ++face)
    if (hit(face_box(s, face))) faces.push_back(face);
  return faces;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }

 private:
  std::mt19937 engine_;
};

// Random boxes and balls, against every face one by one: nothing missed, and little besides.
void expect_conservative(const Bvh& bvh, const Surface& s, Random& random, int queries) {
  std::size_t found = 0, needed = 0;
  for (int i = 0; i < queries; ++i) {
    const Vec3 p{random.in(-5, 45), random.in(-5, 45), random.in(-5, 5)};
    const float radius = random.in(0, 4);
    Aabb box;
    box.include(p), box.grow(radius);
    Indices faces{4000000000u, 7};  // what is there already stays in front
    bvh.query(box, faces);
    ASSERT_EQ(faces[0], 4000000000u);
    ASSERT_TRUE(std::is_sorted(faces.begin() + 2, faces.end()));
    const Indices in_box = brute_force(s, [&](const Aabb& b) { return b.overlaps(box); });
    ASSERT_TRUE(std::includes(faces.begin() + 2, faces.end(), in_box.begin(), in_box.end()));
    found += faces.size() - 2, needed += in_box.size();

    faces.clear();
    bvh.query_sphere(p, radius, faces);
    ASSERT_TRUE(std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()) == faces.end());
    const Indices in_ball = brute_force(s, [&](const Aabb& b) { return b.distance_squared(p) <= radius * radius; });
    ASSERT_TRUE(std::includes(faces.begin(), faces.end(), in_ball.begin(), in_ball.end()));
  }
  EXPECT_LT(found, 6 * needed);
}

// Moves vertices one by one and tells the tree of every face round them.
void move_and_touch(Surface& s, Bvh& bvh, Random& random, int moves, float reach) {
  const std::size_t columns = 40;
  for (int i = 0; i < moves; ++i) {
    const std::uint32_t v = random.below(s.positions.size());
    s.positions[v] += Vec3{random.in(-reach, reach), random.in(-reach, reach), random.in(-reach, reach)};
    const std::size_t first_face = 2 * (v / columns > 0 ? (v / columns - 1) * (columns - 1) : 0);
    const std::size_t last_face = std::min(s.triangles.size() / 3, 2 * (v / columns + 1) * (columns - 1));
    for (std::size_t f = first_face; f < last_face; ++f)
      if (std::count(&s.triangles[3 * f], &s.triangles[3 * f] + 3, v) > 0)
        bvh.touch(static_cast<std::uint32_t>(f), s.positions[v]);
  }
}

TEST(Bvh, EmptyFindsNothing) {
  Bvh bvh;
  Indices faces;
  const Jobs jobs(1);
  bvh.query_sphere({}, 10, faces);
  bvh.build(0, corners_in({}), {}, kMargin, Bvh::Order::by_place, jobs);
  bvh.query_sphere({}, 10, faces);
  EXPECT_TRUE(faces.empty());
  EXPECT_EQ(bvh.refit(corners_in({}), {}), 0u);
  EXPECT_TRUE(bvh.boxes(0).empty());
  EXPECT_EQ(bvh.degradation(), 1.0f);
}

TEST_P(BvhOf, FewFacesOfAnyNumber) {
  const Jobs jobs(1);
  const Surface all = hills(5, 5);
  for (std::size_t count = 1; count <= all.triangles.size() / 3; ++count) {
    Surface s = all;
    s.triangles.resize(3 * count);
    Bvh bvh;
    build(bvh, s, jobs);
    Indices faces;
    bvh.query_sphere({2, 2, 0}, 100, faces);
    EXPECT_EQ(faces.size(), count);
    Random random(3);
    for (int i = 0; i < 20; ++i) {
      Aabb box;
      box.include(Vec3{random.in(0, 4), random.in(0, 4), random.in(-1, 1)});
      faces.clear();
      bvh.query(box, faces);
      const Indices expected = brute_force(s, [&](const Aabb& b) { return b.overlaps(box); });
      EXPECT_TRUE(std::includes(faces.begin(), faces.end(), expected.begin(), expected.end()));
    }
  }
}

TEST_P(BvhOf, FindsWhatBruteForceFinds) {
  const Jobs jobs(1);
  const Surface s = hills(40, 40);
  Bvh bvh;
  build(bvh, s, jobs);
  EXPECT_EQ(bvh.face_count(), s.triangles.size() / 3);
  Random random(5);
  expect_conservative(bvh, s, random, 500);
}

TEST_P(BvhOf, SameTreeForAnyNumberOfThreads) {
  const Surface s = hills(200, 150);
  const Jobs one(1), three(3);
  Bvh a, b;
  build(a, s, one);
  build(b, s, three);
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{random.in(0, 200), random.in(0, 150), random.in(-3, 3)};
    Indices from_a, from_b;
    a.query_sphere(p, 1, from_a);
    b.query_sphere(p, 1, from_b);
    ASSERT_EQ(from_a, from_b);
  }
}

TEST_P(BvhOf, TouchIsTrueOnlyOutsideTheMargin) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  build(bvh, s, jobs);
  const std::uint32_t face = 100, v = s.triangles[3 * face];
  EXPECT_FALSE(bvh.touch(face, s.positions[v]));
  s.positions[v].z += 0.9f * kMargin;
  EXPECT_FALSE(bvh.touch(face, s.positions[v]));
  EXPECT_EQ(bvh.refit(corners_in(s.triangles), s.positions), 0u);
  s.positions[v].z += 50;
  EXPECT_TRUE(bvh.touch(face, s.positions[v]));
  EXPECT_TRUE(bvh.touch(face, s.positions[v]));  // still outside, marked once
  // The spike grows the boxes of its leaf and of two nodes above: 381 leaves lie in 48 and these in 6.
  const std::size_t changed = bvh.refit(corners_in(s.triangles), s.positions);
  EXPECT_EQ(changed, 3u);
  EXPECT_FALSE(bvh.touch(face, s.positions[v]));
  EXPECT_EQ(bvh.refit(corners_in(s.triangles), s.positions), 0u);
}

TEST_P(BvhOf, PartialRefitsStayConservative) {
  const Jobs jobs(1);
  for (const int moves : {3, 300}) {
    Surface s = hills(40, 40);
    Bvh bvh, fresh;
    build(bvh, s, jobs);
    Random random(8);
    std::size_t changed = 0;
    for (int round = 0; round < 20; ++round) {
      move_and_touch(s, bvh, random, moves, 0.3f);
      changed += bvh.refit(corners_in(s.triangles), s.positions);
      build(fresh, s, jobs);
      expect_conservative(bvh, s, random, 20);
      expect_conservative(fresh, s, random, 20);
    }
    EXPECT_GT(changed, 20u);
  }
}

TEST_P(BvhOf, RefitAllTightensEveryBox) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  build(bvh, s, jobs);
  for (Vec3& p : s.positions) p += Vec3{0, 0, 100};
  bvh.refit_all(corners_in(s.triangles), s.positions, jobs);
  Indices faces;
  Aabb old_place;
  old_place.include(Vec3{0, 0, -10}), old_place.include(Vec3{40, 40, 10});
  bvh.query(old_place, faces);
  EXPECT_TRUE(faces.empty());
  EXPECT_NEAR(bvh.degradation(), 1.0f, 1e-4f);
}

TEST_P(BvhOf, DegradationGrowsWithDisorderAndIsResetByBuild) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  build(bvh, s, jobs);
  EXPECT_EQ(bvh.degradation(), 1.0f);
  Random random(9);
  move_and_touch(s, bvh, random, 400, 5.0f);
  bvh.refit(corners_in(s.triangles), s.positions);
  const float some = bvh.degradation();
  EXPECT_GT(some, 1.1f);
  move_and_touch(s, bvh, random, 2000, 10.0f);
  bvh.refit(corners_in(s.triangles), s.positions);
  EXPECT_GT(bvh.degradation(), some);

  // Kept up step by step, it is what a sum over all nodes gives.
  const float kept_up = bvh.degradation();
  for (std::uint32_t f = 0; f < bvh.face_count(); ++f)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_FALSE(bvh.touch(f, s.positions[s.triangles[3 * f + k]]));
  Bvh untouched;
  const Surface before = hills(40, 40);
  build(untouched, before, jobs);
  untouched.refit_all(corners_in(s.triangles), s.positions, jobs);
  EXPECT_NEAR(kept_up / untouched.degradation(), 1.0f, 0.02f);  // boxes that only loosened stay a margin larger

  build(bvh, s, jobs);
  EXPECT_EQ(bvh.degradation(), 1.0f);
}

}  // namespace
