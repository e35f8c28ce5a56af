#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/progress.h"
#include "divot/material.h"
#include "program.h"
#include "scene/keys.h"
#include "source_dir.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::line_count;
using test::Outcome;
using test::read_text;
using Files = std::vector<std::string>;

constexpr const char* kScene = R"(duration = 1.0
[terrain]
grid = { columns = 41, rows = 41, spacing = 0.5 }
material = "dry_sand"
[[bodies]]
name = "ball"
shape = { sphere = { radius = 1.0 } }
mass = 8000
position = [-4, 0]
velocity = [6, 0, 0]
[[bombs]]
time = 0.2
position = [3, 2]
yield = 0.001
)";

// Each test has a folder of its own, with a scene that runs in it.
class Cli : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              fmt::format("divot_cli_{}_{}", ::testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("ball.toml", kScene);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // The scene with one piece of text put in the place of another.
  void write_changed(const std::string& from, const std::string& to) const {
    std::string text = kScene;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    write("ball.toml", text.replace(at, from.size(), to));
  }
  Outcome divot(const std::vector<std::string>& arguments) const { return test::run_program(arguments, folder_); }
  json summary(const std::string& folder = "out/ball") const {
    return json::parse(read_text(folder_ / folder / "summary.json"));
  }
  Files files() const { return test::files_below(folder_); }

  // Exit status 2, one line that holds `words`, and no file beside those that were there.
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
    const Files before = files();
    const Outcome outcome = divot(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), before);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  // Both commands that read a scene.
  void expect_refused_scene(const std::vector<std::string>& words) const {
    expect_refused({"run", "ball.toml"}, words);
    expect_refused({"check", "ball.toml"}, words);
  }

  fs::path folder_;
};

// ---- usage

TEST_F(Cli, BareCommandPrintsHelp) {
  const Outcome outcome = divot({});
  EXPECT_EQ(outcome.status, 2);
  for (const char* command : {"run", "check", "materials", "render", "bench"})
    EXPECT_NE(outcome.err.find(command), std::string::npos);
}

TEST_F(Cli, HelpAndVersion) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"}, {"run", "--help"}, {"render", "--help"}, {"--version"}}) {
    const Outcome outcome = divot(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("divot"), std::string::npos);
  }
}

TEST_F(Cli, BadUsageIsOneLineWithAHint) {
  expect_refused({"rum", "ball.toml"}, {"rum", "divot --help"});
  expect_refused({"run"}, {"SCENE", "divot run --help"});
  expect_refused({"run", "ball.toml", "--speed", "3"}, {"--speed", "divot run --help"});
  expect_refused({"run", "ball.toml", "--threads", "0"}, {"--threads", "divot run --help"});
  expect_refused({"run", "ball.toml", "--threads", "many"}, {"--threads", "divot run --help"});
  expect_refused({"render", "ball.toml", "--size", "large"}, {"--size", "1280x720"});
  expect_refused({"render", "ball.toml", "--at", "1,soon"}, {"--at"});
}

TEST_F(Cli, BadSetIsOneLine) {
  expect_refused({"run", "ball.toml", "--set", "duration"}, {"--set", "duration", "key=value"});
  expect_refused({"run", "ball.toml", "--set", "duraton=2"}, {"duraton", "duration"});
  expect_refused({"run", "ball.toml", "--set", "bodies.7.mass=2"}, {"bodies", "7"});
  expect_refused({"run", "ball.toml", "--set", "bodies.0.mass=heavy"}, {"bodies.0.mass", "number"});
  expect_refused({"run", "ball.toml", "--duration", "-1"}, {"--duration: ", "-1"});
  expect_refused({"run", "ball.toml", "--duration", "long"}, {"--duration: ", "number"});
}

// ---- scenes and files that cannot be used

TEST_F(Cli, UnknownKey) {
  write_changed("mass = 8000", "mas = 8000\nmass = 8000");
  expect_refused_scene({"ball.toml:8: ", "mas", "mass"});
}

TEST_F(Cli, WrongType) {
  write_changed("mass = 8000", "mass = \"8000\"");
  expect_refused_scene({"ball.toml:8: ", "mass", "number"});
}

TEST_F(Cli, NegativeMass) {
  write_changed("mass = 8000", "mass = -3");
  expect_refused_scene({"ball.toml:8: ", "mass", "-3", "> 0"});
}

TEST_F(Cli, NotANumber) {
  write_changed("mass = 8000", "mass = nan");
  expect_refused_scene({"ball.toml:8: ", "mass", "nan"});
}

TEST_F(Cli, NoVertices) {
  write_changed("columns = 41, rows = 41", "columns = 0, rows = 41");
  expect_refused_scene({"ball.toml:3: ", "columns", "0", ">= 2"});
}

