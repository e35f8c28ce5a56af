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
  EXPECT_LT(found, 4 * needed);
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
        bvh.touch(static_cast<std::uint32_t>(f), s.positions);
  }
}

TEST(Bvh, EmptyFindsNothing) {
  Bvh bvh;
  Indices faces;
  const Jobs jobs(1);
  bvh.query_sphere({}, 10, faces);
  bvh.build({}, {}, kMargin, jobs);
  bvh.query_sphere({}, 10, faces);
  EXPECT_TRUE(faces.empty());
  EXPECT_EQ(bvh.refit({}), 0u);
  EXPECT_EQ(bvh.degradation(), 1.0f);
}

TEST(Bvh, FewFacesOfAnyNumber) {
  const Jobs jobs(1);
  const Surface all = hills(5, 5);
  for (std::size_t count = 1; count <= all.triangles.size() / 3; ++count) {
    Surface s = all;
    s.triangles.resize(3 * count);
    Bvh bvh;
    bvh.build(s.triangles, s.positions, kMargin, jobs);
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

TEST(Bvh, FindsWhatBruteForceFinds) {
  const Jobs jobs(1);
  const Surface s = hills(40, 40);
  Bvh bvh;
  bvh.build(s.triangles, s.positions, kMargin, jobs);
  EXPECT_EQ(bvh.face_count(), s.triangles.size() / 3);
  Random random(5);
  expect_conservative(bvh, s, random, 500);
}

TEST(Bvh, SameTreeForAnyNumberOfThreads) {
  const Surface s = hills(200, 150);
  const Jobs one(1), three(3);
  Bvh a, b;
  a.build(s.triangles, s.positions, kMargin, one);
  b.build(s.triangles, s.positions, kMargin, three);
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{random.in(0, 200), random.in(0, 150), random.in(-3, 3)};
    Indices from_a, from_b;
    a.query_sphere(p, 1, from_a);
    b.query_sphere(p, 1, from_b);
    ASSERT_EQ(from_a, from_b);
  }
}

TEST(Bvh, TouchIsTrueOnlyOutsideTheMargin) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  bvh.build(s.triangles, s.positions, kMargin, jobs);
  const std::uint32_t face = 100, v = s.triangles[3 * face];
  EXPECT_FALSE(bvh.touch(face, s.positions));
  s.positions[v].z += 0.9f * kMargin;
  EXPECT_FALSE(bvh.touch(face, s.positions));
  EXPECT_EQ(bvh.refit(s.positions), 0u);
  s.positions[v].z += 50;
  EXPECT_TRUE(bvh.touch(face, s.positions));
  EXPECT_TRUE(bvh.touch(face, s.positions));  // still outside, marked once
  // The spike grows every box from the leaf to the root, 8 or 9 of them above 381 leaves.
  const std::size_t changed = bvh.refit(s.positions);
  EXPECT_GE(changed, 10u);
  EXPECT_LE(changed, 11u);
  EXPECT_FALSE(bvh.touch(face, s.positions));
  EXPECT_EQ(bvh.refit(s.positions), 0u);
}

// Few dirty leaves go through the heap, many through the scan; both must lose nothing.
TEST(Bvh, PartialRefitsStayConservative) {
  const Jobs jobs(1);
  for (const int moves : {3, 300}) {
    Surface s = hills(40, 40);
    Bvh bvh, fresh;
    bvh.build(s.triangles, s.positions, kMargin, jobs);
    Random random(8);
    std::size_t changed = 0;
    for (int round = 0; round < 20; ++round) {
      move_and_touch(s, bvh, random, moves, 0.3f);
      changed += bvh.refit(s.positions);
      fresh.build(s.triangles, s.positions, kMargin, jobs);
      expect_conservative(bvh, s, random, 20);
      expect_conservative(fresh, s, random, 20);
    }
    EXPECT_GT(changed, 20u);
  }
}

TEST(Bvh, RefitAllTightensEveryBox) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  bvh.build(s.triangles, s.positions, kMargin, jobs);
  for (Vec3& p : s.positions) p += Vec3{0, 0, 100};
  bvh.refit_all(s.positions);
  Indices faces;
  Aabb old_place;
  old_place.include(Vec3{0, 0, -10}), old_place.include(Vec3{40, 40, 10});
  bvh.query(old_place, faces);
  EXPECT_TRUE(faces.empty());
  EXPECT_NEAR(bvh.degradation(), 1.0f, 1e-4f);
}

TEST(Bvh, DegradationGrowsWithDisorderAndIsResetByBuild) {
  const Jobs jobs(1);
  Surface s = hills(40, 40);
  Bvh bvh;
  bvh.build(s.triangles, s.positions, kMargin, jobs);
  EXPECT_EQ(bvh.degradation(), 1.0f);
  Random random(9);
  move_and_touch(s, bvh, random, 400, 5.0f);
  bvh.refit(s.positions);
  const float some = bvh.degradation();
  EXPECT_GT(some, 1.1f);
  move_and_touch(s, bvh, random, 2000, 10.0f);
  bvh.refit(s.positions);
  EXPECT_GT(bvh.degradation(), some);

  // Kept up step by step, it is what a sum over all nodes gives.
  const float kept_up = bvh.degradation();
  for (std::uint32_t f = 0; f < bvh.face_count(); ++f) EXPECT_FALSE(bvh.touch(f, s.positions));
  Bvh untouched;
  const Surface before = hills(40, 40);
  untouched.build(before.triangles, before.positions, kMargin, jobs);
  untouched.refit_all(s.positions);
  EXPECT_NEAR(kept_up / untouched.degradation(), 1.0f, 0.02f);  // boxes that only loosened stay a margin larger

  bvh.build(s.triangles, s.positions, kMargin, jobs);
  EXPECT_EQ(bvh.degradation(), 1.0f);
}

}  // namespace
