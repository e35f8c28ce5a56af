// Sets of ids: one that lists them ascending without sorting, and one that takes memory only by their number.
#include <set>

#include "core/hash_set.h"
#include "core/id_set.h"
#include "support.h"

namespace divot::core {
namespace {

TEST(IdSet, ListsEachIdOnceAndAscendingAndIsThenEmpty) {
  IdSet set;
  test::Random random(3);
  for (const float highest : {60.0f, 5e3f, 3e6f, 200.0f}) {
    std::set<std::uint32_t> expected;
    for (int k = 0; k < 2000; ++k) {
      const auto id = static_cast<std::uint32_t>(random.in(0, highest));
      set.insert(id), expected.insert(id);
    }
    std::vector<std::uint32_t> list = {7};
    set.list(list);
    for (std::uint32_t id = 0; id < 5100; ++id) {
      const auto at = std::lower_bound(list.begin(), list.end(), id);
      const bool has = at != list.end() && *at == id;
      ASSERT_EQ(set.index_of(id), has ? static_cast<std::uint32_t>(at - list.begin()) : kNone) << id;
    }
    set.drain(list);
    EXPECT_EQ(list, std::vector<std::uint32_t>(expected.begin(), expected.end()));
    set.drain(list);
    EXPECT_TRUE(list.empty());
  }
}

TEST(IdSet, IsEmptyOnceCleared) {
  IdSet set;
  for (const std::uint32_t id : {3u, 70u, 5000u}) set.insert(id);
  set.clear();
  std::vector<std::uint32_t> list;
  set.list(list);
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(set.index_of(70), kNone);
}

TEST(IdSet, GivesUpWhatIsErased) {
  IdSet set;
  for (const std::uint32_t id : {3u, 70u, 71u, 5000u}) set.insert(id);
  for (const std::uint32_t id : {3u, 71u, 72u, 900'000u}) set.erase(id);
  std::vector<std::uint32_t> list;
  set.drain(list);
  EXPECT_EQ(list, (std::vector<std::uint32_t>{70, 5000}));
}

TEST(IdSet, SortsAList) {
  IdSet set;
  std::vector<std::uint32_t> list = {64, 4096, 63, 0, 64, 4095, 0};
  set.sort_unique(list);
  EXPECT_EQ(list, (std::vector<std::uint32_t>{0, 63, 64, 4095, 4096}));
}

TEST(HashSet, HoldsWhatAStandardSetHolds) {
  HashSet set;
  test::Random random(7);
  for (const float highest : {60.0f, 5e3f, 4e9f, 200.0f}) {
    std::set<std::uint32_t> expected;
    for (int k = 0; k < 2000; ++k) {
      const auto id = static_cast<std::uint32_t>(random.in(0, highest));
      ASSERT_EQ(set.insert(id), expected.insert(id).second);
    }
    EXPECT_EQ(set.size(), expected.size());
    for (std::uint32_t id = 0; id < 5100; ++id) ASSERT_EQ(set.contains(id), expected.count(id) == 1) << id;
    for (const std::uint32_t id : expected) ASSERT_TRUE(set.contains(id));
    set.clear();
    EXPECT_EQ(set.size(), 0u);
    EXPECT_FALSE(set.contains(*expected.begin()));
  }
}

}  // namespace
}  // namespace divot::core
