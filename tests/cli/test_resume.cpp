// A run that is put aside goes on as if it had never stopped, however it was cut.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "program.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::read_text;

constexpr const char* kScene = R"(duration = 6.0
[terrain]
grid = { columns = 81, rows = 81, spacing = 0.25 }
material = "dry_sand"
[[bodies]]
name = "ball"
shape = { sphere = { radius = 1.0 } }
mass = 8000
position = [-6, 0]
velocity = [4, 0, 0]
[[bodies]]
name = "box"
shape = { box = { size = [1, 1, 1] } }
mass = 900
position = [-6, 0, 2.1]
above_ground = true
[[bombs]]
time = 1.0
position = [3, 2]
yield = 0.001
[output]
every = 0.5
formats = ["ply", "vtp"]
)";

class Resume : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(::testing::TempDir()) /
        fmt::format("divot_resume_{}_{}", ::testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "scene.toml") << kScene;
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome divot(const std::vector<std::string>& arguments, const std::function<bool()>& killed_when = {}) const {
    return test::run_program(arguments, folder_, {.number = SIGKILL, .due = killed_when});
  }
  std::string text(const std::string& file) const { return read_text(folder_ / file); }
  json summary(const std::string& out) const { return json::parse(text(out + "/summary.json")); }

  // Everything but times and the checkpoint itself.
  void expect_same_results(const std::string& a, const std::string& b) const {
    std::vector<std::string> files = test::files_below(folder_ / a);
    std::erase(files, "checkpoint.divot");
    std::vector<std::string> others = test::files_below(folder_ / b);
    std::erase(others, "checkpoint.divot");
    EXPECT_EQ(files, others);
    std::erase(files, "summary.json");
    for (const std::string& file : files) EXPECT_TRUE(text(a + "/" + file) == text(b + "/" + file)) << file;
    json one = summary(a), other = summary(b);
    for (json* s : {&one, &other})
      for (const char* key : {"wall_s", "real_time_factor", "stages", "updates"}) s->erase(key);
    EXPECT_EQ(one, other);
  }

  fs::path folder_;
};

// Says true once `file` has been replaced `times` (0: never), and `rest` has passed since. Machines differ: a clock
// alone would cut some runs before their first checkpoint and others never.
std::function<bool()> once_replaced(const fs::path& file, int times, std::chrono::microseconds rest) {
  using Clock = std::chrono::steady_clock;
  const auto identity = [file] {
    struct stat found {};
    return stat(file.c_str(), &found) == 0 ? std::optional(std::pair(found.st_ino, found.st_mtim.tv_nsec))
                                           : std::nullopt;
  };
  return [=, last = identity(), left = times, due = Clock::time_point::max()]() mutable {
    const auto now = identity();
    if (left > 0 && now != last && --left == 0) due = Clock::now() + rest;
    last = now;
    return Clock::now() >= due;
  };
}

TEST_F(Resume, KilledAgainAndAgainItEndsAsIfItHadRunThrough) {
  ASSERT_EQ(divot({"run", "scene.toml", "--out", "through", "--quiet"}).status, 0);
  std::mt19937 random(11);
  std::vector<std::string> next = {"run", "scene.toml", "--out", "cut", "--checkpoint-every", "0.05", "--quiet"};
  constexpr int kKills = 20;
  int kills = 0;
  for (;; ++kills) {
    const int times = kills < kKills ? static_cast<int>(1 + random() % 2) : 0;
    const std::chrono::microseconds rest(random() % 4000);
    const Outcome outcome = divot(next, once_replaced(folder_ / "cut/checkpoint.divot", times, rest));
    if (outcome.status == 0) break;
    ASSERT_EQ(outcome.status, -1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "cut/summary.json"));
    EXPECT_FALSE(fs::exists(folder_ / "cut/bodies.csv"));
    ASSERT_TRUE(fs::exists(folder_ / "cut/checkpoint.divot"));
    next = {"run", "--resume", "cut/checkpoint.divot", "--checkpoint-every", "0.05", "--quiet", "--threads", "2"};
  }
  EXPECT_EQ(kills, kKills);
  // What a kill left half written is no result.
  for (const std::string& file : test::files_below(folder_ / "cut"))
    if (file.ends_with(".part")) fs::remove(folder_ / "cut" / file);
  expect_same_results("through", "cut");
}

