#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace divot::test {

/// What a run of the program left behind.
struct Outcome {
  int status = -1;  ///< exit status; -1 where a signal ended it
  std::string out, err;
  long peak_kb = 0;  ///< most memory it held
};

/// Runs `divot` with `arguments` in `folder`, its output going to no terminal. `signal_after_ms` > 0: sends `signal`
/// then.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                    int signal_after_ms = 0, int signal = SIGINT);

/// Everything in a file; empty where there is none.
std::string read_text(const std::filesystem::path& file);

/// Number of lines.
std::size_t line_count(const std::string& text);

/// Files below `folder`, relative to it, sorted.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace divot::test
