#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include "program.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using test::line_count;
using test::Outcome;
using Files = std::vector<std::string>;

// A ball on sand, and a bomb.
constexpr const char* kScene = R"(duration = 1.0
[terrain]
grid = { columns = 41, rows = 41, spacing = 0.5 }
material = "dry_sand"
[[bodies]]
name = "ball"
shape = { sphere = { radius = 1.0 } }
mass = 8000
position = [-5, 0]
velocity = [8, 0, 0]
[[bombs]]
time = 0.2
position = [3, 2]
yield = 0.001
)";

// A picture read back: [channel][row * width + column].
struct Picture {
  int width = 0, height = 0;
  std::array<std::vector<std::uint8_t>, 3> channels;

  int at(int column, int row, std::size_t channel) const {
    return channels[channel][static_cast<std::size_t>(row * width + column)];
  }
};

Picture read_picture(const fs::path& path) {
  GDALAllRegister();
  const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str()));
  Picture picture;
  if (!file || file->GetRasterCount() != 3) return picture;
  picture.width = file->GetRasterXSize();
  picture.height = file->GetRasterYSize();
  for (int c = 0; c < 3; ++c) {
    auto& channel = picture.channels[static_cast<std::size_t>(c)];
    channel.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    EXPECT_EQ(file->GetRasterBand(c + 1)->RasterIO(GF_Read, 0, 0, picture.width, picture.height, channel.data(),
                                                   picture.width, picture.height, GDT_Byte, 0, 0),
              CE_None);
  }
  return picture;
}

struct Window {
  int left, top, right, bottom;
};

// Share of the pixels in `window` that differ by more than rounding.
double differing(const Picture& a, const Picture& b, const Window& window) {
  int count = 0;
  for (int row = window.top; row < window.bottom; ++row) {
    for (int column = window.left; column < window.right; ++column) {
      bool other = false;
      for (std::size_t c = 0; c < 3; ++c) other |= std::abs(a.at(column, row, c) - b.at(column, row, c)) > 8;
      count += other;
    }
  }
  return static_cast<double>(count) / ((window.right - window.left) * (window.bottom - window.top));
}

double differing(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height ? differing(a, b, {0, 0, a.width, a.height}) : 1;
}

// Of the brightness, which a blank picture has only one of.
int contrast(const Picture& picture) {
  if (picture.channels[1].empty()) return 0;
  const auto [least, most] = std::minmax_element(picture.channels[1].begin(), picture.channels[1].end());
  return *most - *least;
}

// Puts the variable back when it goes.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name), old_(std::getenv(name)) {
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { setenv(name_, old_.c_str(), 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string old_;
};

// Each test has a folder of its own, with a scene that is drawn in it.
class RenderCli : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!DIVOT_HAS_VIEWER) GTEST_SKIP() << "this build has no renderer";
    folder_ =
        fs::path(::testing::TempDir()) /
        fmt::format("divot_render_{}_{}", ::testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "ball.toml") << kScene;
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome render(std::vector<std::string> arguments, const std::string& out = "o") const {
    const Files always = {"render", "ball.toml", "--size", "320x180", "--out", out};
    arguments.insert(arguments.begin(), always.begin(), always.end());
    return test::run_program(arguments, folder_);
  }
  // The picture at one time.
  Picture picture(double time, std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--at", fmt::format("{}", time)});
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_picture(folder_ / fmt::format("o/ball_t{:08.3f}.png", time));
  }
  // Exit status 2, one line that holds `words`, and no file beside the scene.
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), Files{"ball.toml"});
  }
  // A program of that name which the tests find instead of the real one.
  std::string with_ffmpeg(const std::string& script) const {
    const fs::path bin = folder_ / "bin";
    fs::create_directories(bin);
    std::ofstream(bin / "ffmpeg") << "#!/bin/sh\n" << script;
    fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    return bin.string();
  }
  Files files() const { return test::files_below(folder_); }

  fs::path folder_;
};

TEST_F(RenderCli, PicturesAreNotBlankAndChangeWithTime) {
  const Picture before = picture(0, {}), after = picture(0.8, {});
  EXPECT_EQ(before.width, 320);
  EXPECT_EQ(before.height, 180);
  EXPECT_GT(contrast(before), 100);
  EXPECT_GT(differing(before, after), 0.02);
}

