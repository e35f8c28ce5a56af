// How many substeps a step is cut into.
#include "support.h"

namespace divot {
namespace {

TEST(Substeps, HardGroundSetsThemOnlyWhileItMoves) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 41, .rows = 41, .spacing = 0.05}, .material = "asphalt"};
  scene.bodies = {{.shape = Sphere{0.2}, .mass = 80, .position = {0.01, 0.02, 0.6}}};
  World world = test::make_world(scene);
  int most = 0;
  while (world.time() < 1) most = std::max(most, world.step().substeps);
  EXPECT_EQ(most, 64);
  const double sinkage = world.bodies()[0].max_sinkage;
  test::run_to(world, 4);
  const StepReport report = world.step();
  EXPECT_LT(report.substeps, 16);
  EXPECT_TRUE(report.substeps_limited) << "it is softened, and the report says so";
  EXPECT_EQ(world.bodies()[0].max_sinkage, sinkage) << "softened ground that hardly moves bears as before";
  EXPECT_NEAR(world.bodies()[0].position.z, 0.2, 2e-3) << "a ball bears on a point";
}

}  // namespace
}  // namespace divot
