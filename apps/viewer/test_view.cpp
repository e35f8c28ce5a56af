#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "divot/world.h"
#include "viewer/renderer.h"
#include "viewer/test_display.h"
#include "viewer/window.h"

// Asked by the leak checker of sanitized builds: Mesa 22.3 keeps memory of each context that it destroys.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so\nleak:libGLX"; }

namespace divot::viewer {
namespace {

// A plain on which nothing happens unless someone does it.
constexpr char kPlain[] = R"(
[terrain]
grid = { columns = 37, rows = 40, spacing = 10.9 }
)";
constexpr char kBall[] = R"(
[terrain]
grid = { columns = 37, rows = 40, spacing = 10.9 }
[[bodies]]
name = "ball"
shape = { sphere = { radius = 75.0 } }
mass = 45.0
position = [-150, 20, 76]
velocity = [30, 0, 0]
)";

constexpr long kFewPages = 64;  // of memory, 256 KiB

// Share of pixels beyond the numbers at the left and the line at the bottom for which `is` holds.
template <class Is>
double share(const Image& image, const Is& is) {
  int count = 0, all = 0;
  for (int row = 0; row < image.height - 40; ++row) {
    for (int column = 270; column < image.width; ++column, ++all) {
      const auto i = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + column);
      count += is(i) ? 1 : 0;
    }
  }
  return static_cast<double>(count) / all;
}

double differing(const Image& a, const Image& b, int tolerance) {
  return share(a, [&](std::size_t i) {
    int largest = 0;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a.rgb[i + k] - b.rgb[i + k]));
    return largest > tolerance;
  });
}

class View : public testing::Test {
 protected:
  TestDisplay display;
};

TEST_F(View, ClickMakesACrater) {
  ViewSession view(display, kPlain, {"--quality", "fast"});
  const Image before = view.picture();
  view.click(420, 220);
  sleep(2);
  const auto summary = nlohmann::json::parse(view.summary());
  ASSERT_EQ(summary["craters"].size(), 1u);
  EXPECT_GT(summary["craters"][0]["depth_m"].get<double>(), 1);
  EXPECT_GT(differing(before, view.picture(), 20), 0.01);
}

TEST_F(View, WireframeIsAnotherDrawing) {
  ViewSession view(display, kPlain, {"--quality", "fast"});
  const Image lit = view.picture();
  view.press("w");
  const Image lines = view.picture();
  const auto is_paper = [](const Image& image) {
    return [&image](std::size_t i) { return image.rgb[i] > 235 && image.rgb[i + 2] > 235; };
  };
  EXPECT_GT(share(lines, is_paper(lines)), 0.4);
  EXPECT_GT(differing(lit, lines, 20), 0.6);
  view.press("w");
  EXPECT_LT(differing(lit, view.picture(), 2), 0.001);
}

TEST_F(View, PausePausesAndStepSteps) {
  ViewSession view(display, kBall, {"--quality", "fast"});
  const auto time = [&] { return nlohmann::json::parse(view.summary())["simulated_s"].get<double>(); };
  view.press("p");
  const double paused = time();
  sleep(0.5);
  EXPECT_EQ(time(), paused);
  view.press("s");
  EXPECT_NEAR(time(), paused + 1.0 / 60, 1e-9);
  view.press("p");
  sleep(0.5);
  EXPECT_GT(time(), paused + 0.1);
  view.press("p");
  view.press("r");
  EXPECT_EQ(time(), 0);
}

TEST_F(View, BodyIsDroppedAtTheMouse) {
  ViewSession view(display, kPlain, {"--quality", "fast"});
  view.press("b");
  sleep(1);
  const auto bodies = nlohmann::json::parse(view.summary())["bodies"];
  ASSERT_EQ(bodies.size(), 1u);
}

