#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "divot/vec.h"
#include "laws/medium.h"

namespace divot::contact {

/// Four columns of soil that a body meets, number by number, so that a kernel takes them at once. Rows lead from the
/// body's velocity and spin to a speed at the column; numbers that are the same for all columns are left out of them.
struct ColumnBlock {
  static constexpr std::uint32_t kColumns = 4;
  static constexpr std::uint8_t kMixed = 255;  ///< not all of one medium
  static constexpr double kNotBelow = 1e9;     ///< underside, m, where the body is not over the column
  using Four = double[kColumns];

  // What was gathered: see Footing.
  Four arm_at_x, arm_at_y;      ///< m
  Four height, fresh, plastic;  ///< m
  Four area, mass;              ///< m^2, kg
  Four pull, speed;             ///< N, m/s: of the particle by its bonds, and upward
  Four carried;                 ///< 1: a body has it since the last step, and it moves with that; else 0
  Four shear[3];                ///< m, shear displacement j
  std::uint8_t media[kColumns];
  std::uint8_t medium = 0;  ///< of all four, or kMixed

  // The geometry, frozen where the body is expected to end the step.
  Four underside;               ///< m
  Four normal[3];               ///< unit, outward, of the underside
  Four arm[3];                  ///< m, from the body's centre
  Four rise[2];                 ///< to the speed of the underside, upward: x and y; z is 1
  Four turn[3];                 ///< and what spin makes of it; also of the speed at which the body lifts off
  Four rise_there;              ///< m/s, of the velocity at which the geometry was frozen
  Four slope;                   ///< length of the push's direction whose vertical part is 1
  Four tangent[2];              ///< unit, across the normal: x and z; y is 0
  Four other[3];                ///< unit, across both
  Four slip[5], other_slip[5];  ///< to the slip along each against the column: x, y, spin; z is 0

  // What the last pass of the solve found.
  Four load;  ///< N, upward
  Four held;  ///< N, upward on the body by shear along its flank
  Four grip;  ///< N, largest shear force

  // How the column ends the step.
  Four end_plastic, end_pressure;  ///< m, Pa
  Four end_shear[3];               ///< m
};

/// The columns of a body, four after four; what fills the last four up is under no body.
struct Columns {
  std::vector<ColumnBlock> blocks;
  bool any_below = false;  ///< the body is over one of them

  using Number = ColumnBlock::Four ColumnBlock::*;
  using Three = ColumnBlock::Four (ColumnBlock::*)[3];
  double& at(Number number, std::size_t column) { return (blocks[column / 4].*number)[column % 4]; }
  double at(Number number, std::size_t column) const { return (blocks[column / 4].*number)[column % 4]; }
  Vec3d at(Three numbers, std::size_t column) const {
    const ColumnBlock& b = blocks[column / 4];
    const std::size_t k = column % 4;
    return {(b.*numbers)[0][k], (b.*numbers)[1][k], (b.*numbers)[2][k]};
  }
  bool is_below(std::size_t column) const { return at(&ColumnBlock::underside, column) < ColumnBlock::kNotBelow; }
};

/// What the columns of one body have in common.
struct ColumnTask {
  const laws::Medium* media = nullptr;
  double dt = 0;        ///< s
  double patch = 0;     ///< m, Bekker's b
  double friction = 0;  ///< of the body
  double now[6] = {};   ///< m/s, rad/s: velocity and spin at the start of the step
  double v[6] = {};     ///< likewise, at which something is asked

  Vec3d position;  ///< m, of the body's centre where the geometry is frozen
  Vec3d ground;    ///< across the unpressed ground, 1 high
};

/// Force on the body, N and N m, and how fast it falls with its velocity and spin: the lower half, row by row. A sum
/// for each place in a block, each in the order of blocks.
struct ColumnSums {
  ColumnBlock::Four force[6] = {};
  ColumnBlock::Four slope[21] = {};
};

/// What is asked of all blocks of a body. Four columns at a time, for any processor, for those with AVX2 and those with
/// AVX-512; the same bits as column by column. What bounds them is arithmetic: with slope about 330 operations a
/// column, among them a power, an exponential, four divisions and a root; half of it without the slope.
struct ColumnKernel {
  /// Freezes all that follows from underside and normal, at task.v, and finds the grip at the load known.
  void (*freeze)(const ColumnTask& task, ColumnBlock* blocks, std::size_t count);
  /// Adds what the columns do to a body that goes with task.v.
  void (*add)(const ColumnTask& task, const ColumnBlock* blocks, std::size_t count, ColumnSums& sums);
  /// The same without the slope.
  void (*add_force)(const ColumnTask& task, const ColumnBlock* blocks, std::size_t count, ColumnSums& sums);
  /// Load and held force at task.v.
  void (*load)(const ColumnTask& task, ColumnBlock* blocks, std::size_t count);
  /// How the columns end the step at task.v.
  void (*end)(const ColumnTask& task, ColumnBlock* blocks, std::size_t count);
};

extern const ColumnKernel kColumnsPlain, kColumnsBaseline, kColumnsAvx2, kColumnsAvx512;

/// Every kernel that this processor runs, the fastest first.
std::vector<const ColumnKernel*> column_kernels();

/// The fastest that this processor runs.
const ColumnKernel& fastest_columns();

}  // namespace divot::contact