TEST_F(RenderCli, WireframeIsForAllPicturesOrForSome) {
  const Picture ground = picture(0.8, {}), lines = picture(0.8, {"--wireframe"});
  EXPECT_GT(contrast(lines), 100);
  EXPECT_GT(differing(ground, lines), 0.5);

  const Outcome outcome = render({"--at", "0.5,0.8", "--wireframe-at", "0.8"}, "some");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(differing(read_picture(folder_ / "some/ball_t0000.800.png"), lines), 0);
  EXPECT_LT(differing(read_picture(folder_ / "some/ball_t0000.500.png"), ground), 0.2);
  // And back to ground after lines.
  ASSERT_EQ(render({"--at", "0.5,0.8", "--wireframe-at", "0.5"}, "some").status, 0);
  EXPECT_EQ(differing(read_picture(folder_ / "some/ball_t0000.800.png"), ground), 0);
}

TEST_F(RenderCli, CameraMovesTheView) {
  const Picture usual = picture(0, {}), left = picture(0, {"--camera", "-9,-14,7,-5,0,1"}),
                wide = picture(0, {"--camera", "-9,-14,7,-5,0,1,70"}), above = picture(0, {"--camera", "0,0,30,0,0,0"});
  EXPECT_GT(differing(usual, left), 0.3);
  EXPECT_GT(differing(left, wide), 0.3);
  EXPECT_GT(differing(usual, above), 0.3);
  EXPECT_GT(contrast(above), 100);
}

// The middle of the picture shows the ball, whose looks change less than the ground would.
TEST_F(RenderCli, FollowKeepsTheBodyInTheMiddle) {
  const Window middle{148, 78, 172, 102};
  const Picture start = picture(0, {"--follow", "ball"}), later = picture(0.6, {"--follow", "ball"});
  EXPECT_LT(differing(start, later, middle), 0.6);
  // The ground goes by.
  EXPECT_GT(differing(start, later), 0.2);
  const Picture fixed = picture(0.6, {"--camera", "-5,-12,6,-5,0,1"});
  const Picture along = picture(0.6, {"--camera", "-5,-12,6,-5,0,1", "--follow", "ball"});
  EXPECT_GT(differing(fixed, along, middle), 0.6);
}

TEST_F(RenderCli, ColoursTellDifferentThings) {
  std::vector<Picture> pictures;
  for (const char* color : {"natural", "height", "sinkage", "slope", "awake", "material"}) {
    pictures.push_back(picture(0.4, {"--color", color}));
    EXPECT_GT(contrast(pictures.back()), 100) << color;
  }
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(differing(pictures[i], pictures[j]), 0.1) << i << " and " << j;
  // The legend stands in the upper right corner.
  const Window corner{250, 5, 315, 60};
  EXPECT_GT(differing(pictures[0], pictures[2], corner), 0.8);
}

TEST_F(RenderCli, SheetHasRoomForAllAndIsNoWiderThan4096) {
  ASSERT_EQ(render({"--sheet"}).status, 0);
  Picture sheet = read_picture(folder_ / "o/ball_sheet.png");
  EXPECT_EQ(sheet.width, 3 * 328 + 8);
  EXPECT_EQ(sheet.height, 2 * 188 + 8);
  EXPECT_EQ(sheet.at(20, 250, 0), 255);  // the second row stands in the middle
  EXPECT_LT(sheet.at(200, 360, 0), 255);
  ASSERT_EQ(render({"--sheet", "--size", "2000x50"}).status, 2);  // given twice
  const Outcome wide =
      test::run_program({"render", "ball.toml", "--size", "3000x60", "--out", "o", "--sheet"}, folder_);
  ASSERT_EQ(wide.status, 0) << wide.err;
  sheet = read_picture(folder_ / "o/ball_sheet.png");
  EXPECT_LE(sheet.width, 4096);
  EXPECT_GT(sheet.width, 4090);
  EXPECT_GT(contrast(sheet), 100);
}

