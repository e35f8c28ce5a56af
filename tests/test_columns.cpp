// A body's columns: four at a time as one by one, and the slope is that of the force.
#include <cstring>

#include "contact/columns.h"
#include "laws/medium.h"
#include "support.h"

namespace divot::contact {
namespace {

std::vector<laws::Medium> media() {
  std::vector<laws::Medium> all;
  for (const char* name : {"dry_sand", "clay_dry", "asphalt"}) all.push_back(laws::make_medium(*find_preset(name)));
  all.push_back(all[0]);
  all.back().ground = false;
  return all;
}

// Columns round a body of 1 m: deep in the ground, at its edge, above it, beside the body; of one medium or of several.
std::vector<ColumnBlock> random_blocks(test::Random& random, std::size_t count) {
  std::vector<ColumnBlock> blocks(count);
  for (ColumnBlock& b : blocks) {
    const bool mixed = random.below(5) == 0;
    const auto medium = static_cast<std::uint8_t>(random.below(4));
    b.medium = mixed ? ColumnBlock::kMixed : medium;
    for (std::size_t k = 0; k < ColumnBlock::kColumns; ++k) {
      b.media[k] = mixed ? static_cast<std::uint8_t>(random.below(4)) : medium;
      const double x = random.in(-0.9, 0.9), y = random.in(-0.4, 0.4), z = -std::sqrt(1 - x * x - y * y);
      const bool below = random.below(8) != 0;
      b.arm_at_x[k] = x, b.arm_at_y[k] = y;
      b.underside[k] = below ? 1 + z : ColumnBlock::kNotBelow;
      b.normal[0][k] = below ? x : 0, b.normal[1][k] = below ? y : 0, b.normal[2][k] = below ? z : -1;
      b.height[k] = 1 + z + random.in(-0.01, 0.05);
      b.fresh[k] = b.height[k] + (random.below(3) == 0 ? 0 : random.in(0.0, 0.3));
      b.plastic[k] = random.below(3) == 0 ? 0 : b.fresh[k] - b.height[k];
      b.area[k] = random.in(1e-4, 1e-2), b.mass[k] = 20 * b.area[k];
      b.pull[k] = random.in(-5.0, 5.0), b.speed[k] = random.in(-1.0, 1.0), b.carried[k] = random.below(2);
      for (auto& j : b.shear) j[k] = random.below(4) == 0 ? 0 : random.in(-0.03, 0.03);
      b.load[k] = random.below(4) == 0 ? 0 : random.in(0.0, 200.0);
      b.held[k] = random.in(-20.0, 20.0);
    }
  }
  return blocks;
}

ColumnTask random_task(test::Random& random, const std::vector<laws::Medium>& media) {
  ColumnTask task{.media = media.data(), .dt = 0.002, .patch = random.in(0.05, 1.0), .friction = random.in(0.0, 1.0)};
  task.position = {random.in(-0.01, 0.01), 0, 1};
  task.ground = {random.in(-0.3, 0.3), random.in(-0.3, 0.3), 1};
  for (int k = 0; k < 6; ++k) task.now[k] = random.in(-3.0, 3.0), task.v[k] = task.now[k] + random.in(-0.2, 0.2);
  return task;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

struct Results {
  std::vector<ColumnBlock> blocks;
  std::vector<ColumnSums> sums;
};

// All that is asked of columns in a step, at several speeds.
Results results(const ColumnKernel& kernel, ColumnTask task, std::vector<ColumnBlock> blocks) {
  Results found{std::move(blocks), std::vector<ColumnSums>(4)};
  ColumnBlock* const b = found.blocks.data();
  const std::size_t count = found.blocks.size();
  kernel.freeze(task, b, count);
  for (std::size_t k = 0; k < found.sums.size(); ++k) {
    (k % 2 == 0 ? kernel.add : kernel.add_force)(task, b, count, found.sums[k]);
    for (double& speed : task.v) speed += 0.1;
  }
  kernel.load(task, b, count);
  kernel.freeze(task, b, count);
  kernel.end(task, b, count);
  return found;
}

TEST(Columns, EveryKernelGivesTheBitsOfThePlainOne) {
  const std::vector<laws::Medium> all = media();
  for (const unsigned seed : {1u, 2u, 3u}) {
    test::Random random(seed);
    const auto blocks = random_blocks(random, 200);
    const ColumnTask task = random_task(random, all);
    const Results plain = results(kColumnsPlain, task, blocks);
    EXPECT_NE(plain.sums[0].force[2][0], 0);
    for (const ColumnKernel* kernel : column_kernels()) {
      const Results fast = results(*kernel, task, blocks);
      EXPECT_TRUE(same_bits(fast.blocks, plain.blocks));
      EXPECT_TRUE(same_bits(fast.sums, plain.sums));
    }
  }
}

double total(const ColumnBlock::Four& four) { return four[0] + four[1] + four[2] + four[3]; }

TEST(Columns, TheForceFallsByItsSlope) {
  std::vector<laws::Medium> all = media();
  for (laws::Medium& medium : all)
    medium.ground_damping = 0;  // brakes lifting, but pushes along the underside's normal
  test::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    auto blocks = random_blocks(random, 1);
    ColumnTask task = random_task(random, all);
    kColumnsPlain.freeze(task, blocks.data(), 1);
    ColumnSums at;
    kColumnsPlain.add(task, blocks.data(), 1, at);
    constexpr double kStep = 1e-6;
    for (int c = 0; c < 6; ++c) {
      // Where a law has a corner in between, a difference says nothing.
      const auto difference = [&](int r, double step) {
        ColumnTask beside = task;
        beside.v[c] += step;
        ColumnSums sums;
        kColumnsPlain.add_force(beside, blocks.data(), 1, sums);
        return (total(sums.force[r]) - total(at.force[r])) / step;
      };
      for (int r = c; r < 6; ++r) {
        const double ahead = difference(r, kStep), behind = difference(r, -kStep),
                     slope = total(at.slope[r * (r + 1) / 2 + c]);
        if (std::abs(ahead - behind) > 1e-3 * (1 + std::abs(ahead))) continue;
        EXPECT_NEAR(-0.5 * (ahead + behind), slope, 1e-3 * (1 + std::abs(slope))) << r << ' ' << c;
      }
    }
  }
}

TEST(Columns, OneThatTheBodyIsNotOverDoesNothing) {
  const std::vector<laws::Medium> all = media();
  test::Random random(6);
  auto blocks = random_blocks(random, 50);
  for (ColumnBlock& b : blocks)
    for (std::size_t k = 0; k < ColumnBlock::kColumns; ++k) b.underside[k] = ColumnBlock::kNotBelow;
  const Results none = results(fastest_columns(), random_task(random, all), blocks);
  for (const ColumnSums& sums : none.sums) {
    for (const auto& force : sums.force) EXPECT_EQ(total(force), 0);
    for (const auto& slope : sums.slope) EXPECT_EQ(total(slope), 0);
  }
}

}  // namespace
}  // namespace divot::contact
