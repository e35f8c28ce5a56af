// Rows of neighbours and bonds: random moving clouds against brute force, over rebuilds and changes of the set.
#include <algorithm>
#include <map>

#include "support.h"

namespace divot::neighbours {
namespace {

constexpr float kCutoff = 1.75f, kSkin = 0.4f;

using PairKey = std::pair<std::uint32_t, std::uint32_t>;  // vertices, lower first

// Soil that never yields: bonds keep the length at which they formed.
const std::vector<laws::Medium> kMedia = {{.yield_strain = 1e30f}};

// A cloud in which everything moves: each particle by itself and all of it to one side.
class Cloud {
 public:
  Cloud(std::size_t count, float width, unsigned seed) : random_(seed), width_(width) {
    for (std::size_t i = 0; i < count; ++i) add(static_cast<std::uint32_t>(3 * i));
  }

  void move(float most, const Vec3& together) {
    for (std::size_t i = 0; i < p.size(); ++i)
      p.set_position(i, p.position(i) + together +
                            Vec3{random_.in(-most, most), random_.in(-most, most), random_.in(-most, most)});
    middle_ += together;
  }

  // Some leave and others come in between.
  void change_set() {
    const std::vector<std::uint32_t> was = p.vertex;
    for (std::size_t i = p.size(); i-- > 0;)
      if (random_.below(10) == 0)
        p.for_each_array([&](auto& a) { a.erase(a.begin() + static_cast<std::ptrdiff_t>(i)); });
    for (const std::uint32_t v : was)
      if (random_.below(10) == 0 && !std::binary_search(was.begin(), was.end(), v + 1)) add(v + 1);
  }

  state::Particles p;

 private:
  void add(std::uint32_t vertex) {
    const auto at = std::lower_bound(p.vertex.begin(), p.vertex.end(), vertex) - p.vertex.begin();
    p.for_each_array([&](auto& a) { a.insert(a.begin() + at, typename std::decay_t<decltype(a)>::value_type{}); });
    const auto i = static_cast<std::size_t>(at);
    p.vertex[i] = vertex;
    p.set_position(i, middle_ + Vec3{random_.in(0.0f, width_), random_.in(0.0f, width_), random_.in(0.0f, 1.0f)});
  }

  test::Random random_;
  float width_;
  Vec3 middle_;
};

float distance_squared(const state::Particles& p, std::size_t i, std::size_t j) {
  const float dx = p.x[i] - p.x[j], dy = p.y[i] - p.y[j], dz = p.z[i] - p.z[j];
  return (dx * dx + dy * dy) + dz * dz;
}

// Bonds by brute force: a pair bonds in the step in which it comes into range and is forgotten in the one in which it
// leaves it.
void follow(const state::Particles& p, std::map<PairKey, float>& bonds) {
  std::map<PairKey, float> next;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const float r_squared = distance_squared(p, i, j);
      if (r_squared >= kCutoff * kCutoff) continue;
      const auto known = bonds.find({p.vertex[i], p.vertex[j]});
      next[{p.vertex[i], p.vertex[j]}] = known != bonds.end() ? known->second : std::sqrt(r_squared);
    }
  bonds = next;
}

std::map<PairKey, float> bonds_of(const state::Particles& p, const state::Bonds& bonds) {
  std::map<PairKey, float> found;
  for (std::uint32_t i = 0; i < p.size(); ++i)
    bonds.for_each_entry(i, [&](std::size_t e) {
      if (bonds.rest_length[e] > 0 && i < bonds.neighbour[e])
        found[{p.vertex[i], p.vertex[bonds.neighbour[e]]}] = bonds.rest_length[e];
    });
  return found;
}

// Ascending, without the particle itself, and every pair in range is there.
void expect_rows_hold_all_in_range(const state::Particles& p, const state::Bonds& bonds) {
  ASSERT_EQ(bonds.count, p.size());
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    std::vector<std::uint32_t> row;
    bonds.for_each_entry(i, [&](std::size_t e) { row.push_back(bonds.neighbour[e]); });
    const auto begin = row.begin(), end = row.end();
    ASSERT_TRUE(std::is_sorted(begin, end));
    ASSERT_FALSE(std::binary_search(begin, end, i));
    for (std::uint32_t j = 0; j < p.size(); ++j) {
      const bool in_range = j != i && distance_squared(p, i, j) < kCutoff * kCutoff;
      ASSERT_TRUE(!in_range || std::binary_search(begin, end, j)) << i << ' ' << j;
    }
  }
}

