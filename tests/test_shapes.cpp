// Shapes: undersides, outlines and masses against brute force, and against each other.
#include <algorithm>

#include "geometry/posed_solid.h"
#include "support.h"

namespace divot::geometry {
namespace {

Quat random_turn(test::Random& random) {
  return rotation({random.in(-180.0, 180.0), random.in(-180.0, 180.0), random.in(-180.0, 180.0)});
}

Hull random_hull(test::Random& random) {
  Hull hull;
  for (int k = 0; k < 30; ++k)
    hull.points.push_back({random.in(-1.0, 1.0), random.in(-0.6, 0.6), random.in(-0.8, 0.8)});
  return hull;
}

std::vector<Shape> some_shapes(test::Random& random) {
  return {
      Sphere{0.7},
      Box{{1.4, 0.5, 0.9}},
      Cylinder{0.6, 0.4},
      Capsule{0.3, 0.8},
      Cone{0.5, 1.2},
      random_hull(random),
      Compound{{{Box{{1, 0.4, 0.3}}, {0.2, 0, 0.1}, {0, 30, 0}}, {Cylinder{0.3, 0.5}, {-0.5, 0.3, 0}, {0, 0, 40}}}}};
}

// Is a point, in the piece's axes, inside it? From the definition of each shape.
bool inside(const Piece& piece, const Vec3d& p) {
  const double r = piece.radius, h = piece.half_length;
  switch (piece.kind) {
    case Piece::Kind::sphere:
      return length(p) <= r;
    case Piece::Kind::box:
      return std::abs(p.x) <= piece.half.x && std::abs(p.y) <= piece.half.y && std::abs(p.z) <= piece.half.z;
    case Piece::Kind::cylinder:
      return std::hypot(p.x, p.z) <= r && std::abs(p.y) <= h;
    case Piece::Kind::capsule:
      return std::hypot(p.x, p.y - std::clamp(p.y, -h, h), p.z) <= r;
    case Piece::Kind::cone:
      return std::abs(p.z) <= h && std::hypot(p.x, p.y) <= r * (h - p.z) / (2 * h);
    case Piece::Kind::hull:
      break;
  }
  return std::all_of(piece.hull->faces.begin(), piece.hull->faces.end(),
                     [&](const ConvexHull::Plane& face) { return dot(face.normal, p) <= face.offset; });
}

struct Placed {
  Solid solid;
  Vec3d position;
  Quat orientation;
  PosedSolid posed;