TEST_F(Resume, AnInterruptedRunGoesOnElsewhereAndForLonger) {
  ASSERT_EQ(divot({"run", "scene.toml", "--out", "through", "--quiet", "--duration", "8"}).status, 0);
  ASSERT_EQ(
      divot({"run", "scene.toml", "--out", "first", "--quiet", "--checkpoint-every", "2", "--duration", "4"}).status,
      0);
  const Outcome outcome =
      divot({"run", "--resume", "first/checkpoint.divot", "--out", "second", "--duration", "8", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary("second")["state_hash"], summary("through")["state_hash"]);
  EXPECT_EQ(summary("second")["steps"], 480);
  EXPECT_EQ(text("second/bodies.csv"), text("through/bodies.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "second/frame_000016.ply"));
  EXPECT_FALSE(fs::exists(folder_ / "second/frame_000004.ply"));
}

TEST_F(Resume, SaysWhatIsWrongWithACheckpoint) {
  ASSERT_EQ(divot({"run", "scene.toml", "--out", "o", "--quiet", "--checkpoint-every", "1", "--duration", "2"}).status,
            0);
  const std::string whole = text("o/checkpoint.divot");
  const auto expect_refusal = [&](const std::string& bytes, const std::string& words) {
    std::ofstream(folder_ / "bad.divot", std::ios::binary) << bytes;
    const Outcome outcome = divot({"run", "--resume", "bad.divot", "--out", "never"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(test::line_count(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("bad.divot: " + words), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "never"));
  };
  std::string changed = whole, earlier = whole, later = whole;
  changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 4);
  later[16] = 9;
  earlier[16] = 1;
  expect_refusal("", "is no checkpoint; expected a checkpoint of divot");
  expect_refusal("solid something\n", "is no checkpoint");
  expect_refusal(whole.substr(0, 20), "has 20 bytes; it was cut short");
  expect_refusal(whole.substr(0, whole.size() - 1), fmt::format("has {} bytes", whole.size() - 1));
  expect_refusal(changed, "is damaged");
  expect_refusal(earlier, "is a checkpoint of version 1; this divot reads version 2: run the scene from its start");
  expect_refusal(later, "is a checkpoint of version 9; this divot reads version 2");

  const Outcome missing = divot({"run", "--resume", "none.divot"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err, "none.divot: cannot be read: No such file or directory; expected a checkpoint of divot\n");
}

TEST_F(Resume, TheSceneMustBeTheSame) {
  ASSERT_EQ(divot({"run", "scene.toml", "--out", "o", "--quiet", "--checkpoint-every", "1", "--duration", "2"}).status,
            0);
  const auto expect_refusal = [&](const std::vector<std::string>& more, const std::string& words) {
    std::vector<std::string> arguments = {"run", "--resume", "o/checkpoint.divot", "--out", "never"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = divot(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(test::line_count(outcome.err), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  expect_refusal(
      {"--set", "bodies.0.mass=1"},
      "o/checkpoint.divot: the scene is not the one whose world was saved; only duration and output may differ");
  fs::rename(folder_ / "scene.toml", folder_ / "moved.toml");
  expect_refusal({}, "scene.toml");
  EXPECT_EQ(divot({"run", "moved.toml", "--resume", "o/checkpoint.divot", "--out", "moved", "--quiet"}).status, 0);
  EXPECT_EQ(summary("moved")["state_hash"], summary("o")["state_hash"]);
}

TEST_F(Resume, ARecordedSessionIsCarriedOutAgainAlsoAfterItWasCut) {
  std::ofstream(folder_ / "session.toml")
      << "scene = \"scene.toml\"\nsteps = 300\n"
         "[[commands]]\nstep = 50\nbomb = { position = [1, 1], yield = 0.002 }\n"
         "[[commands]]\nstep = 200\nbody = { name = \"late\", mass = 500, position = "
         "[2, 0, 3], shape = { sphere = { radius = 0.5 } } }\n";
  ASSERT_EQ(divot({"run", "--replay", "session.toml", "--out", "whole", "--quiet"}).status, 0);
  const json whole = summary("whole");
  EXPECT_EQ(whole["steps"], 300);
  EXPECT_EQ(whole["craters"].size(), 2u);
  EXPECT_EQ(whole["bodies"].back()["name"], "late");
  ASSERT_EQ(divot({"run", "--replay", "session.toml", "--out", "half", "--quiet", "--duration", "2",
                   "--checkpoint-every", "2"})
                .status,
            0);
  const Outcome rest = divot({"run", "--resume", "half/checkpoint.divot", "--duration", "5", "--quiet"});
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_EQ(summary("half")["state_hash"], whole["state_hash"]);

  std::ofstream(folder_ / "session.toml", std::ios::app)
      << "[[commands]]\nstep = 201\nbomb = { position = [9999, 1], yield = 0.002 }\n";
  const Outcome off = divot({"run", "--replay", "session.toml", "--out", "off", "--quiet"});
  EXPECT_EQ(off.status, 2);
  EXPECT_NE(off.err.find("session.toml: commands[2].bombs: there is no ground below (9999, 1)"), std::string::npos)
      << off.err;
  EXPECT_FALSE(fs::exists(folder_ / "off/summary.json"));
}

TEST_F(Resume, WantsAScene) {
  const Outcome outcome = divot({"run"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("SCENE is required"), std::string::npos) << outcome.err;
  const Outcome never = divot({"run", "scene.toml", "--checkpoint-every", "0"});
  EXPECT_EQ(never.status, 2);
  EXPECT_NE(never.err.find("--checkpoint-every: 0 is not above 0"), std::string::npos) << never.err;
}

}  // namespace
}  // namespace divot