// Rows up to date, then bonds, as a substep starts.
void follow_bonds(state::Particles& p, state::Bonds& bonds, Index& index, const Reach& reach, bool changed,
                  int threads = 1) {
  update(p, bonds, index, reach, changed, Jobs(threads));
  const state::Soil soil{.rest = std::vector<Vec3>(1), .plastic = {0}, .cell = {1}};
  test::renew(p, bonds, soil, kMedia, reach.cutoff);
}

struct Counts {
  std::uint64_t rebuilds, missed;
};

// 200 steps of a cloud whose set changes now and then.
Counts follow_cloud(const Reach& reach, float most, bool changes) {
  Cloud cloud(150, 8, 11);
  state::Bonds bonds;
  Index index;
  std::map<PairKey, float> expected;
  for (int step = 0; step < 200; ++step) {
    cloud.move(most, {0.5f, -0.3f, 0.1f});
    const bool changed = step == 0 || (changes && step % 17 == 0);
    if (changed && step > 0) cloud.change_set();
    follow_bonds(cloud.p, bonds, index, reach, changed);
    follow(cloud.p, expected);
    expect_rows_hold_all_in_range(cloud.p, bonds);
    EXPECT_EQ(bonds_of(cloud.p, bonds), expected) << "step " << step;
    if (testing::Test::HasFailure()) break;
  }
  return {index.rebuilds, index.missed_pairs};
}

TEST(Neighbours, AdaptiveRowsHoldEveryPairAtEveryStep) {
  for (const Neighbours structure : {Neighbours::grid, Neighbours::kd_tree})
    for (const bool changes : {false, true}) {
      const Counts run = follow_cloud({kCutoff, kSkin, structure, {}}, 0.03f, changes);
      EXPECT_EQ(run.missed, 0u);
      EXPECT_GT(run.rebuilds, 2u);
      EXPECT_LT(run.rebuilds, 100u) << "rows that are rebuilt all the time are of no use";
    }
}

TEST(Neighbours, RowsOfEveryStepHoldEveryPair) {
  const Counts run = follow_cloud({kCutoff, kSkin, Neighbours::grid, {UpdatePolicy::Kind::every_step}}, 0.1f, true);
  EXPECT_EQ(run.missed, 0u);
  EXPECT_EQ(run.rebuilds, 200u);
}

TEST(Neighbours, WhatAllHaveInCommonNeedsNoRebuild) {
  Cloud cloud(100, 8, 12);
  state::Bonds bonds;
  Index index;
  for (int step = 0; step < 50; ++step) {
    cloud.move(0, {1, 2, 0.5f});
    update(cloud.p, bonds, index, {kCutoff, kSkin, Neighbours::grid, {}}, step == 0, Jobs(1));
  }
  EXPECT_EQ(index.rebuilds, 1u);
}

TEST(Neighbours, EveryTenthStepMissesPairsThatMoveFastAndSaysSo) {
  Cloud cloud(150, 8, 13);
  state::Bonds bonds;
  Index index;
  const Reach reach{kCutoff, kSkin, Neighbours::grid, {UpdatePolicy::Kind::every, 10}};
  for (int step = 0; step < 60; ++step) {
    cloud.move(0.2f, {});
    update(cloud.p, bonds, index, reach, step == 0, Jobs(1));
  }
  EXPECT_EQ(index.rebuilds, 6u);
  EXPECT_GT(index.missed_pairs, 0u);
}

TEST(Neighbours, EveryTenthStepMissesNothingThatRests) {
  Cloud cloud(150, 8, 14);
  state::Bonds bonds;
  Index index;
  const Reach reach{kCutoff, kSkin, Neighbours::grid, {UpdatePolicy::Kind::every, 10}};
  for (int step = 0; step < 60; ++step) update(cloud.p, bonds, index, reach, step == 0, Jobs(1));
  EXPECT_EQ(index.missed_pairs, 0u);
}

TEST(Neighbours, GridAndKdTreeGiveTheSameBonds) {
  Cloud cloud(2000, 40, 15);
  state::Bonds by_grid, by_tree;
  Index grid_index, tree_index;
  for (int step = 0; step < 20; ++step) {
    cloud.move(0.1f, {});
    if (step == 10) cloud.change_set();
    const bool changed = step == 0 || step == 10;
    follow_bonds(cloud.p, by_grid, grid_index, {kCutoff, kSkin, Neighbours::grid, {}}, changed);
    follow_bonds(cloud.p, by_tree, tree_index, {kCutoff, kSkin, Neighbours::kd_tree, {}}, changed, 3);
    ASSERT_EQ(by_grid.first, by_tree.first);
    ASSERT_EQ(by_grid.neighbour, by_tree.neighbour);
    ASSERT_EQ(by_grid.rest_length, by_tree.rest_length);
  }
}

