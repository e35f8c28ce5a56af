#include "contact/column_terms.h"
#include "math/processor.h"

// Column by column: blocks of several media, and the reference that the other kernels are held against.
namespace divot::contact {
namespace {

// One column of a block.
struct OneColumn {
  std::uint32_t lane = 0;
  double get(const ColumnBlock::Four& four) const { return four[lane]; }
  void set(ColumnBlock::Four& four, double x) const { four[lane] = x; }
};

// Calls f(block, medium, column) for each.
template <class Block, class F>
void for_each(const ColumnTask& task, Block* blocks, std::size_t count, F f) {
  for (std::size_t k = 0; k < count; ++k)
    for (std::uint32_t lane = 0; lane < ColumnBlock::kColumns; ++lane)
      f(blocks[k], task.media[blocks[k].media[lane]], OneColumn{lane});
}

void freeze(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for_each(task, blocks, count, [&](ColumnBlock& b, const laws::Medium& medium, OneColumn in) {
    freeze_column(task, medium, RealRow<double>(task.v), in, b);
  });
}

template <bool kSlope>
void add(const ColumnTask& task, const ColumnBlock* blocks, std::size_t count, ColumnSums& sums) {
  for_each(task, blocks, count, [&](const ColumnBlock& b, const laws::Medium& medium, OneColumn in) {
    RealSums<double> own;
    for (int k = 0; k < 6; ++k) own.force[k] = in.get(sums.force[k]);
    for (int k = 0; k < 21; ++k) own.slope[k] = in.get(sums.slope[k]);
    add_column<kSlope>(task, medium, RealRow<double>(task.v), in, b, own);
    for (int k = 0; k < 6; ++k) in.set(sums.force[k], own.force[k]);
    for (int k = 0; k < 21; ++k) in.set(sums.slope[k], own.slope[k]);
  });
}

void load(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for_each(task, blocks, count, [&](ColumnBlock& b, const laws::Medium& medium, OneColumn in) {
    load_column(task, medium, RealRow<double>(task.v), in, b);
  });
}

void end(const ColumnTask& task, ColumnBlock* blocks, std::size_t count) {
  for_each(task, blocks, count, [&](ColumnBlock& b, const laws::Medium& medium, OneColumn in) {
    end_column(task, medium, RealRow<double>(task.v), in, b);
  });
}

}  // namespace

const ColumnKernel kColumnsPlain{freeze, add<true>, add<false>, load, end};

std::vector<const ColumnKernel*> column_kernels() {
  std::vector<const ColumnKernel*> list;
#if defined(__x86_64__)
  if (math::has_avx512()) list.push_back(&kColumnsAvx512);
  if (math::has_avx2()) list.push_back(&kColumnsAvx2);
#endif
  list.push_back(&kColumnsBaseline), list.push_back(&kColumnsPlain);
  return list;
}

const ColumnKernel& fastest_columns() {
  static const ColumnKernel& kFastest = *column_kernels().front();
  return kFastest;
}

}  // namespace divot::contact
