#include <algorithm>

#include "forces/kernel.h"
#include "math/processor.h"
#include "state/particles.h"

namespace divot::forces {
namespace {

using state::Bonds;

// Of two materials the weaker holds the bond, of two equally stiff ones the first: the order of the pair does not
// matter.
bool holds_bond(const Terms& a, const Terms& b) {
  return a.bond_stiffness < b.bond_stiffness || (a.bond_stiffness == b.bond_stiffness && &a < &b);
}

// Cohesion of all bonds of particle i.
Sum<float> sum_bonds(const Arrays& a, std::size_t i) {
  const Terms& own = a.terms[a.material[i]];
  Sum<float> sum{0, 0, 0};
  const std::size_t block = i / Bonds::kLanes;
  for (std::size_t slot = a.first_slot[block]; slot < a.first_slot[block + 1]; ++slot) {
    const std::size_t e = slot * Bonds::kLanes + i % Bonds::kLanes, j = a.neighbour[e];
    float& r0 = a.rest_length[e];
    if (r0 < 0) continue;
    const Terms& other = a.terms[a.material[j]];
    const Terms& t = holds_bond(other, own) ? other : own;
    Pair<float> p{a.x[i] - a.x[j],   a.y[i] - a.y[j],   a.z[i] - a.z[j],  0,
                  a.vx[j] - a.vx[i], a.vy[j] - a.vy[i], a.vz[j] - a.vz[i]};
    p.r_squared = squared_length(p.dx, p.dy, p.dz);
    if (a.renew) r0 = renewed(t, a.reach, p.r_squared, r0, a.flow_rate[i] <= 0 && a.flow_rate[j] <= 0);
    const float lighter = std::min(a.mass[i], a.mass[j]);
    const float softened = a.softened ? softening(t, lighter) : 1;
    add_bond(t, a.reach, p, r0, softened, a.softened ? softened_damping(t, lighter) : t.medium.viscous_damping, sum);
  }
  return sum;
}

Own<float> own_of(const Arrays& a, std::size_t i) {
  const std::size_t c = a.column[i];
  const float* rest = a.rest + 3 * c;
  return {a.x[i] - rest[0], a.y[i] - rest[1], a.z[i] - rest[2], a.vx[i],   a.vy[i],
          a.vz[i],          a.mass[i],        a.flow_rate[i],   a.area[c], a.plastic[c]};
}

}  // namespace

void plain(const Arrays& a, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin * Bonds::kLanes; i < std::min(a.count, end * Bonds::kLanes); ++i) {
    const auto hold = static_cast<Hold>(a.hold[i]);
    Sum<float> sum = sum_bonds(a, i);
    a.held_pull[i] = hold == Hold::anchor ? 0 : sum.z;
    add_own(a.terms[a.material[i]], own_of(a, i), sum);
    if (hold != Hold::free) sum = {0, 0, 0};
    a.fx[i] = sum.x, a.fy[i] = sum.y, a.fz[i] = sum.z;
  }
}

std::vector<Kernel*> kernels() {
  std::vector<Kernel*> list;
#if defined(__x86_64__)
  if (math::has_avx512()) list.push_back(&avx512);
  if (math::has_avx2()) list.push_back(&avx2);
#endif
  list.push_back(&baseline), list.push_back(&plain);
  return list;
}

Kernel* fastest() {
  static Kernel* const kFastest = kernels().front();
  return kFastest;
}

}  // namespace divot::forces