TEST_F(View, WhatIsDoneInItCanBeDoneAgain) {
  const std::string file = testing::TempDir() + fmt::format("divot_session_{}.toml", getpid());
  nlohmann::json summary;
  {
    ViewSession view(display, kBall, {"--quality", "fast", "--record", file});
    view.click(420, 220);
    sleep(0.4);
    view.press("b");
    view.click(300, 260);
    sleep(0.4);
    view.press("p");
    summary = nlohmann::json::parse(view.summary());
    view.press("Escape");
    EXPECT_EQ(view.process().wait(20), 0);
  }
  const auto session = read_recording(file);
  ASSERT_TRUE(session) << session.error().front().text();
  EXPECT_EQ(session->commands.size(), 3u);
  EXPECT_EQ(session->steps, summary["steps"]);
  auto world = World::create(*parse_scene(kBall, "test.toml"));
  EXPECT_EQ(session->fingerprint, world->scene_fingerprint());
  std::size_t next = 0;
  while (world->steps() < session->steps) {
    for (; next < session->commands.size() && session->commands[next].step == world->steps(); ++next)
      ASSERT_TRUE(world->carry_out(session->commands[next]));
    world->step();
  }
  EXPECT_EQ(fmt::format("{:016x}", world->state_hash()), summary["state_hash"]);
  std::filesystem::remove(file);
}

TEST_F(View, CameraTurnsMovesAndComesCloser) {
  ViewSession view(display, kPlain, {"--quality", "fast"});
  Image last = view.picture();
  const auto changed = [&] {
    const Image now = view.picture();
    const double changes = differing(last, now, 10);
    last = now;
    return changes;
  };
  view.drag(400, 200, 500, 220, 1);
  EXPECT_GT(changed(), 0.05);
  view.drag(400, 200, 480, 240, 3);
  EXPECT_GT(changed(), 0.05);
  view.scroll(4);
  EXPECT_GT(changed(), 0.05);
  // No bomb came of it.
  EXPECT_TRUE(nlohmann::json::parse(view.summary())["craters"].empty());
}

TEST_F(View, ColoursAndParticlesShow) {
  ViewSession view(display, kBall, {"--quality", "fast"});
  sleep(1);
  view.press("p");
  Image last = view.picture();
  for (const char* key : {"c", "c", "c", "c", "c", "o", "h", "g"}) {
    view.press(key);
    const Image now = view.picture();
    EXPECT_GT(differing(last, now, 2), 0.0005) << key;
    last = now;
  }
}

// Pixels of the line of tools that differ.
int differing_tools(const Image& a, const Image& b) {
  const std::size_t from = 3 * static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height - 40);
  int count = 0;
  for (std::size_t i = from; i < a.rgb.size(); i += 3) count += std::abs(a.rgb[i] - b.rgb[i]) > 40;
  return count;
}

// One window for all keys that no other test presses.
TEST_F(View, KeysDoWhatTheHelpSays) {
  ViewSession view(display, kBall, {"--quality", "fast"});
  const auto summary = [&] { return nlohmann::json::parse(view.summary()); };
  const auto time = [&] { return summary()["simulated_s"].get<double>(); };
  view.press("space");
  Image last = view.picture();
  const auto tools_change = [&](const char* key) {
    view.press(key);
    const Image now = view.picture();
    const int changed = differing_tools(last, now);
    last = now;
    EXPECT_GT(changed, 30) << key;
  };
  const double paused = time();
  view.press("Right");
  EXPECT_NEAR(time(), paused + 1.0 / 60, 1e-9);
  view.press("v");
  const Image boxes = view.picture();
  EXPECT_GT(differing(last, boxes, 20), 0.001) << "boxes";
  last = boxes;
  for (const char* key : {"plus", "minus", "minus", "Tab", "f", "f"}) tools_change(key);
  // What was chosen is what is thrown: half of 10 kt.
  view.click(420, 220);
  view.press("b");
  view.press("Right");
  const auto thrown = summary();
  ASSERT_EQ(thrown["craters"].size(), 1u);
  EXPECT_EQ(thrown["craters"][0]["yield_t"].get<double>(), 5000);
  ASSERT_EQ(thrown["bodies"].size(), 2u);
  EXPECT_EQ(thrown["bodies"][1]["name"].get<std::string>(), "boulder 2");
  view.press("m");
  view.press("m");
  const double before = time();
  view.press("space");
  sleep(2);
  view.press("space");
  const double passed = time() - before;
  EXPECT_GT(passed, 0);
  EXPECT_LT(passed, 1) << "a sixteenth of real time";
  view.press("q");
  EXPECT_EQ(view.process().wait(20), 0);
}

