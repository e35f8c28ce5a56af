#include "viewer/stage_meter.h"

namespace divot::viewer {
namespace {

constexpr double kShare = 0.06;  // of the newest picture in what is shown

}  // namespace

void StageMeter::update(std::span<const StageTime> totals) {
  totals_.resize(totals.size());
  rows_.resize(totals.size());
  for (std::size_t i = 0; i < totals.size(); ++i) {
    const double spent = totals[i].ms - totals_[i];
    totals_[i] = totals[i].ms;
    rows_[i].name = totals[i].name;
    if (spent >= 0) rows_[i].ms += kShare * (spent - rows_[i].ms);
  }
}

}  // namespace divot::viewer
