// Scenes that include others: places, names, errors.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "support.h"

namespace divot {
namespace {

constexpr const char* kGrid = "[terrain]\ngrid = { columns = 101, rows = 101, spacing = 0.2 }\n";

// A folder of files for one test.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_(std::filesystem::temp_directory_path() / ("divot_" + name)) {
    std::filesystem::create_directories(path_ / "parts");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  Result<Scene> load(const std::vector<Override>& overrides = {}) const {
    return load_scene((path_ / "main.toml").string(), overrides);
  }
  // Errors with the folder's own path left out.
  std::string errors(const std::vector<Override>& overrides = {}) const {
    const auto scene = load(overrides);
    std::string all;
    if (scene) return all;
    for (const Error& error : scene.error()) all += error.text() + "\n";
    const std::string own = path_.string() + "/";
    for (std::size_t at = all.find(own); at != std::string::npos; at = all.find(own)) all.erase(at, own.size());
    return all;
  }

 private:
  std::filesystem::path path_;
};

constexpr const char* kPart = R"([[bodies]]
name = "a"
shape = { hull = { file = "rock.obj" } }
mass = 1
position = [2, 0, 0.5]
velocity = [1, 0, 0]
[[bodies]]
name = "b"
shape = { sphere = { radius = 0.1 } }
mass = 1
position = [0, 1, 0.25]
rotation_deg = [0, 5, 10]
[[joints]]
type = "hinge"
first = "a"
second = "b"
)";

TEST(SceneIncludes, PlaceAndNameWhatTheyBring) {
  const Folder folder("include_place");
  folder.write("parts/part.toml", kPart);
  folder.write("main.toml",
               std::string("include = [{ file = \"parts/part.toml\", name = \"p\", position = [10, 20, 3], "
                           "heading_deg = 90 }, \"parts/part.toml\"]\n") +
                   kGrid);
  const auto scene = folder.load();
  ASSERT_TRUE(scene) << folder.errors();
  ASSERT_EQ(scene->bodies.size(), 4u);
  const BodySettings &a = scene->bodies[0], &b = scene->bodies[1];
  EXPECT_EQ(a.name, "p/a");
  EXPECT_LT(length(a.position - Vec3d{10, 22, 3.5}), 1e-12);
  EXPECT_LT(length(a.velocity - Vec3d{0, 1, 0}), 1e-12);
  EXPECT_LT(length(a.rotation_deg - Vec3d{0, 0, 90}), 1e-12);
  EXPECT_FALSE(a.above_ground);
  EXPECT_EQ(std::get<Hull>(a.shape).file, "parts/rock.obj");
  EXPECT_LT(length(b.position - Vec3d{9, 20, 3.25}), 1e-12);
  EXPECT_LT(length(b.rotation_deg - Vec3d{0, 5, 100}), 1e-12);
  EXPECT_EQ(scene->joints[0].first, "p/a");
  EXPECT_EQ(scene->bodies[2].name, "a");
  EXPECT_EQ(scene->joints[1].second, "b");
}

TEST(SceneIncludes, OnTheGroundStandAsOneAssembly) {
  const Folder folder("include_ground");
  folder.write("parts/part.toml", R"([[bodies]]
name = "low"
shape = { sphere = { radius = 0.5 } }
mass = 1
position = [0, 0, 0.5]
[[bodies]]
name = "high"
shape = { sphere = { radius = 0.5 } }
mass = 1
position = [1, 0, 2]
)");
  folder.write("main.toml",
               std::string("[[include]]\nfile = \"parts/part.toml\"\nname = \"p\"\nposition = [1, 2]\n") + kGrid);
  auto scene = folder.load();
  ASSERT_TRUE(scene) << folder.errors();
  EXPECT_EQ(scene->bodies[1].assembly, "p");
  std::get<GridTerrain>(scene->terrain.shape).height = [](double x, double) { return 5 + 0.2 * x; };
  const World world = test::make_world(*scene);
  const auto bodies = world.bodies();
  EXPECT_NEAR(bodies[1].position.z - bodies[0].position.z, 1.5, 1e-9);
  EXPECT_NEAR(bodies[0].position.z, 5.2 + 0.5 * std::sqrt(1.04), 0.01);
}

