// Kernels over blocks of four columns, compiled once for each instruction set: see math/lanes.h. A block of several
// media goes to the plain kernel.

#include "contact/column_terms.h"
#include "math/lanes.h"

namespace divot::contact::DIVOT_LANES {

using math::DIVOT_LANES::DoubleLanes;
using Speed = RealRow<DoubleLanes>;

struct WholeBlock {
  DIVOT_INLINE DoubleLanes get(const ColumnBlock::Four& four) const { return math::DIVOT_LANES::load(four); }
  DIVOT_INLINE void set(ColumnBlock::Four& four, DoubleLanes x) const { math::DIVOT_LANES::store(four, x); }
};

inline void freeze(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for (ColumnBlock* b = blocks; b != blocks + count; ++b) {
    if (b->medium == ColumnBlock::kMixed)
      kColumnsPlain.freeze(task, b, 1);
    else
      freeze_column(task, task.media[b->medium], Speed(task.v), WholeBlock{}, *b);
  }
}

inline void load(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for (ColumnBlock* b = blocks; b != blocks + count; ++b) {
    if (b->medium == ColumnBlock::kMixed)
      kColumnsPlain.load(task, b, 1);
    else
      load_column(task, task.media[b->medium], Speed(task.v), WholeBlock{}, *b);
  }
}

inline void end(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for (ColumnBlock* b = blocks; b != blocks + count; ++b) {
    if (b->medium == ColumnBlock::kMixed)
      kColumnsPlain.end(task, b, 1);
    else
      end_column(task, task.media[b->medium], Speed(task.v), WholeBlock{}, *b);
  }
}

template <bool kSlope>
void add(const ColumnTask& task, const ColumnBlock* blocks, std::size_t count, ColumnSums& sums) {
  RealSums<DoubleLanes> own;
  const WholeBlock in;
  const auto fetch = [&]() DIVOT_INLINE_LAMBDA {
    for (int k = 0; k < 6; ++k) own.force[k] = in.get(sums.force[k]);
    for (int k = 0; k < 21; ++k) own.slope[k] = in.get(sums.slope[k]);
  };
  const auto keep = [&]() DIVOT_INLINE_LAMBDA {
    for (int k = 0; k < 6; ++k) in.set(sums.force[k], own.force[k]);
    for (int k = 0; k < 21; ++k) in.set(sums.slope[k], own.slope[k]);
  };
  fetch();
  for (const ColumnBlock* b = blocks; b != blocks + count; ++b) {
    if (b->medium == ColumnBlock::kMixed) {
      keep();
      (kSlope ? kColumnsPlain.add : kColumnsPlain.add_force)(task, b, 1, sums);
      fetch();
    } else {
      add_column<kSlope>(task, task.media[b->medium], Speed(task.v), in, *b, own);
    }
  }
  keep();
}

}  // namespace divot::contact::DIVOT_LANES