TEST_F(Cli, EveryProblemHasItsLine) {
  write_changed("mass = 8000", "mass = -3\nspeed = 2\nfriction = 1e9");
  const Outcome outcome = divot({"check", "ball.toml"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(line_count(outcome.err), 3u) << outcome.err;
  for (const char* place : {"ball.toml:8: ", "ball.toml:9: ", "ball.toml:10: "})
    EXPECT_NE(outcome.err.find(place), std::string::npos) << outcome.err;
}

TEST_F(Cli, MissingScene) {
  fs::remove(folder_ / "ball.toml");
  expect_refused_scene({"ball.toml: ", "No such file"});
}

TEST_F(Cli, MissingDem) {
  write_changed("grid = { columns = 41, rows = 41, spacing = 0.5 }", "dem = \"hill.tif\"");
  expect_refused_scene({"hill.tif"});
}

TEST_F(Cli, TextCalledTif) {
  write("hill.tif", "not a picture at all\n");
  write_changed("grid = { columns = 41, rows = 41, spacing = 0.5 }", "dem = \"hill.tif\"");
  expect_refused_scene({"hill.tif"});
}

TEST_F(Cli, TruncatedTif) {
  const std::string whole = read_text(fs::path(test::source_dir()) / "scenes/dem/olinda_dem_utm25s.tif");
  ASSERT_FALSE(whole.empty());
  write("hill.tif", whole.substr(0, whole.size() / 2));
  write_changed("grid = { columns = 41, rows = 41, spacing = 0.5 }", "dem = \"hill.tif\"");
  expect_refused_scene({"hill.tif"});
}

TEST_F(Cli, TooLargeTerrainIsRefusedBeforeItTakesMemory) {
  write_changed("columns = 41, rows = 41", "columns = 31623, rows = 31623");
  expect_refused_scene({"max_vertices"});
  const Outcome small = divot({"materials"}), large = divot({"check", "ball.toml"});
  EXPECT_LT(large.peak_kb, small.peak_kb + 100'000);
}

TEST_F(Cli, BodyBesideTheTerrainNamesTheScene) {
  write_changed("position = [-4, 0]", "position = [400, 0]");
  expect_refused_scene({"ball.toml: ", "400"});
}

// ---- check, materials

TEST_F(Cli, CheckSaysWhatTheSceneHolds) {
  const Outcome outcome = divot({"check", "ball.toml", "--set", "bombs=[]"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "ball.toml: ok (3200 triangles, 1 body, 0 bombs, 60 steps)\n");
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(files(), Files{"ball.toml"});
}

TEST_F(Cli, MaterialsListEveryKeyOfEveryPreset) {
  const json list = json::parse(divot({"materials", "--json"}).out);
  const std::string table = divot({"materials"}).out;
  ASSERT_EQ(list["materials"].size(), material_presets().size());
  const std::string prefix = "materials.NAME.";
  for (const scene::KeyInfo& key : scene::scene_keys()) {
    if (key.path.rfind(prefix, 0) != 0 || key.path == prefix + "base") continue;
    if (key.path.rfind(prefix + "over.", 0) == 0) continue;  // no preset is a crust
    const std::string name = key.path.substr(prefix.size());
    for (const json& material : list["materials"]) EXPECT_TRUE(material.contains(name)) << name;
    EXPECT_NE(table.find("\n" + name + " "), std::string::npos) << name;
    const std::size_t comma = key.type.find(", ");
    const std::string unit = comma == std::string::npos ? "" : key.type.substr(comma + 2);
    EXPECT_EQ(list["units"].value(name, ""), unit) << name;
  }
  EXPECT_EQ(list["materials"][0]["name"], "paper");
  EXPECT_EQ(list["materials"][0]["e0"], Material{}.dissociation_energy);
}

// ---- run

// Numbers anywhere in `value` are finite: JSON has no other, but null stands for them in some writers.
void expect_numbers(const json& value, const std::string& place) {
  EXPECT_FALSE(value.is_null()) << place;
  EXPECT_TRUE(!value.is_number() || std::isfinite(value.get<double>())) << place;
  if (!value.is_structured()) return;
  for (const auto& [key, inner] : value.items()) expect_numbers(inner, place + "." + key);
}

void expect_keys(const json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

TEST_F(Cli, SummaryHoldsEverythingPromised) {
  const Outcome outcome = divot({"run", "ball.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(files(), (Files{"ball.toml", "out/ball/bodies.csv", "out/ball/summary.json", "out/ball/terrain_final.ply",
                            "out/ball/terrain_final.tif"}));
  const json s = summary();
  expect_keys(s, {"scene", "simulated_s", "steps", "wall_s", "real_time_factor", "terrain", "particles", "bodies",
                  "craters", "stages", "updates", "volume", "state_hash", "flags", "interrupted"});
  expect_keys(s["terrain"], {"vertices", "triangles"});
  expect_keys(s["particles"], {"peak", "final"});
  ASSERT_EQ(s["bodies"].size(), 1u);
  expect_keys(s["bodies"][0], {"name", "position", "velocity", "heading_change_deg", "max_sinkage_m"});
  ASSERT_EQ(s["craters"].size(), 1u);
  expect_keys(s["craters"][0], {"x", "y", "yield_t", "width_m", "depth_m", "lip_height_m", "volume_m3", "lip_volume_m3",
                                "paper_width_m"});
  for (const char* stage :
       {"events", "contact", "activation", "neighbours", "forces", "integration", "settle", "refit"})
    expect_keys(s["stages"][stage], {"ms", "calls"});
  expect_keys(s["updates"], {"neighbour_rebuilds", "bvh_refits", "bvh_rebuilds", "missed_pairs"});
  expect_keys(s["volume"], {"displaced_m3", "compacted_m3", "deposited_m3", "relative_error"});
  expect_keys(s["flags"], {"substeps_limited", "not_finite"});
  expect_numbers(s, "summary");
  EXPECT_EQ(s["scene"], "ball");
  EXPECT_EQ(s["steps"], 60);
  EXPECT_NEAR(s["simulated_s"].get<double>(), 1, 1e-9);
  EXPECT_EQ(s["flags"]["not_finite"], 0);
  EXPECT_EQ(s["interrupted"], false);
}

TEST_F(Cli, PeopleReadWhatCameOfIt) {
  const std::string text = divot({"run", "ball.toml", "--out", "here"}).out;
  for (const char* words : {"ball: 1 s simulated", "x real time", "crater", "heading", "sank", "here"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST_F(Cli, WritesOnlyBelowOut) {
  ASSERT_EQ(divot({"run", "ball.toml", "--out", "a/b"}).status, 0);
  for (const std::string& file : files()) EXPECT_TRUE(file == "ball.toml" || file.rfind("a/b/", 0) == 0) << file;
}

TEST_F(Cli, FramesAndRowsComeAtTheirTimes) {
  ASSERT_EQ(divot({"run", "ball.toml", "--out", "o", "--set", "output.every=0.25", "--set",
                   "output.formats=[\"ply\", \"csv\"]"})
                .status,
            0);
  for (int k = 0; k < 5; ++k)
    for (const char* format : {"ply", "csv"})
      EXPECT_TRUE(fs::exists(folder_ / "o" / fmt::format("frame_{:06}.{}", k, format)));
  EXPECT_FALSE(fs::exists(folder_ / "o/frame_000005.ply"));
  EXPECT_EQ(line_count(read_text(folder_ / "o/bodies.csv")), 6u);
  EXPECT_EQ(line_count(read_text(folder_ / "o/frame_000004.csv")), 41u * 41 + 1);
  EXPECT_EQ(read_text(folder_ / "o/frame_000004.csv"), read_text(folder_ / "o/terrain_final.csv"));
}

TEST_F(Cli, BodiesHaveRowsWithoutFrames) {
  ASSERT_EQ(divot({"run", "ball.toml", "--out", "o"}).status, 0);
  const std::string rows = read_text(folder_ / "o/bodies.csv");
  EXPECT_EQ(line_count(rows), 12u) << rows;  // header, then 0 to 1 s by 0.1 s
  EXPECT_NE(rows.find("\n1,ball,"), std::string::npos) << rows;
}

TEST_F(Cli, DurationIsThatOfTheCommandLine) {
  ASSERT_EQ(divot({"run", "ball.toml", "--duration", "0.5"}).status, 0);
  EXPECT_EQ(summary()["steps"], 30);
}

TEST_F(Cli, SameBitsOnAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"1", "2", "3", "8"}) {
    ASSERT_EQ(divot({"run", "ball.toml", "--threads", threads, "--out", threads}).status, 0);
    const std::string hash = summary(threads)["state_hash"];
    EXPECT_EQ(hash.size(), 16u);
    if (first.empty()) first = hash;
    EXPECT_EQ(hash, first) << threads << " threads";
  }
}

TEST_F(Cli, SetChangesTheRun) {
  ASSERT_EQ(divot({"run", "ball.toml", "--out", "scaled"}).status, 0);
  ASSERT_EQ(divot({"run", "ball.toml", "--set", "solver.blast=\"paper\"", "--out", "quoted"}).status, 0);
  ASSERT_EQ(divot({"run", "ball.toml", "--set=solver.blast=paper", "--out", "plain"}).status, 0);
  ASSERT_EQ(divot({"run", "ball.toml", "--set", "bombs=[]", "--set", "bodies.0.mass=7000", "--out", "none"}).status, 0);
  EXPECT_NE(summary("quoted")["state_hash"], summary("scaled")["state_hash"]);
  EXPECT_EQ(summary("quoted")["state_hash"], summary("plain")["state_hash"]);
  EXPECT_EQ(summary("none")["craters"].size(), 0u);
}

TEST_F(Cli, NoProgressOffATerminalAndNothingWhenQuiet) {
  const Outcome outcome = divot({"run", "ball.toml", "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Cli, InterruptedRunKeepsWhatThereIs) {
  // Once it has written a frame, it is past its start on any machine.
  const Outcome outcome = test::run_program(
      {"run", "ball.toml", "--set", "duration=1e6", "--set", "output.every=1", "--set", "output.formats=[\"csv\"]"},
      folder_, {.due = [&] { return fs::exists(folder_ / "out/ball/frame_000002.csv"); }});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos);
  EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
  EXPECT_EQ(summary()["interrupted"], true);
  EXPECT_LT(summary()["simulated_s"], 1e6);
}

TEST_F(Cli, FolderThatCannotBeMadeFailsTheRun) {
  write("file", "");
  const Outcome outcome = divot({"run", "ball.toml", "--out", "file/inside"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("file/inside: cannot be written"), std::string::npos) << outcome.err;
}

// ---- render, bench

TEST_F(Cli, RenderDrawsAtTheTimesAskedFor) {
  const Outcome outcome = divot({"render", "ball.toml", "--out", "o", "--at", "0.5,0", "--size", "160x90", "--sheet"});
  if (!DIVOT_HAS_VIEWER) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("no renderer"), std::string::npos);
    return;
  }
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(files(), (Files{"ball.toml", "o/ball_sheet.png", "o/ball_t0000.000.png", "o/ball_t0000.500.png"}));
  EXPECT_EQ(read_text(folder_ / "o/ball_t0000.500.png").substr(1, 3), "PNG");
}

TEST_F(Cli, RenderRefusesWhatItCannotDraw) {
  if (!DIVOT_HAS_VIEWER) GTEST_SKIP() << "this build has no renderer";
  expect_refused({"render", "ball.toml", "--at", "3"}, {"--at", "3 s", "0 to 1 s"});
  expect_refused({"render", "ball.toml", "--at", "nan"}, {"--at", "nan"});
  expect_refused({"render", "ball.toml", "--size", "0x90"}, {"size", "0 x 90"});
}

TEST_F(Cli, UnknownBenchNamesTheKnownOnes) { expect_refused({"bench", "figure9"}, {"figure9", "figure1"}); }

TEST_F(Cli, FigureOneIsOf98ParticlesAndOneResult) {
  const Outcome outcome = divot({"bench", "figure1", "--json", "bench.json", "--out", "plots"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json bench = json::parse(read_text(folder_ / "bench.json"));
  expect_keys(bench, {"machine", "results"});
  ASSERT_EQ(bench["results"].size(), 3u);
  for (const json& result : bench["results"]) {
    expect_keys(result, {"name", "particles", "threads", "ms_per_step", "ns_per_particle_step", "real_time_factor",
                         "stages", "state_hash"});
    EXPECT_EQ(result["particles"], 98);
    expect_numbers(result, "result");
  }
  const json &every_step = bench["results"][0], &adaptive = bench["results"][2];
  EXPECT_EQ(adaptive["name"], "figure1/adaptive");
  EXPECT_EQ(adaptive["updates"]["missed_pairs"], 0);
  EXPECT_LT(adaptive["updates"]["neighbour_rebuilds"].get<int>(),
            every_step["updates"]["neighbour_rebuilds"].get<int>());
  for (const std::string& file : files())
    EXPECT_TRUE(file == "ball.toml" || file == "bench.json" || file.rfind("plots/", 0) == 0) << file;
}

// ---- progress

TEST(Progress, LineFitsTheTerminal) {
  for (int width = 0; width < 200; ++width)
    EXPECT_LE(cli::progress_line(3.2, 12, 0.4, width).size(), static_cast<std::size_t>(width));
}

TEST(Progress, LineSaysHowFarAndHowLong) {
  EXPECT_EQ(cli::progress_line(6, 12, 60, 51), "6.00 of 12 s, 0.10 x real time, 1:00 min left");
  EXPECT_EQ(cli::progress_line(6, 12, 60, 64), "[########        ] 6.00 of 12 s, 0.10 x real time, 1:00 min left");
  EXPECT_EQ(cli::progress_line(0, 12, 1, 30), "[               ] 0.00 of 12 s");
}

}  // namespace
}  // namespace divot
