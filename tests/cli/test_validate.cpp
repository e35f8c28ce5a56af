// Comparisons with measurements: how they are judged, that the page is theirs, and a few of them run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.h"
#include "source_dir.h"
#include "validation/data.h"
#include "validation/page.h"
#include "validation/runner.h"

namespace divot::validation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kRoot = test::source_dir();
const Places kPlaces{(kRoot / "scenes").string(), (kRoot / "validation/data").string()};

// ---- judging

TEST(ValidateCase, AboutIsWithinTheToleranceOnBothSides) {
  const Case about{.name = "a", .measured = 2, .tolerance = 0.1};
  EXPECT_TRUE(passes(about, 2.2));
  EXPECT_TRUE(passes(about, 1.8));
  EXPECT_FALSE(passes(about, 2.21));
  EXPECT_NEAR(relative_error(about, 1.5), 0.25, 1e-12);
}

TEST(ValidateCase, ARangeHoldsItsEnds) {
  const Case range = between({.name = "a"}, 0.15, 0.3);
  EXPECT_DOUBLE_EQ(range_low(range), 0.15);
  EXPECT_DOUBLE_EQ(range_high(range), 0.3);
  EXPECT_TRUE(passes(range, 0.15));
  EXPECT_TRUE(passes(range, 0.3));
  EXPECT_FALSE(passes(range, 0.149));
  EXPECT_EQ(measured_text(range), "0.15 to 0.3");
}

TEST(ValidateCase, LimitsCountOnlyWhatIsBeyond) {
  const Case most{.name = "a", .measured = 2, .bound = Bound::at_most};
  const Case least{.name = "a", .measured = 2, .bound = Bound::at_least};
  EXPECT_EQ(relative_error(most, 0), 0);
  EXPECT_DOUBLE_EQ(relative_error(most, 3), 0.5);
  EXPECT_FALSE(passes(most, 2.01));
  EXPECT_TRUE(passes(least, 100));
  EXPECT_FALSE(passes(least, 1.9));
}

TEST(ValidateCase, WhatIsNotANumberNeverHolds) {
  for (const Bound bound : {Bound::about, Bound::between, Bound::at_most, Bound::at_least})
    EXPECT_FALSE(passes({.name = "a", .measured = 1, .tolerance = 10, .bound = bound}, std::nan("")));
}

// ---- data

TEST(ValidateData, CellsMayHoldCommasAndQuotes) {
  const auto rows = parse_csv("a,b\n\"1, 2\",\"say \"\"so\"\"\"\n,x");
  const std::vector<std::vector<std::string>> expected = {{"a", "b"}, {"1, 2", "say \"so\""}, {"", "x"}};
  EXPECT_EQ(rows, expected);
}

TEST(ValidateData, EveryCraterSaysWhereItIsFrom) {
  const auto craters = measured_craters(kPlaces.data);
  ASSERT_TRUE(craters);
  EXPECT_GE(craters->size(), 20u);
  for (const MeasuredCrater& crater : *craters) {
    EXPECT_FALSE(crater.source.empty()) << crater.shot;
    EXPECT_GT(crater.charge, 0) << crater.shot;
    EXPECT_GT(crater.diameter, 0) << crater.shot;
  }
}

TEST(ValidateData, AFolderWithoutThemIsNamed) {
  const auto craters = measured_craters("nowhere");
  ASSERT_FALSE(craters);
  EXPECT_NE(craters.error().front().text().find("nowhere"), std::string::npos);
}

// ---- what there is

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const auto chosen = choose({}, kPlaces);
  EXPECT_TRUE(chosen);
  if (!chosen) return cases;
  for (const Chosen& family : *chosen)
    for (const Experiment& experiment : family.experiments)
      cases.insert(cases.end(), experiment.cases.begin(), experiment.cases.end());
  return cases;
}

