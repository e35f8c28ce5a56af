// Columns of soil: what ground a vertex stands for.
#include "state/soil.h"
#include "support.h"

namespace divot::state {
namespace {

TEST(State, CellsOfASquareGridAreSquaresWhateverTheDiagonals) {
  const Surface s = test::make_surface({.columns = 9, .rows = 9, .spacing = 0.25});
  for (std::uint32_t v = 0; v < s.position.size(); ++v)
    if (!s.mesh.is_boundary(v)) {
      EXPECT_FLOAT_EQ(cell_area(s, v), 0.0625f) << v;
    }
}

// Cells and thirds of faces both share the whole out, without gap or overlap, however the vertices lie.
TEST(State, CellsTakeTheWholeGround) {
  Surface s = test::make_surface({.columns = 9, .rows = 9, .spacing = 1});
  test::Random random(7);
  for (std::uint32_t v = 0; v < s.position.size(); ++v)
    if (!s.mesh.is_boundary(v)) s.position[v] += Vec3{random.in(-0.4f, 0.4f), random.in(-0.4f, 0.4f), 0};
  double cells = 0, thirds = 0;
  for (std::uint32_t v = 0; v < s.position.size(); ++v) {
    EXPECT_GT(cell_area(s, v), 0) << v;
    cells += cell_area(s, v), thirds += vertex_area(s, v);
  }
  EXPECT_NEAR(cells, 64, 1e-4);
  EXPECT_NEAR(thirds, 64, 1e-4);
}

TEST(State, ACellIsWhatIsNearestToItsVertex) {
  Surface s = test::make_surface({.columns = 5, .rows = 5, .spacing = 1});
  s.position[12] += Vec3{0.05f, 0.03f, 0};
  test::Random random(3);
  int inside = 0;
  constexpr int kPoints = 20000;
  for (int k = 0; k < kPoints; ++k) {
    const double x = random.in(-1.0, 1.0), y = random.in(-1.0, 1.0);
    std::uint32_t nearest = 0;
    for (std::uint32_t v = 1; v < s.position.size(); ++v) {
      const auto far = [&](std::uint32_t u) { return std::hypot(s.position[u].x - x, s.position[u].y - y); };
      if (far(v) < far(nearest)) nearest = v;
    }
    inside += nearest == 12;
  }
  // Corners a little over 90 degrees share a little otherwise.
  EXPECT_NEAR(cell_area(s, 12), 4.0 * inside / kPoints, 0.03);
}

}  // namespace
}  // namespace divot::state
