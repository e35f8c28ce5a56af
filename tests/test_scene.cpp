#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "divot/scene.h"
#include "scene/keys.h"
#include "scene/nearest.h"
#include "scene/visitor.h"
#include "source_dir.h"

namespace divot {
namespace {

constexpr const char* kGrid = "[terrain]\ngrid = { columns = 37, rows = 40, spacing = 10.9 }\n";

// Every key of the format once, none at its default. The texture is a file that every machine has.
constexpr const char* kFull = R"(duration = 5
dt = 0.01
gravity = [0.5, 0, -1.62]
seed = 7
[terrain]
dem = "hill.asc"
crs = "EPSG:4326"
band = 2
material = "field"
max_vertices = 1000
[terrain.material_map]
image = "zones.png"
crs = "EPSG:3857"
legend = { 0 = "loam", -7 = "mud" }
[materials.field]
base = "loam"
kphi = 3e6
over = { material = "mud", thickness = 0.25 }
[materials.loam]
base = "mud"
reference_spacing = 2
particle_mass = 3
e0 = 4
m = 3
n = 5
spring_stiffness = 6
yield_strain = 0.1
viscous_damping = 7
global_damping = 8
ground = true
kc = 9
kphi = 10
bekker_n = 0.9
elastic_stiffness = 11
ground_damping_ratio = 0.5
cohesion = 12
friction_angle_deg = 13
shear_modulus = 0.1
restitution = 0.2
density = 1234
compaction_limit = 0.4
repose_angle_deg = 21
blast_strength = 14
blast_drag = 15
ejecta_share = 0.3
color = "#8a7a55"
texture = "/proc/self/exe"
texture_size = 4
[[bodies]]
name = "ball"
shape = { sphere = { radius = 75.0 } }
mass = 45
position = [-150, 20, 76]
above_ground = true
velocity = [25, 0, 0]
angular_velocity = [0, 1, 0]
restitution = 0.1
friction = 0.2
[[bodies]]
shape = { sphere = { radius = 2 } }
mass = 4
position = [1, 2]
[[bombs]]
time = 0.5
position = [0, 0, 10]
yield = 5000
[[bombs]]
position = [3, 4]
yield = 1
[solver]
cohesion = "mass_spring"
blast = "paper"
integrator = "rk4"
neighbours = "kd_tree"
neighbour_update = "every_step"
bvh_update = { every = 10 }
cutoff = 2
skin = 0.5
[output]
every = 0.1
formats = ["ply", "csv"]
)";

/// The errors of a scene as a user sees them, one a line.
std::string errors_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  const Result<Scene> scene = parse_scene(text, "s.toml", overrides);
  if (scene) return "";
  std::string out;
  for (const Error& error : scene.error()) out += error.text() + "\n";
  return out;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string format_page() { return read_file(std::filesystem::path(test::source_dir()) / "docs/scene-format.md"); }

TEST(Scene, ReadsEveryKey) {
  const Result<Scene> read = parse_scene(kFull, "folder/full.toml");
  ASSERT_TRUE(read) << errors_of(kFull);
  const Scene& s = *read;
  EXPECT_EQ(s.name, "full");
  EXPECT_EQ(s.folder, "folder");
  EXPECT_EQ(s.duration, 5);
  EXPECT_EQ(s.dt, 0.01);
  EXPECT_EQ(s.gravity, (Vec3d{0.5, 0, -1.62}));
  EXPECT_EQ(s.seed, 7u);

  const auto& dem = std::get<DemTerrain>(s.terrain.shape);
  EXPECT_EQ(dem.path, "hill.asc");
  EXPECT_EQ(dem.crs, "EPSG:4326");
  EXPECT_EQ(dem.band, 2);
  EXPECT_EQ(s.terrain.material, "field");
  EXPECT_EQ(s.terrain.max_vertices, 1000u);
  EXPECT_EQ(s.terrain.material_map.image, "zones.png");
  EXPECT_EQ(s.terrain.material_map.crs, "EPSG:3857");
  ASSERT_EQ(s.terrain.material_map.legend.size(), 2u);
  EXPECT_EQ(s.terrain.material_map.legend[0].pixel, -7);
  EXPECT_EQ(s.terrain.material_map.legend[0].material, "mud");
  EXPECT_EQ(s.terrain.material_map.legend[1].pixel, 0);

  ASSERT_EQ(s.bodies.size(), 2u);
  EXPECT_EQ(s.bodies[0].name, "ball");
  EXPECT_EQ(std::get<Sphere>(s.bodies[0].shape).radius, 75);
  EXPECT_EQ(s.bodies[0].mass, 45);
  EXPECT_EQ(s.bodies[0].position, (Vec3d{-150, 20, 76}));
  EXPECT_TRUE(s.bodies[0].above_ground);
  EXPECT_EQ(s.bodies[0].velocity, (Vec3d{25, 0, 0}));
  EXPECT_EQ(s.bodies[0].angular_velocity, (Vec3d{0, 1, 0}));
  EXPECT_EQ(s.bodies[0].restitution, 0.1);
  EXPECT_EQ(s.bodies[0].friction, 0.2);
  EXPECT_EQ(s.bodies[1].name, "body2");
  EXPECT_EQ(s.bodies[1].position, (Vec3d{1, 2, 0}));
  EXPECT_TRUE(s.bodies[1].above_ground);

  ASSERT_EQ(s.bombs.size(), 2u);
  EXPECT_EQ(s.bombs[0].time, 0.5);
  EXPECT_EQ(s.bombs[0].position, (Vec3d{0, 0, 10}));
  EXPECT_FALSE(s.bombs[0].above_ground);
  EXPECT_EQ(s.bombs[0].yield, 5000);
  EXPECT_TRUE(s.bombs[1].above_ground);

  EXPECT_EQ(s.solver.cohesion, Cohesion::mass_spring);
  EXPECT_EQ(s.solver.blast, Blast::paper);
  EXPECT_EQ(s.solver.integrator, Integrator::rk4);
  EXPECT_EQ(s.solver.neighbours, Neighbours::kd_tree);
  EXPECT_EQ(s.solver.neighbour_update.kind, UpdatePolicy::Kind::every_step);
  EXPECT_EQ(s.solver.bvh_update, (UpdatePolicy{UpdatePolicy::Kind::every, 10}));
  EXPECT_EQ(s.solver.cutoff, 2);
  EXPECT_EQ(s.solver.skin, 0.5);
  EXPECT_EQ(s.output.every, 0.1);
  EXPECT_EQ(s.output.formats, (std::vector<std::string>{"ply", "csv"}));
  EXPECT_TRUE(check(s).empty());
}

TEST(Scene, MaterialsInheritWhateverTheirOrder) {
  const Result<Scene> read = parse_scene(kFull, "full.toml");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->materials.size(), 2u);
  const Material &loam = read->materials[0], &field = read->materials[1];
  EXPECT_EQ(loam.name, "loam");
  EXPECT_EQ(field.name, "field");
  // Every key of the material reaches its own field.
  const double values[] = {loam.reference_spacing,
                           loam.particle_mass,
                           loam.dissociation_energy,
                           loam.attraction_exponent,
                           loam.repulsion_exponent,
                           loam.spring_stiffness,
                           loam.yield_strain,
                           loam.viscous_damping,
                           loam.global_damping,
                           loam.bekker_kc,
                           loam.bekker_kphi,
                           loam.bekker_n,
                           loam.elastic_stiffness,
                           loam.ground_damping_ratio,
                           loam.cohesion,
                           loam.friction_angle_deg,
                           loam.shear_modulus,
                           loam.restitution,
                           loam.blast_strength,
                           loam.blast_drag,
                           loam.ejecta_share,
                           loam.density,
                           loam.compaction_limit,
                           loam.repose_angle_deg,
                           loam.texture_size};
  const double written[] = {2,   3,  4,  3,   5,   6,  0.1, 7,   8,    9,   10, 0.9, 11,
                            0.5, 12, 13, 0.1, 0.2, 14, 15,  0.3, 1234, 0.4, 21, 4};
  EXPECT_EQ(loam.color, "#8a7a55");
  EXPECT_EQ(loam.texture, "/proc/self/exe");
  for (std::size_t i = 0; i < std::size(values); ++i) EXPECT_EQ(values[i], written[i]) << i;
  EXPECT_EQ(field.bekker_kphi, 3e6);
  EXPECT_EQ(field.cohesion, loam.cohesion);
}

