#include "cli/installed.h"

#include <filesystem>

namespace divot::cli {
namespace {

namespace fs = std::filesystem;

std::string folder(const std::string& asked, const char* installed_path, const char* source_path) {
  if (!asked.empty()) return asked;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path() / installed_path;
  return fs::is_directory(installed, ignored) ? fs::weakly_canonical(installed, ignored).string() : source_path;
}

}  // namespace

std::string scenes_folder(const std::string& asked) {
  return folder(asked, DIVOT_INSTALLED_DATA "/scenes", DIVOT_SOURCE_DIR "/scenes");
}
std::string data_folder(const std::string& asked) {
  return folder(asked, DIVOT_INSTALLED_DATA "/validation", DIVOT_SOURCE_DIR "/validation/data");
}

}  // namespace divot::cli
