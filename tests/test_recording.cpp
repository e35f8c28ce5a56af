// What is done to a world can be kept, written, read and done again, to the same bits.
#include <filesystem>
#include <fstream>

#include "divot/recording.h"
#include "support.h"

namespace divot {
namespace {

namespace fs = std::filesystem;

class RecordingFile : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove(path_); }
  std::string path_ = (fs::path(::testing::TempDir()) / ("session_" + std::to_string(getpid()) + ".toml")).string();

  Errors errors_of(const std::string& text) {
    std::ofstream(path_) << text;
    auto read = read_recording(path_);
    return read ? Errors{} : read.error();
  }
};

Scene sand() {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 61, .rows = 61, .spacing = 0.1}, .material = "dry_sand"};
  scene.bodies = {{.name = "ball", .shape = Sphere{0.2}, .mass = 40, .above_ground = true}};
  return scene;
}

TEST_F(RecordingFile, TheSameCommandsGiveTheSameBits) {
  World world = test::make_world(sand());
  world.keep_commands();
  const auto steps = [&](int count) {
    for (int k = 0; k < count; ++k) world.step();
  };
  steps(3);
  ASSERT_TRUE(world.add_bomb({.time = world.time(), .position = {1, 1.1, 0}, .above_ground = true, .yield = 1e-4}));
  steps(20);
  const Compound dumbbell{{{Sphere{0.1}, {0, 0.3, 0}, {}}, {Box{{0.1, 0.8, 0.1}}, {}, {0, 0, 10}}}};
  ASSERT_TRUE(world.spawn({.name = "bell", .shape = dumbbell, .mass = 8, .position = {0.1, -1, 0.7}}));
  Joint hinge{.name = "h", .first = "ball", .second = "bell", .axis = {0, 1, 0.1}, .lower = -10.5};
  hinge.motor_speed = {{{0, 0}, {1, 2.5}}}, hinge.motor_force = 3;
  ASSERT_TRUE(world.add_joint(hinge));
  world.set_motor({0}, 1.25, 7);
  steps(5);
  ASSERT_TRUE(world.push_ground({.position = {-1, 0, 0}, .radius = 0.6, .velocity = {0, 0.5, 1.5}}));
  world.set_motor({0}, 0.1, 2);
  steps(40);
  EXPECT_FALSE(world.add_bomb({.yield = -1}));  // what fails is not kept
  ASSERT_EQ(world.commands().size(), 6u);

  const Recording session{.scene = "sand.toml",
                          .changes = {{"seed", "3"}},
                          .fingerprint = world.scene_fingerprint(),
                          .steps = world.steps(),
                          .commands = {world.commands().begin(), world.commands().end()}};
  ASSERT_TRUE(write_recording(path_, session));
  const auto read = read_recording(path_);
  ASSERT_TRUE(read) << read.error().front().text();
  EXPECT_EQ(read->scene, "sand.toml");
  EXPECT_EQ(read->changes.at(0).value, "3");
  EXPECT_EQ(read->fingerprint, session.fingerprint);
  EXPECT_EQ(read->steps, 68u);

  World again = test::make_world(sand());
  std::size_t next = 0;
  while (again.steps() < read->steps) {
    for (; next < read->commands.size() && read->commands[next].step == again.steps(); ++next)
      ASSERT_TRUE(again.carry_out(read->commands[next]));
    again.step();
  }
  EXPECT_EQ(again.state_hash(), world.state_hash());
}

TEST_F(RecordingFile, ErrorsNameLineAndKey) {
  const std::string start = "scene = \"s.toml\"\nsteps = 9\n";
  const auto expect = [&](const std::string& text, const std::string& error) {
    const Errors errors = errors_of(text);
    ASSERT_FALSE(errors.empty()) << text;
    EXPECT_NE(errors[0].text().find(path_ + error), std::string::npos) << errors[0].text();
  };
  expect("steps = 9\n", ": scene: is missing");
  expect(start + "[[commands]]\nstep = 2\n", ":3: commands[0]: holds neither body nor joint nor bomb");
  expect(start + "[[commands]]\nstep = 2\nbomb = { position = [0, 0], yield = -1 }\n",
         ":5: commands[0].bomb.yield: -1 is out of range");
  expect(start + "[[commands]]\nstep = 2\nmotor = { speed = 1 }\n", ":5: commands[0].motor.joint: is missing");
  expect(start + "commands = [{ step = 5, steering = { joint = 0 } }, { step = 4, steering = { joint = 0 } }]\n",
         ":3: commands[1].step: 4 comes after 5");
  expect("fingerprint = \"xyz\"\n" + start, ":1: fingerprint: \"xyz\" is no fingerprint");
  expect(start + "speed = 3\n", ":3: speed: unknown key");
}

TEST_F(RecordingFile, RefusesWhatNoFileHolds) {
  const BodySettings rock{.shape = Hull{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  const auto written = write_recording(path_, {.scene = "s.toml", .commands = {{0, rock}}});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error()[0].key, "commands");
  EXPECT_FALSE(fs::exists(path_));
}

TEST(Commands, OnAJointThatIsNotThereFail) {
  World world = test::make_world(sand());
  const auto done = world.carry_out({0, MotorSetting{2, 1, 1}});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error()[0].text(), "joint: there is no joint 2; expected less than 0");
}

}  // namespace
}  // namespace divot