TEST(Scene, MaterialMayReplaceThePresetOfItsName) {
  const auto read = parse_scene(std::string(kGrid) + "[materials.mud]\ncohesion = 3\n[materials.x]\nbase = \"mud\"\n" +
                                    "[materials.asphalt]\nbase = \"asphalt\"\n[materials.y]\n",
                                "s.toml");
  ASSERT_TRUE(read);
  for (const Material& material : read->materials) {
    const bool mud = material.name == "mud" || material.name == "x";
    const char* origin = mud ? "mud" : material.name == "asphalt" ? "asphalt" : "paper";
    EXPECT_EQ(material.bekker_kphi, find_preset(origin)->bekker_kphi) << material.name;
    if (mud) {
      EXPECT_EQ(material.cohesion, 3);
    }
  }
}

TEST(Scene, LeavesDefaultsWhereTheFileIsSilent) {
  const Result<Scene> read = parse_scene(kGrid, "s.toml");
  ASSERT_TRUE(read);
  const Scene defaults;
  EXPECT_EQ(read->dt, defaults.dt);
  EXPECT_EQ(read->gravity, defaults.gravity);
  EXPECT_EQ(read->terrain.material, "paper");
  EXPECT_EQ(read->solver.bvh_update, defaults.solver.bvh_update);
  EXPECT_EQ(std::get<GridTerrain>(read->terrain.shape).rows, 40);
}

