#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/bisection.h"

namespace {

using divot::kNone;
using divot::geometry::Bisection;
using divot::geometry::HalfEdgeMesh;

struct Place {
  double x = 0, y = 0;
};

// A surface seen from above that is halved and made whole again.
struct Sheet {
  HalfEdgeMesh mesh;
  Bisection bisection;
  std::vector<Place> place;

  Sheet(std::vector<Place> places, std::vector<std::uint32_t> triangles) : place(std::move(places)) {
    auto built = HalfEdgeMesh::build(static_cast<std::uint32_t>(place.size()), std::move(triangles));
    EXPECT_TRUE(built.has_value());
    mesh = *built;
    bisection.start(mesh);
  }
  double squared(std::uint32_t h) const {
    const Place a = place[mesh.origin(h)], b = place[mesh.target(h)];
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
  }
  // Halves a face, and before it what it needs.
  void halve(std::uint32_t face) {
    for (bool done = false; !done;) {
      const auto length = [&](std::uint32_t h) { return squared(h); };
      const std::uint32_t h = longest_ahead(mesh, face, length);
      const std::uint32_t g = mesh.twin(h);
      done = h / 3 == face || (g != kNone && g / 3 == face);
      const Place a = place[mesh.origin(h)], b = place[mesh.target(h)];
      const std::uint32_t vertex = bisection.split(mesh, h);
      if (vertex == place.size()) place.emplace_back();
      place[vertex] = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    }
  }
  double area(std::uint32_t face) const {
    const Place a = place[mesh.origin(3 * face)], b = place[mesh.origin(3 * face + 1)],
                c = place[mesh.origin(3 * face + 2)];
    return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  double least_angle(std::uint32_t face) const {
    double least = 180;
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
      const double a = squared(HalfEdgeMesh::next(h)), b = squared(h), c = squared(HalfEdgeMesh::prev(h));
      least = std::min(least, std::acos((b + c - a) / (2 * std::sqrt(b * c))) * 180 / std::numbers::pi);
    }
    return least;
  }
  // Each face lies in one face of the base, and those of a base face fill it: there is no crack and no overlap.
  void expect_parts_fill_the_base(const std::vector<double>& base_area) const {
    std::vector<bool> seen(mesh.face_count(), false);
    for (std::uint32_t base = 0; base < bisection.base_face_count(); ++base) {
      double sum = 0;
      bisection.for_each_part(
          base, [](const auto&) { return true; },
          [&](std::uint32_t face) {
            ASSERT_LT(face, seen.size());
            ASSERT_FALSE(seen[face]);
            seen[face] = true;
            ASSERT_EQ(bisection.base_of(face), base);
            ASSERT_GT(area(face), 0);
            sum += area(face);
          });
      ASSERT_NEAR(sum, base_area[base], 1e-9 * base_area[base]);
    }
    ASSERT_EQ(std::count(seen.begin(), seen.end(), false), 0);
  }
};

Sheet grid_sheet(std::uint32_t columns, std::uint32_t rows, double dx, double dy) {
  std::vector<Place> places;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) places.push_back({c * dx, r * dy});
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t v = r * columns + c, up = v + columns;
      triangles.insert(triangles.end(), {v, v + 1, up + 1, v, up + 1, up});
    }
  return {places, triangles};
}

std::vector<double> areas(const Sheet& sheet) {
  std::vector<double> all;
  for (std::uint32_t face = 0; face < sheet.mesh.face_count(); ++face) all.push_back(sheet.area(face));
  return all;
}

double least_angle(const Sheet& sheet) {
  double least = 180;
  for (std::uint32_t face = 0; face < sheet.mesh.face_count(); ++face) least = std::min(least, sheet.least_angle(face));
  return least;
}