TEST_F(View, ResizeIsFollowed) {
  ViewSession view(display, kPlain, {"--quality", "fast"});
  view.resize(800, 500);
  sleep(1);
  const Image image = view.picture();
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, 500);
}

TEST_F(View, EndsByKeyAndByClosing) {
  {
    ViewSession view(display, kPlain, {"--quality", "fast"});
    view.press("Escape");
    EXPECT_EQ(view.process().wait(20), 0);
  }
  ViewSession view(display, kPlain, {"--quality", "fast"});
  view.close();
  EXPECT_EQ(view.process().wait(20), 0);
}

TEST_F(View, MemoryDoesNotGrow) {
  ViewSession view(display, kBall, {"--quality", "fast"});
  const auto resident_pages = [&] {
    std::ifstream file("/proc/" + std::to_string(view.process().id()) + "/statm");
    long all = 0, resident = 0;
    file >> all >> resident;
    return resident;
  };
  const auto play = [&] {
    for (int i = 0; i < 6; ++i) {
      view.click(300 + 40 * i, 200);
      sleep(0.5);
      view.press("r");
    }
  };
  // How soon caches and pools are full depends on how busy the machine is. What leaks grows in every round.
  long smallest = std::numeric_limits<long>::max(), before = resident_pages();
  for (int round = 0; round < 8 && smallest > kFewPages; ++round) {
    play();
    const long now = resident_pages();
    smallest = std::min(smallest, now - before);
    before = now;
  }
  EXPECT_LE(smallest, kFewPages) << "pages of 4 KiB more in each round";
}

// Without a display, so that each byte in use can be counted: bombs, bodies, restarts, pictures. A minute of the
// window's pictures; DIVOT_SOAK=10 makes it ten.
TEST(ViewMemory, IsTheSameAfterEveryRestart) {
  auto window = Window::create_offscreen(parse_scene(kBall, "ball.toml").value(), std::make_shared<const Jobs>(1),
                                         {.width = 160, .height = 100});
  ASSERT_TRUE(window) << window.error().front().text();
  const auto play = [&] {
    for (int i = 0; i < 120; ++i) {
      if (i % 20 == 0) window->click(0.1 * (i / 20) - 0.2, 0.05);
      window->frame_after(1.0 / 60);
    }
    ASSERT_FALSE(window->capture().rgb.empty());
    window->restart();
    for (int i = 0; i < 5; ++i) window->frame_after(1.0 / 60);
  };
  const auto in_use = [] {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
  };
  const char* asked = std::getenv("DIVOT_SOAK");
  const int rounds = 10 * std::max(1, asked == nullptr ? 1 : std::atoi(asked));
  for (int i = 0; i < 5; ++i) play();
  const double before = in_use();
  for (int i = 0; i < rounds; ++i) play();
  const double grown = in_use() - before;
  RecordProperty("grown_bytes", std::to_string(grown));
  EXPECT_LT(grown, 2e3 * rounds) << "of " << before << " bytes";
}

TEST(ViewWithoutDisplay, SaysWhatIsMissing) {
  const auto folder = std::filesystem::temp_directory_path() / "divot_view_without";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "plain.toml") << kPlain;
  for (const char* display : {"DISPLAY", "DISPLAY=:4711"}) {
    Process view({DIVOT_PROGRAM, "view", "plain.toml"}, {display}, folder, folder / "log");
    EXPECT_EQ(view.wait(60), 2);
    std::ifstream log(folder / "log");
    std::string line, more;
    std::getline(log, line);
    EXPECT_NE(line.find("no display"), std::string::npos) << line;
    EXPECT_NE(line.find("divot render"), std::string::npos) << line;
    EXPECT_FALSE(std::getline(log, more)) << more;
  }
  std::filesystem::remove_all(folder);
}

