#include "contact/soil_reaction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contact/column_load.h"
#include "contact/near.h"

namespace divot::contact {
namespace {

constexpr int kPasses = 3, kIterations = 40, kHalvings = 12;

using Matrix6 = std::array<Row, 6>;

void add_scaled(Row& to, const Row& row, double factor) {
  for (int i = 0; i < 6; ++i) to[i] += factor * row[i];
}

void add_outer(Matrix6& to, const Row& row, double factor) {
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c <= r; ++c) to[r][c] += factor * row[r] * row[c];
}

// Solves A x = b for a symmetric positive definite A given by its lower half (Cholesky); x comes in b.
void solve(Matrix6& a, Row& b) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
}

// The six balances of momentum of one pass.
struct Balance {
  const state::Body& body;
  const std::vector<Footing>& footings;
  const std::vector<Contact>& contacts;
  const Situation& s;
  Row start;  // velocity and spin with gravity and without soil

  double inertia(int i) const { return i < 3 ? body.mass : body.inertia; }

  // What is missing in each balance at the velocities `v`; with `a`, its slope's negative as well.
  Row missing(const Row& v, Matrix6* a) const {
    Row r;
    for (int i = 0; i < 6; ++i) r[i] = inertia(i) * (start[i] - v[i]);
    if (a != nullptr) {
      *a = {};
      for (int i = 0; i < 6; ++i) (*a)[i][i] = inertia(i);
    }
    for (const Contact& c : contacts) {
      const Footing& f = footings[c.footing];
      const laws::Medium& medium = s.media[f.material];
      const Push push = push_of(body, f, c, dot6(c.rise, v), s);
      if (push.force > 0) {
        add_scaled(r, c.rise, s.dt * push.force);
        if (a != nullptr) add_outer(*a, c.rise, s.dt * push.per_speed);
      }
      if (c.grip <= 0) continue;
      const Shear shear = shear_of(medium, f, c, {dot6(c.slip[0], v), dot6(c.slip[1], v)}, s.dt);
      for (int i = 0; i < 2; ++i) add_scaled(r, c.slip[i], -s.dt * shear.force[i]);
      if (a != nullptr) add_shear_slope(*a, c, shear);
    }
    return r;
  }

  void add_shear_slope(Matrix6& a, const Contact& c, const Shear& shear) const {
    Row along{}, across{};
    add_scaled(along, c.slip[0], shear.along[0]), add_scaled(along, c.slip[1], shear.along[1]);
    add_scaled(across, c.slip[0], -shear.along[1]), add_scaled(across, c.slip[1], shear.along[0]);
    add_outer(a, along, s.dt * s.dt * shear.tangent);
    add_outer(a, across, s.dt * s.dt * shear.secant);
  }
};

Row moved(const Row& v, const Row& direction, double share) {
  Row out = v;
  add_scaled(out, direction, share);
  return out;
}

// Newton's method on a convex function: `missing` is its negative gradient, so a step that still goes downhill at its
// end is taken whole, and one that overshoots is cut where the slope along it changes sign.
void find_balance(const Balance& balance, Row& v) {
  const double still = 1e-9 * balance.s.surface.spacing / balance.s.dt;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix6 a;
    Row step = balance.missing(v, &a);
    const Row downhill = step;
    solve(a, step);
    const double speed = std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]) +
                         balance.body.radius * std::sqrt(step[3] * step[3] + step[4] * step[4] + step[5] * step[5]);
    double low = 0, high = 1;
    const double slope = dot6(downhill, step);
    if (dot6(balance.missing(moved(v, step, 1), nullptr), step) < -0.1 * slope) {
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (dot6(balance.missing(moved(v, step, middle), nullptr), step) > 0 ? low : high) = middle;
      }
    } else {
      low = 1;
    }
    v = moved(v, step, low > 0 ? low : high);
    if (speed < still) break;
  }
}

