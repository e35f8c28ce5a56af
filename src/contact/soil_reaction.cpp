#include "contact/soil_reaction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contact/near.h"
#include "laws/bekker.h"

namespace divot::contact {
namespace {

// Flanks steeper than this push sideways no harder: at the equator of a ball the vertical columns would push infinitely.
constexpr double kSteepestFlank = 0.25;  // |vertical part of the normal|
constexpr int kMostIterations = 24;

using Vector6 = std::array<double, 6>;
struct Matrix6 {
  std::array<Vector6, 6> row{};
};

// Solves A x = b for a symmetric positive definite A (Cholesky), x in b.
void solve(Matrix6& a, Vector6& b) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a.row[i][j];
      for (int k = 0; k < j; ++k) sum -= a.row[i][k] * a.row[j][k];
      a.row[i][j] = i == j ? std::sqrt(sum) : sum / a.row[j][j];
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a.row[i][k] * b[k];
    b[i] /= a.row[i][i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) b[i] -= a.row[k][i] * b[k];
    b[i] /= a.row[i][i];
  }
}

Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double l = length(v);
  return l > 0 ? v * (1 / l) : otherwise;
}

Vec3d minus_normal_part(const Vec3d& v, const Vec3d& normal) { return v - dot(v, normal) * normal; }

// The load of one column on the body at its trial position.
struct Load {
  Vec3d arm;        // from the body's centre to the contact, m
  Vec3d normal;     // outward from the body
  Vec3d lift;       // direction of the soil's push scaled so that its vertical part is 1
  double push = 0;  // N, vertical
  double slope = 0; // N/m, of push against sinkage
  double sinkage = 0, plastic = 0;  // m
  Vec3d shear;      // shear displacement at the end of the step, m
  double grip = 0;  // N, largest shear force
};

double patch(const state::Body& body, const Situation& s) { return std::max<double>(body.patch_width, 0.5 * s.surface.spacing); }

// What column k does to the body, which starts the step as `body` is, at `position` moving with `velocity`, `spin`; false where it does not touch.
bool load_of(const state::Body& body, const Ground& g, std::size_t k, const Vec3d& position, const Vec3d& velocity,
             const Vec3d& spin, const Situation& s, Load& load) {
  const Underside under = underside(body, position, g.x[k], g.y[k]);
  if (!under.below || under.height >= g.height[k]) return false;
  const laws::Medium& medium = s.media[g.material[k]];
  load.sinkage = g.fresh[k] - under.height;
  laws::Pressure<double> pressure;
  if (medium.ground)
    pressure = laws::ground_pressure<double>(medium, load.sinkage, g.plastic[k], patch(body, s), medium.elastic_stiffness);
  load.plastic = pressure.yields ? load.sinkage - pressure.value / medium.elastic_stiffness : g.plastic[k];

  const double steep = std::max(kSteepestFlank, -under.normal.z);
  load.normal = under.normal;
  load.lift = {-under.normal.x / steep, -under.normal.y / steep, 1};
  // The particle's own inertia and what cohesion does to it come on top of the soil's pressure.
  // One that the body carries already moves with it; others are met at their own speed.
  const double inertia = g.mass[k] / s.dt;
  const double met = g.carried[k] ? dot(load.lift, body.velocity) : g.speed[k];
  const double rising = dot(load.lift, velocity);  // of the underside over this column, m/s
  load.push = pressure.value * g.area[k] + g.pull[k] + inertia * (met - rising);
  load.slope = pressure.slope * g.area[k] + inertia / s.dt;
  // Soil that is being compressed radiates waves: without that, a ball set down gently would sink as if it were dropped.
  if (rising < 0 && medium.ground) {
    load.push -= medium.ground_damping * g.area[k] * rising;
    load.slope += medium.ground_damping * g.area[k] / s.dt;
  }
  if (load.push <= 0) load.push = load.slope = 0;  // soil does not pull
  load.arm = {g.x[k] - position.x, g.y[k] - position.y, under.height - position.z};

  // Shear displacement grows with slip against the column, which goes up and down with the underside, until the soil slides
  // [Janosi & Hanamoto]; the body's own friction can slide before.
  const Vec3d slip = minus_normal_part(velocity + cross(spin, load.arm) - Vec3d{0, 0, rising}, under.normal);
  load.shear = g.shear[k] + s.dt * slip;
  const double j = length(load.shear), most = laws::kSlideShear * medium.shear_modulus;
  if (j > most) load.shear *= most / j;
  const double contact_area = g.area[k] / steep, normal_force = load.push * length(load.lift);
  load.grip = std::min(laws::shear_strength<double>(medium, normal_force / contact_area) * contact_area,
                       body.friction * normal_force);
  return true;
}

// Adds d * J^T D J, with J the map from the body's motion to that of the contact along a unit direction.
void add_direction(Matrix6& a, const Vec3d& arm, const Vec3d& direction, double stiffness) {
  const Vec3d turn = cross(arm, direction);
  const Vector6 j{direction.x, direction.y, direction.z, turn.x, turn.y, turn.z};
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c <= r; ++c) a.row[r][c] += stiffness * j[r] * j[c];
}

void add_force(Vector6& impulse, const Vec3d& arm, const Vec3d& force, double dt) {
  const Vec3d moment = cross(arm, force);
  const Vector6 f{force.x, force.y, force.z, moment.x, moment.y, moment.z};
  for (int r = 0; r < 6; ++r) impulse[r] += dt * f[r];
}