TEST(Neighbours, BondsAreTheSameSeenFromEitherSide) {
  Cloud cloud(300, 10, 16);
  state::Bonds bonds;
  Index index;
  follow_bonds(cloud.p, bonds, index, {kCutoff, kSkin, Neighbours::grid, {}}, true);
  std::map<PairKey, float> ends;
  for (std::uint32_t i = 0; i < cloud.p.size(); ++i)
    bonds.for_each_entry(i, [&](std::size_t e) { ends[{i, bonds.neighbour[e]}] = bonds.rest_length[e]; });
  for (const auto& [pair, length] : ends) ASSERT_EQ(length, (ends.at({pair.second, pair.first})));
}

TEST(Neighbours, SoilThatFlowsHasNoBondsUntilItRests) {
  Cloud cloud(100, 6, 17);
  state::Bonds bonds;
  Index index;
  const Reach reach{kCutoff, kSkin, Neighbours::grid, {}};
  follow_bonds(cloud.p, bonds, index, reach, true);
  const auto before = bonds_of(cloud.p, bonds);
  cloud.p.flow_rate[50] = 1;
  follow_bonds(cloud.p, bonds, index, reach, false);
  bonds.for_each_entry(50, [&](std::size_t e) { EXPECT_EQ(bonds.rest_length[e], 0); });
  EXPECT_LT(bonds_of(cloud.p, bonds).size(), before.size());
  cloud.p.flow_rate[50] = 0;
  follow_bonds(cloud.p, bonds, index, reach, false);
  EXPECT_EQ(bonds_of(cloud.p, bonds), before);
}

// On a grid a slot's neighbours follow each other, and the layout says so.
TEST(NeighboursBlocks, RunsOfAGridAreFound) {
  test::Sheet s = test::make_sheet({.columns = 64, .rows = 64, .spacing = 1});
  update(s.particles, s.bonds, s.index, {1.6f, 0.1f, Neighbours::grid, {}}, true, Jobs(2));
  std::size_t runs = 0;
  for (std::size_t slot = 0; slot < s.bonds.reads.size(); ++slot) {
    const state::SlotReads& reads = s.bonds.reads[slot];
    if (reads.run == kNone) continue;
    ++runs;
    ASSERT_LE(reads.run + state::Bonds::kLanes, s.particles.size());
    if (reads.lanes != 0) {
      ASSERT_LE(reads.other + state::Bonds::kLanes, s.particles.size());
    }
    for (std::uint32_t lane = 0; lane < state::Bonds::kLanes; ++lane) {
      const std::size_t e = slot * state::Bonds::kLanes + lane;
      if (s.bonds.rest_length[e] >= 0) {
        ASSERT_EQ(s.bonds.neighbour[e], ((reads.lanes >> lane & 1) ? reads.other : reads.run) + lane);
      }
    }
  }
  EXPECT_GT(runs, s.bonds.reads.size() * 95 / 100);
  EXPECT_LT(s.bonds.reads.size(), 8.3 * 64 * 64 / state::Bonds::kLanes);
}

// Several media in a block are seen.
TEST(NeighboursBlocks, KnowTheirMedium) {
  test::Sheet s = test::make_sheet({.columns = 64, .rows = 32, .spacing = 1}, {Material{}, Material{}});
  s.particles.material[700] = 1;
  update(s.particles, s.bonds, s.index, {1.6f, 0.1f, Neighbours::grid, {}}, true, Jobs(1));
  for (std::size_t block = 0; block < s.bonds.block_count(); ++block) {
    bool near = false;
    for (std::size_t i = 8 * block; i < 8 * block + 8; ++i) {
      near |= i == 700;
      s.bonds.for_each_entry(i, [&](std::size_t e) { near |= s.bonds.neighbour[e] == 700; });
    }
    EXPECT_EQ(s.bonds.medium[block], near ? state::Bonds::kSeveral : 0) << block;
  }
}

TEST(Neighbours, NoParticlesAreNoTrouble) {
  const state::Particles none;
  state::Bonds bonds;
  Index index;
  for (int step = 0; step < 3; ++step)
    update(none, bonds, index, {kCutoff, kSkin, Neighbours::grid, {}}, step == 0, Jobs(1));
  EXPECT_TRUE(bonds.neighbour.empty());
}

}  // namespace
}  // namespace divot::neighbours