// 10^5 halvings and their undoing at random: the mesh keeps its promises, the trees find every face.
void edit_at_random(Sheet& sheet, double angle) {
  const std::vector<double> base = areas(sheet);
  const std::vector<std::uint32_t> before(sheet.mesh.triangles().begin(), sheet.mesh.triangles().end());
  std::mt19937 random(5);
  int splits = 0, merges = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const bool grow = sheet.mesh.face_count() < 400 || (i / 4000 % 2 == 0 && sheet.mesh.face_count() < 3000);
    if (grow) {
      sheet.halve(below(sheet.mesh.face_count())), ++splits;
    } else if (const std::uint32_t vertex = below(sheet.mesh.vertex_count());
               sheet.bisection.can_merge(sheet.mesh, vertex)) {
      sheet.bisection.merge(sheet.mesh, vertex), ++merges;
    }
    if (i % 500 != 0) continue;
    ASSERT_EQ(sheet.mesh.validate(), "") << "edit " << i;
    sheet.expect_parts_fill_the_base(base);
    ASSERT_GE(least_angle(sheet), angle) << "edit " << i;
  }
  EXPECT_GT(splits, 2000);
  EXPECT_GT(merges, 2000);

  // All of it undone, the triangles are what they were, to the place of each.
  for (bool any = true; any;) {
    any = false;
    for (std::uint32_t vertex = 0; vertex < sheet.mesh.vertex_count(); ++vertex)
      if (sheet.bisection.can_merge(sheet.mesh, vertex)) sheet.bisection.merge(sheet.mesh, vertex), any = true;
  }
  EXPECT_FALSE(sheet.bisection.any());
  EXPECT_EQ(sheet.mesh.validate(), "");
  const auto after = sheet.mesh.triangles();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t face = 0; face < before.size() / 3; ++face) {
    std::vector<std::uint32_t> was(before.begin() + 3 * face, before.begin() + 3 * face + 3);
    std::vector<std::uint32_t> is(after.begin() + 3 * face, after.begin() + 3 * face + 3);
    std::rotate(was.begin(), std::min_element(was.begin(), was.end()), was.end());
    std::rotate(is.begin(), std::min_element(is.begin(), is.end()), is.end());
    ASSERT_EQ(was, is);
  }
}

TEST(Bisection, RightTrianglesWithEqualLegsKeepTheirAngles) {
  Sheet sheet = grid_sheet(9, 8, 1, 1);
  edit_at_random(sheet, 45 - 1e-4);
}

TEST(Bisection, LongCellsKeepHalfOfTheirLeastAngle) {
  Sheet sheet = grid_sheet(9, 8, 1.3, 1);
  edit_at_random(sheet, 15);
}

TEST(Bisection, AnyTrianglesKeepHalfOfTheirLeastAngle) {
  Sheet sheet = grid_sheet(8, 8, 1, 1);
  std::mt19937 random(3);
  for (Place& p : sheet.place) {
    p.x += 0.3 * (static_cast<double>(random()) / std::mt19937::max() - 0.5);
    p.y += 0.3 * (static_cast<double>(random()) / std::mt19937::max() - 0.5);
  }
  const double least = least_angle(sheet);
  edit_at_random(sheet, 0.5 * least);
}

TEST(Bisection, HalvesTwoFacesAtAnEdgeAndOneAtTheBorder) {
  Sheet sheet = grid_sheet(2, 2, 1, 1);
  sheet.halve(0);
  EXPECT_EQ(sheet.mesh.face_count(), 4u);
  EXPECT_EQ(sheet.bisection.added_count(), 1u);
  EXPECT_EQ(sheet.bisection.generation(4), 1u);
  sheet.halve(0);
  EXPECT_EQ(sheet.mesh.face_count(), 5u);
  EXPECT_EQ(sheet.bisection.generation(5), 2u);
  EXPECT_FALSE(sheet.bisection.can_merge(sheet.mesh, 4));
  EXPECT_FALSE(sheet.bisection.can_merge(sheet.mesh, 0));
  ASSERT_TRUE(sheet.bisection.can_merge(sheet.mesh, 5));
  sheet.bisection.merge(sheet.mesh, 5);
  EXPECT_TRUE(sheet.bisection.can_merge(sheet.mesh, 4));

  // What went is used again.
  sheet.halve(1);
  EXPECT_EQ(sheet.mesh.vertex_count(), 6u);
}

// What a part's corners rule out is not walked.
TEST(Bisection, PartsAreFoundByTheirCorners) {
  Sheet sheet = grid_sheet(2, 2, 1, 1);
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t count = sheet.mesh.face_count();
    sheet.halve(static_cast<std::uint32_t>(i * 7) % count);
  }
  const auto left = [&](const auto& corner) {
    return std::ranges::any_of(corner, [&](std::uint32_t v) { return sheet.place[v].x < 0.1; });
  };
  for (std::uint32_t base = 0; base < 2; ++base) {
    std::vector<std::uint32_t> found;
    int asked = 0;
    sheet.bisection.for_each_part(
        base, [&](const auto& corner) { return ++asked, left(corner); },
        [&](std::uint32_t face) { found.push_back(face); });
    for (std::uint32_t face = 0; face < sheet.mesh.face_count(); ++face) {
      const std::array corner{sheet.mesh.origin(3 * face), sheet.mesh.origin(3 * face + 1),
                              sheet.mesh.origin(3 * face + 2)};
      if (sheet.bisection.base_of(face) != base || !left(corner)) continue;
      EXPECT_EQ(std::count(found.begin(), found.end(), face), 1);
    }
    EXPECT_LT(asked, 120);
    EXPECT_LT(found.size(), 200u);
  }
}

}  // namespace