TEST_F(RenderCli, SeriesIsCompleteAndNumbered) {
  const Outcome outcome = render({"--fps", "6"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  Files expected = {"ball.toml"};
  for (int k = 1; k <= 7; ++k) expected.push_back(fmt::format("o/frame_{:06}.png", k));
  EXPECT_EQ(files(), expected);
  EXPECT_EQ(outcome.out, "o/frame_000001.png to frame_000007.png\n");
  const Picture first = read_picture(folder_ / "o/frame_000001.png"),
                last = read_picture(folder_ / "o/frame_000007.png");
  EXPECT_EQ(differing(first, picture(0, {})), 0);
  EXPECT_EQ(differing(last, picture(1, {})), 0);
}

TEST_F(RenderCli, VideoIsMadeInTheFolder) {
  // Writes its last word where it is told to, as ffmpeg does.
  const Environment path("PATH", with_ffmpeg("for file; do :; done\n"
                                             "[ \"$file\" = -version ] || echo \"$@\" > \"$file\"\n"));
  const Outcome outcome = render({"--fps", "4", "--video", "films/run.mp4"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "o/frame_000001.png to frame_000005.png\no/films/run.mp4\n");
  const std::string words = test::read_text(folder_ / "o/films/run.mp4");
  for (const char* word : {"-framerate 4 ", "-frames:v 5 ", "-pix_fmt yuv420p", "-crf ", "frame_%06d.png"})
    EXPECT_NE(words.find(word), std::string::npos) << word << " in " << words;
  EXPECT_EQ(files().size(), 2u + 5u + 1u);  // the scene and the program, the pictures, the video
}

TEST_F(RenderCli, RealFfmpegMakesAVideo) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const Outcome outcome = render({"--fps", "10", "--video", "run.mp4"}, "50% of o:1");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string video = test::read_text(folder_ / "50% of o:1/run.mp4");
  EXPECT_EQ(video.substr(4, 4), "ftyp");
  EXPECT_GT(video.size(), 2000u);
}

TEST_F(RenderCli, WithoutFfmpegThePicturesStay) {
  const Environment path("PATH", (folder_ / "nothing").string());
  const Outcome outcome = render({"--fps", "2", "--video", "run.mp4"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "o/run.mp4: not made, as ffmpeg is not installed; drawing its numbered pictures\n");
  EXPECT_EQ(files(), (Files{"ball.toml", "o/frame_000001.png", "o/frame_000002.png", "o/frame_000003.png"}));
}

TEST_F(RenderCli, AVideoThatFailsLeavesNoHalf) {
  const Environment path("PATH", with_ffmpeg("for file; do :; done\n[ \"$file\" = -version ] && exit 0\n"
                                             "echo half > \"$file\"\necho no room >&2\nexit 1\n"));
  const Outcome outcome = render({"--fps", "1", "--video", "run.mp4"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("run.mp4: cannot be made: ffmpeg could not: no room"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), (Files{"ball.toml", "bin/ffmpeg", "o/frame_000001.png", "o/frame_000002.png"}));
}

TEST_F(RenderCli, BadValuesAreRefused) {
  expect_refused({"--camera", "1,2,3"}, {"--camera", "X,Y,Z,TX,TY,TZ"});
  expect_refused({"--camera", "1,2,3,4,5,six"}, {"--camera", "six"});
  expect_refused({"--camera", "1,2,3,1,2,3"}, {"--camera", "eye"});
  expect_refused({"--camera", "1,2,3,4,5,nan"}, {"camera"});
  expect_refused({"--camera", "1,2,3,4,5,6,121"}, {"camera", "121 degrees", "120"});
  expect_refused({"--follow", "cube"}, {"--follow", "cube", "ball"});
  expect_refused({"--color", "pink"}, {"--color", "pink", "sinkage"});
  expect_refused({"--color", "slope", "--wireframe"}, {"--color", "lines have no colours"});
  expect_refused({"--wireframe-at", "0.3"}, {"--wireframe-at", "0.3 s", "0, 0.25, 0.5"});
  expect_refused({"--wireframe", "--wireframe-at", "0"}, {"--wireframe-at", "excludes"});
  expect_refused({"--fps", "0"}, {"--fps: 0 is not above 0"});
  expect_refused({"--fps", "many"}, {"--fps", "many"});
  expect_refused({"--fps", "100000"}, {"--fps", "100000", "steps"});
  expect_refused({"--fps", "5", "--at", "0"}, {"--fps", "--at"});
  expect_refused({"--fps", "5", "--sheet"}, {"--fps", "--sheet"});
  expect_refused({"--video", "run.gif"}, {"--video", "run.gif", ".mp4"});
}

TEST_F(RenderCli, NothingIsWrittenOutsideOfTheFolder) {
  expect_refused({"--video", "../run.mp4"}, {"--video", "../run.mp4", "inside o"});
  expect_refused({"--video", "a/../../run.mp4"}, {"--video"});
  expect_refused({"--video", (folder_ / "run.mp4").string()}, {"--video"});
  fs::create_directories(folder_ / "o");
  fs::create_directory_symlink(folder_, folder_ / "o/link");
  expect_refused({"--video", "link/run.mp4"}, {"--video"});
}

}  // namespace
}  // namespace divot