TEST(Scene, NamesBodiesAroundNamesThatAreTaken) {
  const std::string ball = "shape = { sphere = { radius = 1 } }\nmass = 1\nposition = [0, 0]\n";
  const auto read = parse_scene(kGrid + ("[[bodies]]\nname = \"body2\"\n" + ball) + "[[bodies]]\n" + ball, "s.toml");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->bodies[1].name, "body3");
}

/// A line of a scene and the error it must give, without file and line.
struct Wrong {
  const char* text;
  std::string error;
};

/// The presets as an error lists them.
const std::string kPresets = [] {
  std::vector<std::string> names;
  for (const Material& preset : material_presets()) names.push_back(preset.name);
  return scene::one_of(names);
}();

TEST(SceneErrors, SayWhatIsWrongAndWhatWouldBeRight) {
  const Wrong cases[] = {
      {"duration = -1", "duration: -1 is out of range; expected a number > 0 and <= 1e9 (s)"},
      {"duration = \"5\"", "duration: \"5\" is text; expected a number > 0 and <= 1e9 (s)"},
      {"dt = 0", "dt: 0 is out of range; expected a number > 0 and <= 1 (s)"},
      {"dt = nan", "dt: nan is out of range; expected a number > 0 and <= 1 (s)"},
      {"dt = 0.5\nduration = 0.25",
       "dt: 0.5 s is longer than the whole run; expected at most duration, which is 0.25 s"},
      {"dt = 1e-9", "dt: 10 s in steps of 1e-9 s are 1e10 steps; expected at most 1e9 steps"},
      {"gravity = [0, inf, 0]", "gravity[1]: inf is out of range; expected a number >= -1000 and <= 1000 (m/s^2)"},
      {"gravity = [0, 0]", "gravity: is a list of 2; expected [x, y, z] (m/s^2)"},
      {"gravity = [0, true, 0]", "gravity[1]: true is a truth value; expected a number >= -1000 and <= 1000 (m/s^2)"},
      {"seed = 1.0", "seed: 1.0 is not an integer; expected an integer >= 0"},
      {"durration = 1", "durration: unknown key; the nearest known key is duration"},
      {"yield = 1", "yield: unknown key; the nearest known key is bombs[].yield"},
      {"solver.blast = \"papre\"", "solver.blast: \"papre\" is not known; expected \"scaled\" or \"paper\""},
      {"solver.cutoff = 1", "solver.cutoff: 1 is out of range; expected a number >= 1.1 and <= 4 (spacings)"},
      {"solver.bvh_update = \"never\"",
       "solver.bvh_update: \"never\" is not known; expected \"adaptive\", \"every_step\" or { every = 10 }"},
      {"solver.bvh_update = { every = 0 }",
       "solver.bvh_update.every: 0 is out of range; expected an integer >= 1 and <= 1e9 (steps)"},
      {"solver = 3", "solver: 3 is a number; expected a table"},
      {"output.formats = [\"stl\"]",
       "output.formats[0]: \"stl\" is not known; expected \"ply\", \"obj\", \"glb\", \"vtp\", \"csv\", \"tif\", "
       "\"change.tif\", \"sinkage.tif\" or \"height.png\""},
      {"output.formats = [\"ply\", \"ply\"]", "output.formats[1]: \"ply\" is there twice; expected each once"},
      {"bodies = 5", "bodies: 5 is a number; expected tables headed [[bodies]]"},
      {"materials.a.base = \"b\"", "materials.a.base: there is no material \"b\"; expected " + kPresets},
      {"materials.a.color = \"#12345g\"",
       "materials.a.color: \"#12345g\" is no colour; expected red, green and blue as two hexadecimal digits each: "
       "\"#8a7a55\""},
      {"materials.a.texture = \"none.png\"",
       "materials.a.texture: \"none.png\" is not a file; expected a PNG or JPEG picture; relative paths start at the "
       "scene's folder"},
      {"materials.a.dissociation_energy = 1",
       "materials.a.dissociation_energy: unknown key; the nearest known key is e0"},
      {"materials.a.n = 1",
       "materials.a.n: 1 does not exceed the exponent of attraction; expected more than materials.a.m, which is 2"},
      {"materials.a.kphi = 0",
       "materials.a.kphi: 0 together with kc = 0 leaves the ground without stiffness; expected a number > 0, or ground "
       "= false"},
  };
  for (const Wrong& wrong : cases) {
    const std::string text = std::string(wrong.text) + "\n" + kGrid;
    EXPECT_EQ(errors_of(text), fmt::format("s.toml:1: {}\n", wrong.error)) << text;
  }
}