  bool holds(const Vec3d& p) const {
    return std::any_of(solid.pieces.begin(), solid.pieces.end(), [&](const Piece& piece) {
      const Vec3d local = math::rotate(math::conjugate(orientation), p - position) - piece.position;
      return inside(piece, math::rotate(math::conjugate(piece.rotation), local));
    });
  }
};

Placed place(const Shape& shape, test::Random& random) {
  Placed placed{
      *make_solid(shape), {random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0)}, random_turn(random)};
  placed.posed.place(placed.solid, placed.position, placed.orientation, true);
  return placed;
}

TEST(Shapes, UndersideIsWhereALineFromBelowEnters) {
  test::Random random(5);
  for (int round = 0; round < 8; ++round)
    for (const Shape& shape : some_shapes(random)) {
      const Placed body = place(shape, random);
      const Vec3d low = body.posed.low(), high = body.posed.high();
      for (int k = 0; k < 40; ++k) {
        const double x = random.in(low.x, high.x), y = random.in(low.y, high.y), step = (high.z - low.z) / 2000;
        double first = high.z + 1;
        for (double z = low.z - step; z < high.z && first > high.z; z += step)
          if (body.holds({x, y, z})) first = z;
        const Underside under = body.posed.underside(x, y);
        if (first > high.z) {
          // At most a sliver thinner than the step was missed.
          EXPECT_TRUE(!under.below || !body.holds({x, y, under.height + 1.5 * step})) << shape.index();
          continue;
        }
        ASSERT_TRUE(under.below) << shape.index();
        EXPECT_NEAR(under.height, first, 1.01 * step) << shape.index();
        EXPECT_NEAR(length(under.normal), 1, 1e-9) << shape.index();
        EXPECT_LE(under.normal.z, 1e-9) << shape.index();
      }
    }
}

TEST(Shapes, NormalIsTheSlopeOfTheUnderside) {
  test::Random random(6);
  for (const Shape& shape : some_shapes(random)) {
    const Placed body = place(shape, random);
    int good = 0, all = 0;
    for (int k = 0; k < 300; ++k) {
      const Vec3d low = body.posed.low(), high = body.posed.high();
      const double x = random.in(low.x, high.x), y = random.in(low.y, high.y), d = 1e-5;
      const Underside at = body.posed.underside(x, y), dx = body.posed.underside(x + d, y),
                      dy = body.posed.underside(x, y + d);
      if (!at.below || !dx.below || !dy.below || at.normal.z > -0.1) continue;
      ++all;
      good += std::abs((dx.height - at.height) / d + at.normal.x / at.normal.z) < 1e-2 &&
              std::abs((dy.height - at.height) / d + at.normal.y / at.normal.z) < 1e-2;
    }
    EXPECT_GT(all, 50) << shape.index();
    EXPECT_GE(good, all - 3) << shape.index();  // a few lie across an edge
  }
}

TEST(Shapes, CoverIsTheShareOfPointsThatAreOver) {
  test::Random random(7);
  for (int round = 0; round < 4; ++round)
    for (const Shape& shape : some_shapes(random)) {
      if (std::holds_alternative<Compound>(shape)) continue;  // its pieces are asked one by one
      const Placed body = place(shape, random);
      const PosedPiece& piece = body.posed.pieces()[0];
      for (int k = 0; k < 30; ++k) {
        const double x = random.in(piece.low.x, piece.high.x), y = random.in(piece.low.y, piece.high.y), width = 0.1;
        int over = 0;
        constexpr int kSide = 40;
        for (int i = 0; i < kSide; ++i)
          for (int j = 0; j < kSide; ++j)
            over += piece.underside(x + width * ((i + 0.5) / kSide - 0.5), y + width * ((j + 0.5) / kSide - 0.5)).below;
        EXPECT_NEAR(piece.covered(x, y, width).area / (width * width), over / double{kSide * kSide}, 0.08)
            << shape.index();
      }
    }
}

TEST(Shapes, InReachIsEveryPointThatCouldTouch) {
  test::Random random(8);
  for (const Shape& shape : some_shapes(random)) {
    const Placed body = place(shape, random);
    for (int k = 0; k < 300; ++k) {
      const Vec3 p{random.in(-2.0f, 2.0f), random.in(-2.0f, 2.0f), random.in(-2.0f, 2.0f)};
      bool touches = false;
      for (double up = 0; up < 0.3; up += 0.01) touches |= body.holds(to_double(p) + Vec3d{0, 0, up});
      EXPECT_TRUE(!touches || body.posed.within_reach(p, 0.3)) << shape.index();
    }
  }
}

// ---- mass

double worst(const math::Matrix3& a, const math::Matrix3& b) {
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

TEST(Shapes, MassIsThatOfPointsInside) {
  test::Random random(9);
  for (const Shape& shape : some_shapes(random)) {
    if (std::holds_alternative<Compound>(shape)) continue;  // where its parts overlap, mass counts twice
    const Solid solid = *make_solid(shape);
    const MassProperties mass = *mass_properties(shape);
    const Placed body{solid, {}, {}, {}};
    int count = 0;
    constexpr int kPoints = 200000;
    Vec3d center, squares;
    for (int i = 0; i < kPoints; ++i) {
      const double r = solid.radius;
      const Vec3d p{random.in(-r, r), random.in(-r, r), random.in(-r, r)};
      if (!body.holds(p)) continue;
      ++count;
      center += p;
      squares += Vec3d{p.y * p.y + p.z * p.z, p.x * p.x + p.z * p.z, p.x * p.x + p.y * p.y};
    }
    const double cell = std::pow(2 * solid.radius, 3) / kPoints;
    EXPECT_NEAR(count * cell / mass.volume, 1, 0.04) << shape.index();
    EXPECT_LT(length(center * (1.0 / count)), 0.02 * solid.radius) << shape.index();
    EXPECT_LT(length(squares * (1.0 / count) - solid.inertia), 0.06 * length(solid.inertia)) << shape.index();
  }
}

TEST(Shapes, AHullOfABoxIsTheBox) {
  Hull hull{.scale = 0.5};
  for (int k = 0; k < 8; ++k) hull.points.push_back({k & 1 ? 2.0 : -2.0, k & 2 ? 1.0 : -1.0, k & 4 ? 3.0 : -3.0});
  hull.points.push_back({0.3, 0.2, 0.1});  // inside: no corner
  const auto a = *mass_properties(hull), b = *mass_properties(Box{{2, 1, 3}});
  EXPECT_NEAR(a.volume, b.volume, 1e-9);
  EXPECT_LT(length(a.center), 1e-9);
  EXPECT_LT(worst(a.inertia, b.inertia), 1e-9);
  const Shape shown = drawn(hull);
  EXPECT_EQ(std::get<Hull>(shown).points.size(), 8u);
  EXPECT_EQ(std::get<Hull>(shown).triangles.size(), 36u);
}

TEST(Shapes, ABoxInTwoHalvesIsTheBox) {
  const Compound halves{{{Box{{1, 1, 3}}, {-0.5, 0, 0}, {}}, {Box{{1, 1, 3}}, {0.5, 0, 0}, {0, 0, 180}}}};
  const auto a = *mass_properties(halves), b = *mass_properties(Box{{2, 1, 3}});
  EXPECT_NEAR(a.volume, b.volume, 1e-9);
  EXPECT_LT(worst(a.inertia, b.inertia), 1e-9);
}

TEST(Shapes, PrincipalAxesAreFoundHoweverAPartIsTurned) {
  const Vec3d straight = make_solid(Box{{2, 1, 3}})->inertia;
  const Solid turned = *make_solid(Compound{{{Box{{2, 1, 3}}, {0.3, -0.2, 0.1}, {20, 50, -70}}}});
  std::array<double, 3> a = {straight.x, straight.y, straight.z},
                        b = {turned.inertia.x, turned.inertia.y, turned.inertia.z};
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-9);
  // The shape's own origin is still where it was.
  EXPECT_LT(length(turned.origin + math::rotate(turned.axes, {0.3, -0.2, 0.1})), 1e-9);
}

TEST(Shapes, FlatPointsAreNoBody) {
  EXPECT_FALSE(make_solid(Hull{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}));
  EXPECT_FALSE(make_solid(Hull{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
}

}  // namespace
}  // namespace divot::geometry
