#include "contact/frozen_columns.h"

#include <algorithm>

namespace divot::contact {
namespace {

void fill(const Footing& f, ColumnBlock& b, std::size_t k) {
  b.arm_at_x[k] = f.arm_x, b.arm_at_y[k] = f.arm_y;
  b.height[k] = f.height, b.fresh[k] = f.fresh, b.plastic[k] = f.plastic;
  b.area[k] = f.area, b.mass[k] = f.mass, b.pull[k] = f.pull, b.speed[k] = f.speed, b.carried[k] = f.carried ? 1 : 0;
  b.shear[0][k] = f.shear.x, b.shear[1][k] = f.shear.y, b.shear[2][k] = f.shear.z;
  b.media[k] = f.material;
}

void set_underside(const geometry::Underside& under, ColumnBlock& b, std::size_t k) {
  b.underside[k] = under.below ? under.height : ColumnBlock::kNotBelow;
  const Vec3d normal = under.below ? under.normal : Vec3d{0, 0, -1};
  b.normal[0][k] = normal.x, b.normal[1][k] = normal.y, b.normal[2][k] = normal.z;
}

}  // namespace

void fill_columns(const state::Body& body, const Situation& s, Scratch::PerBody& scratch) {
  constexpr std::size_t kFour = ColumnBlock::kColumns;
  const std::vector<Footing>& footings = scratch.footings;
  std::vector<ColumnBlock>& blocks = scratch.columns.blocks;
  blocks.resize((footings.size() + kFour - 1) / kFour);
  for (std::size_t k = 0; k < footings.size(); ++k) fill(footings[k], blocks[k / kFour], k % kFour);
  for (std::size_t k = footings.size(); k < kFour * blocks.size(); ++k) {
    fill(footings.back(), blocks.back(), k % kFour);
    set_underside({}, blocks.back(), k % kFour);
  }
  for (ColumnBlock& b : blocks)
    b.medium = std::all_of(b.media, b.media + kFour, [&](std::uint8_t medium) { return medium == b.media[0]; })
                   ? b.media[0]
                   : ColumnBlock::kMixed;
  scratch.task = {.media = s.media.data(),
                  .dt = s.dt,
                  .patch = std::max(body.patch_width, 0.5 * body.spacing),
                  .friction = body.friction,
                  .ground = scratch.ground};
  const Row now = math::row(body.velocity, body.angular_velocity);
  std::copy(now.begin(), now.end(), scratch.task.now);
}

void freeze_geometry(const state::Body& body, const Scratch::Pose& start, const Row& v, const Situation& s,
                     Scratch::PerBody& scratch) {
  Columns& columns = scratch.columns;
  const Vec3d position = start.position + s.dt * math::linear(v);
  scratch.end.place(*body.solid, position, math::spun(start.orientation, math::angular(v), s.dt));
  columns.any_below = false;
  for (std::size_t k = 0; k < scratch.footings.size(); ++k) {
    const Footing& f = scratch.footings[k];
    const geometry::Underside under = scratch.end.underside(f.x, f.y);
    set_underside(under, columns.blocks[k / ColumnBlock::kColumns], k % ColumnBlock::kColumns);
    columns.any_below |= under.below;
  }
  scratch.task.position = position;
  std::copy(v.begin(), v.end(), scratch.task.v);
  fastest_columns().freeze(scratch.task, columns.blocks.data(), columns.blocks.size());
}

}  // namespace divot::contact
