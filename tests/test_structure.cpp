// The rules that keep the parts apart, held against the source tree itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "source_dir.h"
#include "world/state.h"

namespace divot {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = test::source_dir();
const std::set<std::string> kStages(std::begin(kStageNames), std::end(kStageNames));
// What every folder may include beside its own files.
const std::set<std::string> kShared = {"core", "math", "geometry", "state", "laws", "divot"};

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

// Files below a folder of the tree, sorted.
std::vector<fs::path> files_below(const std::string& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// What a file includes, without brackets or quotes.
std::vector<std::string> includes(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> names;
  std::smatch match;
  for (const std::string& line : lines(read(file)))
    if (std::regex_search(line, match, kInclude)) names.push_back(match[1]);
  return names;
}

// The first part of an included path: the folder, for files of ours.
std::string folder_of(const std::string& include) { return include.substr(0, include.find('/')); }

bool is_source_folder(const std::string& name) { return fs::is_directory(kRoot / "src" / name); }

TEST(Structure, StagesIncludeOnlyWhatIsShared) {
  for (const std::string& stage : kStages) {
    ASSERT_FALSE(files_below("src/" + stage).empty()) << stage;
    for (const fs::path& file : files_below("src/" + stage))
      for (const std::string& include : includes(file))
        EXPECT_TRUE(folder_of(include) == stage || kShared.contains(folder_of(include)) ||
                    !is_source_folder(folder_of(include)))
            << file << " includes " << include;
  }
}

TEST(Structure, OnlyTheWorldIncludesStages) {
  for (const fs::path& file : files_below("src")) {
    const std::string own = fs::relative(file, kRoot / "src").begin()->string();
    if (own == "world" || kStages.contains(own)) continue;
    for (const std::string& include : includes(file)) {
      EXPECT_FALSE(kStages.contains(folder_of(include))) << file << " includes " << include;
      EXPECT_NE(folder_of(include), "world") << file;
    }
  }
}

TEST(Structure, ToolsKnowNothingOfTheSimulation) {
  for (const std::string own : {"core", "math", "geometry"})
    for (const fs::path& file : files_below("src/" + own))
      for (const std::string& include : includes(file))
        EXPECT_TRUE(!is_source_folder(folder_of(include)) ||
                    std::set<std::string>({"core", "math", "geometry"}).contains(folder_of(include)))
            << file << " includes " << include;
}

TEST(Structure, OnlyTheViewerIncludesOpenSceneGraph) {
  for (const std::string folder : {"include", "src", "apps/cli", "tests", "bench", "validation"})
    for (const fs::path& file : files_below(folder))
      for (const std::string& include : includes(file)) EXPECT_FALSE(include.starts_with("osg")) << file;
}

// What is validated is what users get.
TEST(Structure, ValidationKnowsOnlyThePublicInterface) {
  for (const fs::path& file : files_below("validation"))
    for (const std::string& include : includes(file)) EXPECT_FALSE(is_source_folder(folder_of(include))) << file;
}

TEST(Structure, PublicHeadersIncludeOnlyPublicHeaders) {
  for (const fs::path& file : files_below("include"))
    for (const std::string& include : includes(file))
      EXPECT_FALSE(is_source_folder(folder_of(include))) << file << " includes " << include;
}

TEST(Structure, PublicHeadersHaveNoConditions) {
  static const std::regex kCondition(R"(^\s*#\s*(if|ifdef|ifndef|elif|else)\b)");
  for (const fs::path& file : files_below("include"))
    for (const std::string& line : lines(read(file))) EXPECT_FALSE(std::regex_search(line, kCondition)) << file;
}

TEST(Structure, WorldStepFitsAScreen) {
  const std::vector<std::string> code = lines(read(kRoot / "src/world/step.cpp"));
  const auto first = std::find(code.begin(), code.end(), "StepReport World::step() {");
  ASSERT_NE(first, code.end());
  const auto last = std::find(first, code.end(), "}");
  ASSERT_NE(last, code.end());
  EXPECT_LE(last - first + 1, 40);
}

TEST(Structure, AStageHasOneNameEverywhere) {
  const std::vector<std::string> page = lines(read(kRoot / "docs/architecture.md"));
  ASSERT_EQ(kStages.size(), static_cast<std::size_t>(Stage::count));
  for (const std::string& stage : kStages) {
    EXPECT_TRUE(fs::is_directory(kRoot / "src" / stage)) << stage;
    EXPECT_TRUE(fs::exists(kRoot / "tests" / ("test_" + stage + ".cpp"))) << stage << " has no test file";
    EXPECT_TRUE(std::find(page.begin(), page.end(), "## " + stage) != page.end())
        << "docs/architecture.md has no heading '## " << stage << "'";
    for (const fs::path& file : files_below("src/" + stage))
      EXPECT_NE(read(file).find("namespace divot::" + stage), std::string::npos) << file;
  }
}

TEST(Structure, NothingPointsIntoTheMachineItWasBuiltOn) {
  // Not as part of a longer path, as in "out/tmp/".
  static const std::regex kMachinePath(R"((^|[^\w.\-/}])/(work|tmp|root|home|Users)/\w)");
  for (const std::string folder :
       {"include", "src", "apps", "tests", "bench", "validation", "scenes", "docs", "script", "cmake", ".ci"})
    for (const fs::path& file : files_below(folder)) {
      const std::string text = read(file);
      if (text.find('\0') != std::string::npos) continue;  // rasters and pictures
      for (const std::string& line : lines(text))
        EXPECT_FALSE(std::regex_search(line, kMachinePath)) << file << ": " << line;
    }
}

}  // namespace
}  // namespace divot