TEST(SceneErrors, OfTerrain) {
  const Wrong cases[] = {
      {"max_vertices = 9",
       "terrain: holds neither grid nor dem nor mesh; expected grid = { columns = 37, rows = 40, spacing = 10.9 } or "
       "dem = \"file.tif\" or mesh = \"file.obj\""},
      {"grid = { columns = 100000, rows = 100000, spacing = 1 }",
       "terrain.grid: 100000 columns x 100000 rows are 10000000000 vertices; expected at most terrain.max_vertices, "
       "which is 20000000"},
      {"grid = { columns = 3, rows = 3 }", "terrain.grid.spacing: is missing; expected a number > 0 and <= 100000 (m)"},
      {"grid = { columns = 3000000000, rows = 3, spacing = 1 }",
       "terrain.grid.columns: 3000000000 is out of range; expected an integer >= 2 and <= 1000000"},
      {"dem = \"\"", "terrain.dem: is empty; expected the name of a raster file"},
      {"mesh = \"rock.obj\"\nscale = 0", "terrain.scale: 0 is out of range; expected a number > 0 and <= 100000 (m)"},
      {"dem = \"a.tif\"\nbox = { west = 2, south = 1, east = 1, north = 3 }",
       "terrain.box: from 2 to 1 and from 1 to 3 has no area; expected west < east and south < north"},
      {"dem = \"a.tif\"\nmaterial = \"sol\"", "terrain.material: there is no material \"sol\"; expected " + kPresets},
      {"grid = { columns = 3, rows = 3, spacing = 1 }\ncrs = \"x\"",
       "terrain.crs: means something only beside dem; expected it left out with grid"},
      {"grid = { columns = 3, rows = 3, spacing = 1 }\ndem = \"x\"",
       "terrain: holds grid and dem at once; expected one of them"},
      {"dem = \"x\"\nrefine = { min_edge = -1 }",
       "terrain.refine.min_edge: -1 is out of range; expected a number >= 0 and <= 100000 (m)"},
      {"dem = \"x\"\nrefine = { max_level = 2 }",
       "terrain.refine.min_edge: is missing; expected a number >= 0 and <= 100000 (m)"},
      {"dem = \"x\"\nmaterial_map = 3",
       "terrain.material_map: 3 is a number; expected material_map = { image = \"road.png\", legend = { 0 = \"field\", "
       "255 = \"asphalt\" } }"},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\" }",
       "terrain.material_map.legend: is missing; expected a table as { 0 = \"field\", 255 = \"asphalt\" }"},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\", legend = { \"1.5\" = \"mud\" } }",
       "terrain.material_map.legend.1.5: no value of a pixel; expected an integer, or a colour as \"#8a6f4d\""},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\", legend = { \"#12345\" = \"mud\" } }",
       "terrain.material_map.legend.#12345: no value of a pixel; expected an integer, or a colour as \"#8a6f4d\""},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\", legend = { 1 = 2 } }",
       "terrain.material_map.legend.1: 2 is a number; expected the name of a material in quotes"},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\", legend = { 1 = \"sol\" } }",
       "terrain.material_map.legend.1: there is no material \"sol\"; expected " + kPresets},
      {"dem = \"x\"\nmaterial_map = { image = \"a.png\", legend = { 1 = \"mud\", \"#112233\" = \"rock\" } }",
       "terrain.material_map.legend.1: numbers and colours in one legend; expected all of one kind"},
      {"dem = \"x\"\nmaterial_map = { image = \"\", legend = { 1 = \"mud\" } }",
       "terrain.material_map.image: is empty; expected the name of an image or raster"},
  };
  for (const Wrong& wrong : cases) {
    const Result<Scene> scene = parse_scene(std::string("[terrain]\n") + wrong.text, "");
    ASSERT_FALSE(scene) << wrong.text;
    ASSERT_EQ(scene.error().size(), 1u) << wrong.text << "\n" << scene.error().at(1).text();
    Error error = scene.error().front();
    EXPECT_GT(error.line, 0);
    error.line = 0;
    EXPECT_EQ(error.text(), wrong.error);
  }
  EXPECT_EQ(errors_of(""),
            "s.toml: terrain: is missing; expected [terrain] with grid = { ... }, dem = \"file.tif\" or mesh = "
            "\"file.obj\"\n");
}

