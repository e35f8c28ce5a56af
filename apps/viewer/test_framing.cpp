#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "viewer/camera.h"
#include "viewer/test_pictures.h"

namespace divot::viewer {
namespace {

TEST(Framing, AllOfASmallTerrainIsInThePicture) {
  const TestSurface ground = paper_ground();
  const Shown shown(ground);
  const Framing framing = frame(ground.view(), shown.bodies, shown.bombs);
  for (const double x : {-196.0, 196.0}) {
    for (const double y : {-212.0, 212.0}) {
      const auto [column, row] = project(framing.camera, ground.place(x, y, 0), 1280, 720);
      EXPECT_TRUE(column > 0 && column < 1280 && row > 0 && row < 720) << column << ", " << row;
    }
  }
  const auto [column, top] = project(framing.camera, shown.bodies[0].position + Vec3d{0, 0, 75}, 1280, 720);
  EXPECT_TRUE(top > 0 && column > 0);
}

TEST(Framing, LargeTerrainShowsWhereThingsHappen) {
  const TestSurface ground(60, 60, 500, [](double, double) { return 0.0; });
  BombView bomb = paper_bomb(ground, false);
  bomb.position = ground.place(3000, -2000, 0);
  const Framing framing = frame(ground.view(), {}, std::span(&bomb, 1));
  EXPECT_LT(length(framing.camera.eye - bomb.position), 1500);
  // The crater to come has equal room on both sides.
  const Vec3d toward = framing.camera.target - framing.camera.eye;
  const Vec3d ahead = Vec3d{toward.x, toward.y, 0} * (122 / std::hypot(toward.x, toward.y));
  const Vec3d right = cross(ahead, {0, 0, 1});
  const auto at = [&](const Vec3d& from_bomb) { return project(framing.camera, bomb.position + from_bomb, 1280, 720); };
  EXPECT_NEAR(at(right).first + at(-right).first, 1280, 30);
  EXPECT_NEAR(at(ahead).second + at(-ahead).second, 720, 30);
  EXPECT_GT(at(right).first - at(-right).first, 720);
}

TEST(Framing, NothingAtAllStillHasACamera) {
  const Framing framing = frame(SurfaceView{}, {}, {});
  EXPECT_TRUE(is_finite(framing.camera.eye));
  EXPECT_NE(framing.camera.eye, framing.camera.target);
}

}  // namespace
}  // namespace divot::viewer