TEST(ValidateCases, AreWhole) {
  std::set<std::string> names;
  for (const Case& one : all_cases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name << " twice";
    EXPECT_EQ(one.name.find(' '), std::string::npos) << one.name;
    EXPECT_FALSE(one.source.empty()) << one.name;
    EXPECT_FALSE(one.quantity.empty()) << one.name;
    EXPECT_FALSE(one.unit.empty()) << one.name;
    EXPECT_TRUE(std::isfinite(one.measured) && one.measured != 0) << one.name;
    const bool limit = one.bound == Bound::at_most || one.bound == Bound::at_least;
    EXPECT_EQ(limit ? one.tolerance : 0, 0) << one.name;
    EXPECT_GE(one.tolerance, 0) << one.name;
  }
  EXPECT_GT(names.size(), 100u);
}

// Names, sources, quantities and measured values; what was simulated is as old as the page.
TEST(ValidateDocs, PageHoldsTheCasesOfTheProgram) {
  std::vector<std::string> known, written;
  for (const Case& one : all_cases()) known.push_back(row_start(one));
  std::istringstream page(test::read_text(kRoot / "docs/validation.md"));
  std::size_t next = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `")) continue;
    const std::string& expected = next < known.size() ? known[next++] : "no further case";
    EXPECT_TRUE(line.starts_with(expected)) << "docs/validation.md: " << line << "\nthe program: " << expected
                                            << "\n`divot validate --docs docs` writes it anew";
    written.push_back(line);
  }
  EXPECT_EQ(written.size(), known.size());
}

// ---- the program

class Validate : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("divot_validate_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
               std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Validate, ChosenCasesHoldAndAreWritten) {
  const test::Outcome outcome = test::run_program(
      {"validate", "paper", "crater_size/eq10", "sphere/mud", "permanence", "--json", "v.json", "--out", "plots"},
      folder_);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const json written = json::parse(test::read_text(folder_ / "v.json"));
  EXPECT_GT(written["cases"].size(), 20u);
  for (const json& one : written["cases"]) {
    for (const char* key :
         {"name", "source", "quantity", "unit", "measured", "simulated", "relative_error", "tolerance"})
      EXPECT_TRUE(one.contains(key)) << key;
    EXPECT_TRUE(one["pass"].get<bool>()) << one;
    EXPECT_NE(outcome.out.find(one["name"].get<std::string>()), std::string::npos);
  }
}

// A sand that is no sand: what fails is said to, in all three places.
TEST_F(Validate, WhatDoesNotHoldFails) {
  std::string soils = test::read_text(kRoot / "validation/data/soils.csv");
  const std::string from = "Snow (U.S.),,1.6,", to = "Snow (U.S.),,x,";
  ASSERT_NE(soils.find(from), std::string::npos);
  soils.replace(soils.find(from), from.size(), to);
  fs::create_directories(folder_ / "data");
  fs::copy(kRoot / "validation/data/craters.csv", folder_ / "data");
  std::ofstream(folder_ / "data/soils.csv", std::ios::binary) << soils;
  const test::Outcome outcome =
      test::run_program({"validate", "sphere/snow/light", "--data", "data", "--json", "v.json"}, folder_);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("FAIL"), std::string::npos) << outcome.out;
  const json one = json::parse(test::read_text(folder_ / "v.json"))["cases"].at(0);
  EXPECT_FALSE(one["pass"].get<bool>());
}

TEST_F(Validate, ListRunsNothing) {
  const test::Outcome outcome = test::run_program({"validate", "--list"}, folder_);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(test::line_count(outcome.out), all_cases().size() + 1);
  EXPECT_TRUE(test::files_below(folder_).empty());
}

TEST_F(Validate, AnUnknownNameIsRefused) {
  const test::Outcome outcome = test::run_program({"validate", "crater_siez"}, folder_);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("crater_siez"), std::string::npos);
  EXPECT_NE(outcome.err.find("crater_size"), std::string::npos);
  EXPECT_EQ(test::run_program({"validate", "paper", "--docs", "x"}, folder_).status, 2);
}

}  // namespace
}  // namespace divot::validation