TEST(SceneErrors, OfBodiesAndBombsAreAllReportedInOrder) {
  const std::string text = std::string(kGrid) + R"([[bodies]]
name = "x"
shape = { box = { size = 1 } }
mas = 5
position = [1]
[[bodies]]
name = "x"
shape = "sphere"
mass = -3
position = [1, 2]
above_ground = false
[[bombs]]
time = -1
yield = 0
)";
  EXPECT_EQ(errors_of(text),
            "s.toml:5: bodies[0].shape.box.size: 1 is a number; expected [x, y, z] (m)\n"
            "s.toml:6: bodies[0].mas: unknown key; the nearest known key is mass\n"
            "s.toml:7: bodies[0].position: is a list of 1; expected [x, y, z], or [x, y] for on the ground (m)\n"
            "s.toml:9: bodies[1].name: bodies[0] is called \"x\" too; expected a unique name\n"
            "s.toml:10: bodies[1].shape: \"sphere\" is text; expected shape = { sphere = { radius = 1.0 } }\n"
            "s.toml:11: bodies[1].mass: -3 is out of range; expected a number > 0 and <= 1e12 (kg)\n"
            "s.toml:13: bodies[1].above_ground: false with a position of two numbers; expected [x, y, z], or "
            "above_ground left out\n"
            "s.toml:14: bombs[0].position: is missing; expected [x, y, z], or [x, y] for on the ground (m)\n"
            "s.toml:15: bombs[0].time: -1 is out of range; expected a number >= 0 and <= 1e9 (s)\n"
            "s.toml:16: bombs[0].yield: 0 is out of range; expected a number > 0 and <= 1e8 (t of TNT)\n");
}

TEST(SceneErrors, OfMaterialsInACircle) {
  const std::string text = std::string(kGrid) +
                           "[materials.a]\nbase = \"b\"\n[materials.b]\nbase = \"c\"\n[materials.c]\nbase = \"b\"\n" +
                           "[materials.d]\nbase = \"d\"\n";
  EXPECT_EQ(errors_of(text),
            "s.toml:6: materials.b.base: goes in a circle: b -> c -> b; expected a chain of materials that ends at a "
            "preset\n"
            "s.toml:10: materials.d.base: goes in a circle: d -> d; expected a chain of materials that ends at a "
            "preset\n");
}

TEST(SceneErrors, OfSyntaxNameTheLine) {
  const Result<Scene> scene = parse_scene("duration = 1\n\nduration = 2\n", "s.toml");
  ASSERT_FALSE(scene);
  ASSERT_EQ(scene.error().size(), 1u);
  EXPECT_EQ(scene.error()[0].line, 3);
  EXPECT_NE(scene.error()[0].problem.find("duration"), std::string::npos);
}

TEST(SceneErrors, OfFilesAreOneLine) {
  const Result<Scene> missing = load_scene("no/such.toml");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error()[0].text(),
            "no/such.toml: cannot be read: No such file or directory; expected a scene file");
  EXPECT_EQ(load_scene(test::source_dir()).error()[0].problem, "is a folder");
}

