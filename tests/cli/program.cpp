#include "program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace divot::test {
namespace fs = std::filesystem;

namespace {

// In the child: never returns.
[[noreturn]] void become_program(std::vector<char*>& arguments, const char* folder, const char* out, const char* err) {
  const int to_out = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600),
            to_err = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const bool ready = dup2(to_out, STDOUT_FILENO) >= 0 && dup2(to_err, STDERR_FILENO) >= 0 && chdir(folder) == 0;
  if (ready) execv(arguments.front(), arguments.data());
  _exit(126);
}

// False where `child` ended before. It is left to be waited for.
bool runs_until(pid_t child, const std::function<bool()>& due) {
  while (!due()) {
    siginfo_t ended{};
    waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == child) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const fs::path& folder, const Signal& signal) {
  // Beside the folder, so that the folder holds only what the program left there.
  const std::string out = folder.string() + ".out", err = folder.string() + ".err";
  std::vector<std::string> words = {DIVOT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) become_program(pointers, folder.c_str(), out.c_str(), err.c_str());
  if (signal.due && runs_until(child, signal.due)) kill(child, signal.number);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  Outcome outcome{.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = read_text(out), .err = read_text(err)};
  outcome.peak_kb = used.ru_maxrss;
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace divot::test