// The same world drawn by GLX in a window and by EGL without one.
class SamePicture : public View, public testing::WithParamInterface<Quality> {};

TEST_P(SamePicture, InAWindowAndWithoutOne) {
  setenv("DISPLAY", display.name().c_str(), 1);
  const Scene scene = parse_scene(kBall, "ball.toml").value();
  const auto jobs = std::make_shared<const Jobs>(1);
  auto window = Window::create(scene, jobs,
                               {.width = 480,
                                .height = 320,
                                .quality = GetParam(),
                                .fast_share = 1,
                                .paused = true,
                                .show_numbers = false,
                                .effects = false});
  ASSERT_TRUE(window) << window.error().front().text();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(window->frame());
  const Image shown = window->capture();

  World world = World::create(scene, jobs).value();
  auto renderer = Renderer::create({.width = 480, .height = 320, .quality = GetParam(), .camera = window->camera()});
  ASSERT_TRUE(renderer) << renderer.error().front().text();
  renderer->update(world);
  const Image drawn = renderer->pixels().value();
  ASSERT_EQ(shown.width, drawn.width);
  ASSERT_EQ(shown.height, drawn.height);
  int largest = 0;
  for (std::size_t i = 0; i < shown.rgb.size(); ++i) largest = std::max(largest, std::abs(shown.rgb[i] - drawn.rgb[i]));
  EXPECT_LE(largest, 2);
}

Image fast_picture(double share) {
  const Scene scene = parse_scene(kBall, "ball.toml").value();
  const WindowOptions options{.width = 640, .height = 360, .fast_share = share, .paused = true};
  auto window = Window::create_offscreen(scene, std::make_shared<const Jobs>(1), options);
  EXPECT_TRUE(window) << window.error().front().text();
  window->frame_after(0);
  return window->capture();
}

// The scene is drawn with fewer pixels; numbers over it are not.
TEST(ViewFast, IsStretchedOverTheSamePlaces) {
  const Image whole = fast_picture(1), stretched = fast_picture(0.75), coarse = fast_picture(0.125);
  ASSERT_EQ(whole.rgb.size(), stretched.rgb.size());
  EXPECT_GT(differing(whole, stretched, 2), 0.01);
  EXPECT_LT(differing(whole, stretched, 24), 0.02);
  EXPECT_GT(differing(whole, coarse, 24), 2 * differing(whole, stretched, 24));
}

// All of the ground, not only what moves from then on.
TEST(ViewRestart, ShowsTheGroundAsItWas) {
  const Scene scene = parse_scene(kPlain, "plain.toml").value();
  auto window = Window::create_offscreen(scene, std::make_shared<const Jobs>(1),
                                         {.width = 480, .height = 300, .fast_share = 1, .effects = false});
  ASSERT_TRUE(window) << window.error().front().text();
  window->frame_after(0);
  const Image start = window->capture();
  window->click(0.2, 0.1);
  for (int i = 0; i < 60; ++i) window->frame_after(1.0 / 60);
  EXPECT_GT(differing(start, window->capture(), 20), 0.02);
  window->restart();
  window->frame_after(0);
  EXPECT_EQ(differing(start, window->capture(), 2), 0);
}

TEST(ViewFast, ShareIsChecked) {
  const Scene scene = parse_scene(kPlain, "plain.toml").value();
  for (const double share : {0.0, 1.01, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto window = Window::create_offscreen(scene, std::make_shared<const Jobs>(1), {.fast_share = share});
    ASSERT_FALSE(window) << share;
    EXPECT_EQ(window.error().front().key, "fast_share");
  }
}

INSTANTIATE_TEST_SUITE_P(Qualities, SamePicture, testing::Values(Quality::fast, Quality::fine));

}  // namespace
}  // namespace divot::viewer