// Newton's law of impact on top of the soil's plastic answer: once the soil has stopped the body, the share of the
// speed of impact that restitution asks for comes back. Soil alone would return next to nothing.
void rebound(state::Body& body, const std::vector<Footing>& footings, const std::vector<Contact>& contacts,
             const Row& v, const Vec3d& before, const Situation& s) {
  body.velocity = {v[0], v[1], v[2]};
  body.angular_velocity = {v[3], v[4], v[5]};
  Vec3d sum;
  const Footing* hardest = nullptr;
  for (const Contact& c : contacts) {
    const Footing& f = footings[c.footing];
    sum += f.load * Vec3d{c.rise[0], c.rise[1], c.rise[2]};
    if (f.load > 0 && (hardest == nullptr || f.load > hardest->load)) hardest = &f;
  }
  if (hardest == nullptr) return;
  const Vec3d up = sum * (1 / length(sum));
  const double resting = 2 * length(s.gravity) * s.dt;  // what gravity alone brings is no impact
  const double approach = -dot(before, up);
  if (!body.touching && approach > resting) body.impact_speed = approach;
  const double leaving = dot(body.velocity, up);
  if (body.impact_speed == 0 || leaving < -0.02 * body.impact_speed) return;
  const double wanted = body.restitution * s.media[hardest->material].restitution * body.impact_speed;
  if (wanted > std::max(leaving, resting)) body.velocity += (wanted - leaving) * up;
  body.impact_speed = 0;
}

}  // namespace

void meet_soil(state::Body& body, std::vector<Footing>& footings, const Situation& s, std::vector<Contact>& contacts) {
  const Vec3d before = body.velocity, falling = before + s.dt * s.gravity, spin = body.angular_velocity;
  const Row start{falling.x, falling.y, falling.z, spin.x, spin.y, spin.z};
  Row v = start;
  const Balance balance{body, footings, contacts, s, start};
  for (int pass = 0; pass < kPasses; ++pass) {
    freeze_geometry(body, footings, v, s, contacts);
    if (contacts.empty()) break;
    // The first pass finds the load without friction; grip then comes from the load of the pass before.
    for (Contact& c : contacts) c.grip = grip_of(body, footings[c.footing], c, s);
    find_balance(balance, v);
    for (Contact& c : contacts)
      footings[c.footing].load = push_of(body, footings[c.footing], c, dot6(c.rise, v), s).force;
  }
  for (const Contact& c : contacts) footings[c.footing].answer = answer_of(body, footings[c.footing], c, v, s);
  rebound(body, footings, contacts, v, before, s);
}

void record_presses(state::Body& body, const std::vector<Footing>& footings, const std::vector<Contact>& contacts,
                    std::vector<Press>& presses) {
  presses.clear();
  body.sinkage = 0;
  body.last_vertex = kNone;
  double area = 0, deepest = 0;
  for (const Contact& c : contacts) {
    const Footing& f = footings[c.footing];
    const Underside under = underside(body, body.position, f.x, f.y);
    if (!under.below || under.height >= f.height) continue;
    const Vec3d slid = f.answer.shear - f.shear;
    const Vec3 place = f.vertex_position + to_float({slid.x, slid.y, 0});
    presses.push_back({f.vertex,
                       {place.x, place.y, static_cast<float>(under.height - f.above_vertex)},
                       to_float(f.answer.shear),
                       static_cast<float>(f.answer.plastic),
                       static_cast<float>(f.answer.pressure)});
    area += f.area;
    const double sunk = f.original - under.height;
    body.sinkage = std::max(body.sinkage, sunk);
    if (body.last_vertex == kNone || sunk > deepest) deepest = sunk, body.last_vertex = f.vertex;
  }
  body.touching = !presses.empty();
  body.patch_width = std::sqrt(area / std::numbers::pi);
  body.max_sinkage = std::max(body.max_sinkage, body.sinkage);
}

}  // namespace divot::contact
