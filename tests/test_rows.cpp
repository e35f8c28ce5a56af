#include <gtest/gtest.h>

#include <random>

#include "geometry/column_grid.h"
#include "geometry/kd_tree.h"
#include "geometry/rows.h"

namespace {

using divot::Jobs;
using divot::geometry::ColumnGrid;
using divot::geometry::KdTree;
using divot::geometry::Rows;

struct Cloud {
  std::vector<float> x, y, z;

  void add(float px, float py, float pz) { x.push_back(px), y.push_back(py), z.push_back(pz); }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }

 private:
  std::mt19937 engine_;
};

Cloud random_cloud(int count, float width, float height, unsigned seed) {
  Random random(seed);
  Cloud c;
  for (int i = 0; i < count; ++i) c.add(random.in(0, width), random.in(0, width), random.in(0, height));
  return c;
}

Rows brute_force_rows(const Cloud& c, float radius) {
  Rows rows;
  rows.start.push_back(0);
  for (std::uint32_t i = 0; i < c.x.size(); ++i) {
    for (std::uint32_t j = 0; j < c.x.size(); ++j) {
      const float dx = c.x[j] - c.x[i], dy = c.y[j] - c.y[i], dz = c.z[j] - c.z[i];
      if (j != i && (dx * dx + dy * dy) + dz * dz <= radius * radius) rows.index.push_back(j);
    }
    rows.start.push_back(static_cast<std::uint32_t>(rows.index.size()));
  }
  return rows;
}

// Both structures, on 1 and 3 threads and with used memory, give the rows of brute force to the last index.
void expect_rows(const Cloud& c, float radius, const char* what) {
  static ColumnGrid used_grid;
  static KdTree used_tree;
  static Rows used_rows;
  const Rows expected = brute_force_rows(c, radius);
  for (const int threads : {1, 3}) {
    const Jobs jobs(threads);
    used_grid.build(c.x, c.y, c.z);
    used_grid.rows(radius, used_rows, jobs);
    EXPECT_EQ(used_rows.start, expected.start) << "grid, " << what << ", radius " << radius;
    EXPECT_EQ(used_rows.index, expected.index) << "grid, " << what << ", radius " << radius;
    used_tree.build(c.x, c.y, c.z);
    used_tree.rows(radius, used_rows, jobs);
    EXPECT_EQ(used_rows.start, expected.start) << "tree, " << what << ", radius " << radius;
    EXPECT_EQ(used_rows.index, expected.index) << "tree, " << what << ", radius " << radius;
  }
}

TEST(Rows, NoneOneAndTwoParticles) {
  Cloud c;
  expect_rows(c, 1, "none");
  ColumnGrid grid;
  KdTree tree;
  Rows rows;
  grid.rows(1, rows, Jobs(1));  // before any build
  EXPECT_EQ(rows.count(), 0u);
  tree.rows(1, rows, Jobs(1));
  EXPECT_EQ(rows.count(), 0u);
  c.add(3, -4, 5);
  expect_rows(c, 1, "one");
  c.add(3, -4, 6);
  expect_rows(c, 1, "two at the radius");
  expect_rows(c, 0.999f, "two beyond the radius");
  EXPECT_EQ(brute_force_rows(c, 1).index, (std::vector<std::uint32_t>{1, 0}));
}

TEST(Rows, RandomClouds) {
  for (const float radius : {0.0f, 0.05f, 0.3f, 1.0f, 20.0f})
    for (unsigned seed = 0; seed < 3; ++seed) {
      expect_rows(random_cloud(1500, 10, 0.5f, seed), radius, "sheet");
      expect_rows(random_cloud(1500, 5, 5, seed), radius, "cube");
    }
}

// More rows than one chunk, so that chunks and threads meet.
TEST(Rows, ManyChunks) { expect_rows(random_cloud(9000, 60, 1, 4), 1.3f, "many"); }

TEST(Rows, RegularGridsHaveTiesAtTheRadius) {
  for (const float spacing : {1.0f, 0.1f, 10.9f})
    for (const float origin : {0.0f, -73.3f, 4096.7f}) {
      Cloud c;
      for (int r = 0; r < 30; ++r)
        for (int k = 0; k < 30; ++k)
          c.add(origin + spacing * static_cast<float>(k), origin + spacing * static_cast<float>(r), 0.25f);
      for (const float factor : {1.0f, 2.0f, 3.0f, 5.0f, 1.41421356f}) expect_rows(c, factor * spacing, "ties");
    }
}

// Far from the origin a float holds few digits, and distances are multiples of its last one.
TEST(Rows, CoarseCoordinates) {
  Random random(11);
  Cloud c;
  for (int i = 0; i < 1500; ++i) c.add(1e6f + random.in(0, 8), -3e6f + random.in(0, 8), random.in(0, 1));
  for (const float radius : {0.0625f, 0.25f, 0.75f, 1.0f}) expect_rows(c, radius, "coarse");
}

TEST(Rows, ClusteredAndCoincident) {
  Random random(12);
  Cloud c;
  for (int cluster = 0; cluster < 12; ++cluster) {
    const float x = random.in(-200, 200), y = random.in(-200, 200);
    for (int i = 0; i < 90; ++i) c.add(x + random.in(-1, 1), y + random.in(-1, 1), random.in(-1, 1));
    for (int i = 0; i < 5; ++i) c.add(x, y, 0);
  }
  for (const float radius : {0.0f, 0.2f, 3.0f}) expect_rows(c, radius, "clustered");

  Cloud same;
  for (int i = 0; i < 300; ++i) same.add(7, 8, 9);
  for (const float radius : {0.0f, 1.0f}) expect_rows(same, radius, "coincident");
}

TEST(Rows, FarAwayOutliers) {
  for (const float far : {1e5f, 1e9f, 1e15f}) {
    Cloud c = random_cloud(800, 10, 0.5f, 13);
    c.add(far, 0, 0), c.add(-far, far, 0), c.add(0, -far, far);
    for (int i = 0; i < 300; ++i) c.add(far, c.y[static_cast<std::size_t>(i)], 0);
    expect_rows(c, 0.5f, "outliers");
  }
}

}  // namespace