void add_load(const Load& load, const laws::Medium& medium, double dt, Vector6& impulse, Matrix6& a) {
  add_force(impulse, load.arm, load.push * load.lift, dt);
  add_direction(a, load.arm, load.lift, load.slope * dt * dt);
  const double j = length(load.shear);
  // Shear force and its slope along the slip; across it the slope is force over displacement.
  const double share = laws::mobilised_shear<double>(medium, j);
  const double secant = j > 0 ? load.grip * share / j : load.grip / medium.shear_modulus;
  add_force(impulse, load.arm, -secant * load.shear, dt);
  const Vec3d level = minus_normal_part({1, 0, 0}, load.normal);
  const Vec3d along = unit_or(load.shear, unit_or(level, {0, 1, 0}));
  const Vec3d across = cross(load.normal, along);
  const bool slides = j >= laws::kSlideShear * medium.shear_modulus * (1 - 1e-9);
  const double tangent = slides ? 0 : load.grip * (1 - share) / medium.shear_modulus;
  add_direction(a, load.arm, along, tangent * dt * dt);
  add_direction(a, load.arm, across, secant * dt * dt);
}

// The direction in which the soil pushes the body as a whole, 0 where it does not.
Vec3d push_direction(const state::Body& body, const Ground& ground, const Vec3d& v, const Vec3d& w, const Situation& s) {
  Vec3d sum;
  Load load;
  for (std::size_t k = 0; k < ground.vertex.size(); ++k)
    if (load_of(body, ground, k, body.position + s.dt * v, v, w, s, load)) sum += load.push * load.lift;
  return unit_or(sum, {});
}

// Newton's law of impact on top of the soil's plastic answer: once the soil has stopped the body, the share of the speed
// of impact that restitution asks for comes back. Soil alone would return next to nothing.
void rebound(state::Body& body, const Ground& ground, const Vec3d& before, const Situation& s) {
  const Vec3d up = push_direction(body, ground, body.velocity, body.angular_velocity, s);
  if (up == Vec3d{}) return;
  const double resting = 2 * length(s.gravity) * s.dt;  // what gravity alone brings is no impact
  const double approach = -dot(before, up);
  if (!body.touching && approach > resting) body.impact_speed = approach;
  const double leaving = dot(body.velocity, up);
  if (body.impact_speed == 0 || leaving < -0.02 * body.impact_speed) return;
  const laws::Medium& medium = s.media[ground.material[ground.deepest]];
  const double wanted = body.restitution * medium.restitution * body.impact_speed;
  if (wanted > std::max(leaving, resting)) body.velocity += (wanted - leaving) * up;
  body.impact_speed = 0;
}

}  // namespace

void meet_soil(state::Body& body, const Ground& ground, const Situation& s) {
  const Vec3d before = body.velocity;
  const double dt = s.dt;
  const Vec3d v0 = body.velocity + dt * s.gravity, w0 = body.angular_velocity;
  Vec3d v = v0, w = w0;
  Load load;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    // Residual of momentum and its slope at the trial velocities.
    Vector6 b{body.mass * (v0.x - v.x), body.mass * (v0.y - v.y), body.mass * (v0.z - v.z),
              body.inertia * (w0.x - w.x), body.inertia * (w0.y - w.y), body.inertia * (w0.z - w.z)};
    Matrix6 a;
    for (int r = 0; r < 6; ++r) a.row[r][r] = r < 3 ? body.mass : body.inertia;
    const Vec3d position = body.position + dt * v;
    bool touches = false;
    for (std::size_t k = 0; k < ground.vertex.size(); ++k) {
      if (!load_of(body, ground, k, position, v, w, s, load)) continue;
      add_load(load, s.media[ground.material[k]], dt, b, a);
      touches = true;
    }
    if (!touches && iteration == 0) break;
    solve(a, b);
    // Later iterations go half way: a column that comes and goes must not make them swing for ever.
    const double stride = iteration < kMostIterations / 2 ? 1 : 0.5;
    v += stride * Vec3d{b[0], b[1], b[2]};
    w += stride * Vec3d{b[3], b[4], b[5]};
    const double change = dt * (std::abs(b[0]) + std::abs(b[1]) + std::abs(b[2]) + body.radius * (std::abs(b[3]) + std::abs(b[4]) + std::abs(b[5])));
    if (change < 1e-9 * s.surface.spacing) break;
  }
  body.velocity = v;
  body.angular_velocity = w;
  rebound(body, ground, before, s);
}

void record_presses(state::Body& body, const Ground& ground, const Situation& s, std::vector<Press>& presses) {
  presses.clear();
  body.sinkage = 0;
  body.last_vertex = kNone;
  double area = 0, deepest = 0;
  Load load;
  for (std::size_t k = 0; k < ground.vertex.size(); ++k) {
    if (!load_of(body, ground, k, body.position, body.velocity, body.angular_velocity, s, load)) continue;
    const Vec3d slid = load.shear - ground.shear[k];
    presses.push_back({ground.vertex[k],
                       to_float({ground.x[k] + slid.x, ground.y[k] + slid.y, ground.fresh[k] - load.sinkage}),
                       to_float(load.shear), static_cast<float>(load.plastic)});
    area += ground.area[k];
    body.sinkage = std::max(body.sinkage, ground.original[k] - (ground.fresh[k] - load.sinkage));
    if (body.last_vertex == kNone || load.sinkage > deepest) deepest = load.sinkage, body.last_vertex = ground.vertex[k];
  }
  body.touching = !presses.empty();
  body.patch_width = std::sqrt(area / std::numbers::pi);
  body.max_sinkage = std::max(body.max_sinkage, body.sinkage);
}

}  // namespace divot::contact
