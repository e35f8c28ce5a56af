#include "cli/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <vector>

#include "output/atomic_file.h"

extern char** environ;

namespace divot::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kEndings = {".mp4", ".mkv", ".mov"};
constexpr const char* kQuality = "18";  // x264's constant rate factor: hardly told from the pictures

// What a program left behind.
struct Ended {
  int status = -1;   // exit status; -1: a signal ended it
  std::string said;  // on stderr
};

std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t size = 1; size > 0 || (size < 0 && errno == EINTR);) {
    size = read(pipe, piece.data(), piece.size());
    if (size > 0) text.append(piece.data(), static_cast<std::size_t>(size));
  }
  return text;
}

pid_t start(std::vector<std::string>& words, int err) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : -1;
}

// Runs ffmpeg and waits for it; nothing where it could not be started.
std::optional<Ended> run_ffmpeg(std::vector<std::string> words) {
  words.insert(words.begin(), "ffmpeg");
  std::array<int, 2> err{};
  if (pipe2(err.data(), O_CLOEXEC) != 0) return {};
  const pid_t child = start(words, err[1]);
  close(err[1]);
  Ended ended;
  if (child > 0) ended.said = read_all(err[0]);
  close(err[0]);
  if (child <= 0) return {};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) ended.status = WEXITSTATUS(status);
  return ended;
}

// ffmpeg reads file names as patterns.
std::string pattern(const std::string& folder) {
  std::string text;
  for (const char c : fs::absolute(folder).string()) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text + "/frame_%06d.png";
}

tl::unexpected<Errors> refusal(std::string problem, std::string expected) {
  return fail({.file = "--video", .problem = std::move(problem), .expected = std::move(expected)});
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string frame_name(std::size_t number) { return fmt::format("frame_{:06}.png", number); }

Result<std::string> video_path(const std::string& folder, const std::string& name) {
  const fs::path path = fs::path(folder) / name;
  if (std::find(kEndings.begin(), kEndings.end(), path.extension().string()) == kEndings.end()) {
    return refusal(fmt::format("\"{}\" is not the name of a video", name),
                   "expected one that ends in .mp4, .mkv or .mov");
  }
  // As the system will see them, through links and dots.
  std::error_code problem;
  const fs::path inside = fs::weakly_canonical(fs::absolute(path), problem)
                              .lexically_relative(fs::weakly_canonical(fs::absolute(folder), problem));
  if (problem || inside.empty() || *inside.begin() == "..") {
    return refusal(fmt::format("\"{}\" is not in the folder for pictures", name),
                   fmt::format("expected a name inside {}, or another --out", folder));
  }
  return path.string();
}

bool has_ffmpeg() {
  const auto ended = run_ffmpeg({"-version"});
  return ended && ended->status != 127;
}

Result<void> write_video(const std::string& folder, std::size_t count, double fps, const std::string& path) {
  const fs::path parent = fs::absolute(path).parent_path();
  if (const auto made = output::make_folder(parent.string()); !made) return made;
  // The ending stays last: ffmpeg goes by it.
  const fs::path part = parent / (fs::path(path).stem().string() + ".part" + fs::path(path).extension().string());
  const auto ended = run_ffmpeg({"-nostdin", "-y", "-loglevel", "error", "-framerate", fmt::format("{}", fps),
                                 "-start_number", "1", "-i", pattern(folder), "-frames:v", fmt::format("{}", count),
                                 // Colour at half the size needs even sides.
                                 "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-c:v", "libx264", "-crf", kQuality,
                                 "-pix_fmt", "yuv420p", part.string()});
  std::error_code problem;
  const bool made = ended && ended->status == 0;
  if (made) fs::rename(part, path, problem);
  if (made && !problem) return {};
  std::string why = "ffmpeg could not";
  if (made) why = problem.message();
  if (ended && !ended->said.empty()) why += ": " + first_line(ended->said);
  fs::remove(part, problem);
  return fail({.file = path, .problem = "cannot be made: " + why, .expected = "its numbered pictures are there"});
}

}  // namespace divot::cli
