#include "bench/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace divot::bench {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

#if defined(__clang__)
const std::string kCompiler = fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
const std::string kCompiler = "g++ " __VERSION__;
#endif

#if defined(__OPTIMIZE__)
constexpr const char* kBuild = "optimised";
#else
constexpr const char* kBuild = "not optimised";
#endif

}  // namespace

std::string machine() {
  return fmt::format("{}, {} cores, {}, {}", processor(), std::thread::hardware_concurrency(), kCompiler, kBuild);
}

}  // namespace divot::bench