TEST(SceneOverrides, ReachEveryPartOfAScene) {
  const std::vector<Override> overrides = {{"duration", "3"},
                                           {"gravity.2", "-3.5"},
                                           {"solver.blast", "scaled"},
                                           {"solver.integrator", "\"euler\""},
                                           {"solver.bvh_update.every", "4"},
                                           {"bodies.1.mass", "9"},
                                           {"bodies[0].name", "first"},
                                           {"bombs", "[]"},
                                           {"terrain", "{ grid = { columns = 5, rows = 6, spacing = 1 } }"},
                                           {"materials.mud.cohesion", "1"},
                                           {"output.formats", "[\"tif\"]"}};
  const Result<Scene> read = parse_scene(kFull, "s.toml", overrides);
  ASSERT_TRUE(read) << errors_of(kFull, overrides);
  EXPECT_EQ(read->duration, 3);
  EXPECT_EQ(read->gravity, (Vec3d{0.5, 0, -3.5}));
  EXPECT_EQ(read->solver.blast, Blast::scaled);
  EXPECT_EQ(read->solver.integrator, Integrator::euler);
  EXPECT_EQ(read->solver.bvh_update.steps, 4);
  EXPECT_EQ(read->bodies[1].mass, 9);
  EXPECT_EQ(read->bodies[0].name, "first");
  EXPECT_TRUE(read->bombs.empty());
  EXPECT_EQ(std::get<GridTerrain>(read->terrain.shape).rows, 6);
  EXPECT_EQ(read->terrain.material, "paper");
  EXPECT_EQ(read->output.formats, (std::vector<std::string>{"tif"}));
  // Tables are made on the way.
  const Result<Scene> bare = parse_scene("", "s.toml", {{"terrain.dem", "hill.tif"}, {"output.every", "0.5"}});
  ASSERT_TRUE(bare);
  EXPECT_EQ(std::get<DemTerrain>(bare->terrain.shape).path, "hill.tif");
  EXPECT_EQ(bare->output.every, 0.5);
}

TEST(SceneOverrides, NameThemselvesInErrors) {
  const struct {
    Override override;
    const char* error;
  } cases[] = {
      {{"bodies.0.mass", "-3"},
       "--set bodies.0.mass: bodies[0].mass: -3 is out of range; expected a number > 0 and <= 1e12 (kg)"},
      {{"bodies.2.mass", "1"}, "--set bodies.2.mass: bodies has no element 2; expected 0 to 1"},
      {{"bodies.mass", "1"}, "--set bodies.mass: bodies is a list; expected an index instead of \"mass\""},
      {{"solver.blats", "paper"}, "--set solver.blats: solver.blats: unknown key; the nearest known key is blast"},
      {{"terain.dem", "x"}, "--set terain.dem: terain: unknown key; the nearest known key is terrain"},
      {{"duration", "5s"}, "--set duration: duration: \"5s\" is text; expected a number > 0 and <= 1e9 (s)"},
      {{"duration", "1\ndt = 2"},
       "--set duration: duration: \"1\\u000adt = 2\" is text; expected a number > 0 and <= 1e9 (s)"},
      {{"duration.x", "5"}, "--set duration.x: duration: 5 is a number; expected a table or list there"},
      {{"terrain.grid", "{ columns = 2, rows = 2, spacing = 1 }"},
       "--set terrain.grid: terrain: holds grid and dem at once; expected one of them"},
      {{"", "1"}, "--set : not a key; expected a dotted path as solver.blast or bodies.0.mass"},
      {{"a..b", "1"}, "--set a..b: not a key; expected a dotted path as solver.blast or bodies.0.mass"},
      {{"terrain[0]", "1"}, "--set terrain[0]: terrain is not a list; expected a key instead of an index"},
      {{"duration", "\xff"}, "--set duration: Encountered invalid utf-8 sequence"},
  };
  for (const auto& wrong : cases) {
    const std::string errors = errors_of(kFull, {wrong.override});
    // A grid beside crs and band says so of these, too.
    EXPECT_EQ(errors.substr(0, errors.rfind('\n')), wrong.error) << wrong.override.key;
  }
  EXPECT_EQ(errors_of(kGrid, {{"bombs.0.yield", "1"}}),
            "--set bombs.0.yield: the scene has no list bombs; expected the whole of it, as bombs=[...]\n");
  // What an override made wrong is not blamed on the file's line.
  EXPECT_EQ(errors_of(kGrid, {{"terrain.grid.columns", "1000000"}}),
            "--set terrain.grid.columns: terrain.grid: 1000000 columns x 40 rows are 40000000 vertices; expected at "
            "most terrain.max_vertices, which is 20000000\n");
}