TEST(SceneIncludes, ErrorsNameTheFileTheyAreIn) {
  const Folder folder("include_errors");
  folder.write("parts/part.toml",
               "duration = 3\n[[bodies]]\nname = \"a\"\nmas = 4\nshape = { sphere = { radius = 1 } }\n"
               "position = [0, 0, 1]\n");
  folder.write("main.toml", std::string("include = [\"parts/part.toml\"]\n") + kGrid);
  EXPECT_EQ(
      folder.errors(),
      "parts/part.toml:1: duration: means nothing in a file that another includes; expected bodies, joints, bombs, "
      "materials or include\n");
  folder.write("parts/part.toml",
               "[[bodies]]\nname = \"a\"\nmas = 4\nshape = { sphere = { radius = 1 } }\n"
               "position = [0, 0, 1]\n");
  EXPECT_EQ(folder.errors(), "parts/part.toml:3: bodies[0].mas: unknown key; the nearest known key is mass\n");
  folder.write("main.toml", std::string("include = [\"parts/none.toml\"]\n") + kGrid);
  EXPECT_EQ(
      folder.errors(),
      "main.toml:1: include[0].file: \"parts/none.toml\" cannot be read: No such file or directory; expected a scene "
      "file\n");
  folder.write("main.toml", std::string("[[include]]\nfil = \"parts/part.toml\"\n") + kGrid);
  EXPECT_EQ(folder.errors(), "main.toml:2: include[0].fil: unknown key; the nearest known key is file\n");
}

TEST(SceneIncludes, CirclesAreRefused) {
  const Folder folder("include_circle");
  folder.write("parts/part.toml", "include = [\"../main.toml\"]\n");
  folder.write("main.toml", std::string("include = [\"parts/part.toml\"]\n") + kGrid);
  EXPECT_EQ(folder.errors().substr(0, 80).find("parts/part.toml:1: include[0].file: \"../main.toml\" includes itself"),
            0u)
      << folder.errors();
}

TEST(SceneIncludes, WhatTheyBringCanBeSet) {
  const Folder folder("include_set");
  folder.write("parts/part.toml", kPart);
  folder.write("main.toml", std::string("include = [{ file = \"parts/part.toml\", name = \"p\" }]\n") + kGrid);
  const auto scene = folder.load({{"bodies.1.mass", "7"}, {"include.0.name", "q"}});
  ASSERT_TRUE(scene) << folder.errors();
  EXPECT_EQ(scene->bodies[1].mass, 7);
  EXPECT_EQ(scene->bodies[1].name, "q/b");
  EXPECT_EQ(folder.errors({{"bodies.1.mass", "-1"}}),
            "--set bodies.1.mass: bodies[1].mass: -1 is out of range; expected a number > 0 and <= 1e12 (kg)\n");
}

TEST(SceneJoints, ErrorsSayWhatWouldBeRight) {
  const auto errors = [](const std::string& joint) {
    const auto scene = parse_scene(std::string(kGrid) +
                                       "[[bodies]]\nname = \"a\"\nshape = { sphere = { radius = 1 } }\nmass = 1\n"
                                       "position = [0, 0]\n[[joints]]\n" +
                                       joint,
                                   "s.toml");
    std::string all;
    if (!scene)
      for (const Error& error : scene.error()) all += error.text() + "\n";
    return all;
  };
  EXPECT_EQ(errors("type = \"hinge\"\nsecond = \"b\"\n"),
            "s.toml:10: joints[0].second: there is no body \"b\"; expected \"a\"\n");
  EXPECT_EQ(
      errors("type = \"screw\"\nsecond = \"a\"\n"),
      "s.toml:9: joints[0].type: \"screw\" is not known; expected \"hinge\", \"slider\", \"fixed\", \"spring\" or "
      "\"wheel\"\n");
  EXPECT_EQ(errors("type = \"hinge\"\nsecond = \"a\"\nstiffness = 4\n"),
            "s.toml:11: joints[0].stiffness: means nothing for this type; expected it only with spring or wheel\n");
  EXPECT_EQ(
      errors("type = \"hinge\"\nsecond = \"a\"\nmotor_force = [[0, 1], [0, 2]]\n"),
      "s.toml:11: joints[0].motor_force[1]: time 0 does not come after the one before; expected ascending times (s)\n");
  EXPECT_EQ(errors("type = \"wheel\"\nsecond = \"a\"\nstiffness = 4\naxle = [0, 0, 2]\n"),
            "s.toml:12: joints[0].axle: does not point across axis; expected a vector at a right angle to axis\n");
}

}  // namespace
}  // namespace divot
