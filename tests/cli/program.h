#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace divot::test {

/// What a run of the program left behind.
struct Outcome {
  int status = -1;  ///< exit status; -1 where a signal ended it
  std::string out, err;
  long peak_kb = 0;  ///< most memory it held
};

/// A signal for a program that runs, sent once `due` says so.
struct Signal {
  int number = SIGINT;
  std::function<bool()> due;  ///< asked every 0.1 ms; empty: never
};

/// Runs `divot` with `arguments` in `folder`, its output going to no terminal.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                    const Signal& signal = {});

/// Everything in a file; empty where there is none.
std::string read_text(const std::filesystem::path& file);

/// Number of lines.
std::size_t line_count(const std::string& text);

/// Files below `folder`, relative to it, sorted.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace divot::test