TEST(SceneCheck, FindsInCodeWhatItFindsInFiles) {
  Scene scene;
  EXPECT_TRUE(check(scene).empty());
  scene.dt = 0;
  scene.terrain.material = "cheese";
  scene.materials = {{.name = "a", .dissociation_energy = -1}, {.name = "a"}};
  scene.bodies = {{.name = "x", .mass = 0},
                  {.name = "x", .position = {0, 0, std::numeric_limits<double>::quiet_NaN()}}};
  scene.bombs = {{.yield = -5}};
  scene.solver.bvh_update = {UpdatePolicy::Kind::every, 0};
  scene.solver.blast = static_cast<Blast>(9);
  scene.output.formats = {"stl"};
  scene.terrain.shape = GridTerrain{.columns = 1};
  std::vector<std::string> keys;
  for (const Error& error : check(scene)) {
    keys.push_back(error.key);
    EXPECT_TRUE(error.file.empty());
  }
  EXPECT_EQ(keys,
            (std::vector<std::string>{"dt", "terrain.grid.columns", "materials.a.e0", "bodies[0].mass",
                                      "bodies[1].position", "bombs[0].yield", "solver.blast", "solver.bvh_update.every",
                                      "output.formats", "terrain.material", "materials.a", "bodies[1].name"}));
}

TEST(SceneDocs, PageHoldsTheRowsOfTheParser) {
  std::vector<std::string> rows, known;
  std::istringstream page(format_page());
  for (std::string line; std::getline(page, line);) {
    // Tables of keys; the one about coordinates has two columns.
    if (line.rfind("| `", 0) == 0 && std::count(line.begin(), line.end(), '|') == 6) rows.push_back(line);
  }
  for (const scene::KeyInfo& key : scene::scene_keys()) {
    known.push_back(
        fmt::format("| `{}` | {} | {} | {} | {} |", key.path, key.type, key.range, key.default_value, key.meaning));
  }
  ASSERT_EQ(rows.size(), known.size());
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k], known[k]);
}

TEST(SceneDocs, ExampleIsAScene) {
  const std::string page = format_page();
  const std::string open = "```toml\n";
  const auto begin = page.find(open);
  ASSERT_NE(begin, std::string::npos);
  const std::string example = page.substr(begin + open.size(), page.find("```", begin + 3) - begin - open.size());
  const Result<Scene> scene = parse_scene(example, "s.toml");
  ASSERT_TRUE(scene) << errors_of(example);
  EXPECT_EQ(scene->bodies.size(), 1u);
  EXPECT_EQ(scene->bombs.size(), 1u);
}

TEST(SceneRandom, DamagedFilesNeverGiveABadScene) {
  const std::string full = kFull;
  const std::string letters = "0123456789-+.e=[]{}\"'#,_ \nabckmnz\\\xff";
  std::mt19937 random(20080612);
  int good = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = full;
    for (unsigned change = random() % 2 + 1; change > 0; --change) {
      const std::size_t at = random() % text.size();
      const char letter = letters[random() % letters.size()];
      if (random() % 3 == 0) {
        text.erase(at, random() % 20 + 1);
      } else if (random() % 2 == 0) {
        text[at] = letter;
      } else {
        text.insert(at, 1, letter);
      }
    }
    const Result<Scene> scene = parse_scene(text, "s.toml");
    if (!scene) {
      ASSERT_FALSE(scene.error().empty());
      continue;
    }
    ++good;
    ASSERT_TRUE(check(*scene).empty()) << text;
  }
  EXPECT_GT(good, 50);
}

TEST(SceneNearest, CountsSlips) {
  EXPECT_EQ(scene::edit_distance("", "abc"), 3);
  EXPECT_EQ(scene::edit_distance("mass", "mass"), 0);
  EXPECT_EQ(scene::edit_distance("mas", "mass"), 1);
  EXPECT_EQ(scene::edit_distance("yeild", "yield"), 1);
  EXPECT_EQ(scene::edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(scene::nearest("blats", {"cohesion", "blast", "skin"}), "blast");
  EXPECT_EQ(scene::nearest("x", {}), "");
}

}  // namespace
}  // namespace divot
