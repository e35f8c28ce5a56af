#include "contact/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/near.h"
#include "laws/bekker.h"
#include "laws/passive_pressure.h"

namespace divot::contact {
namespace {

double fresh_height(const Situation& s, std::uint32_t vertex) {
  const std::uint32_t column = s.surface.column[vertex];
  return column == kNone ? s.surface.position[vertex].z : s.soil.fresh_height(column);
}

// Unit normal, upward, of the ground at a vertex as it would be unpressed.
Vec3d fresh_normal(const Situation& s, std::uint32_t vertex) {
  const auto at = [&](std::uint32_t v) {
    const Vec3 p = s.surface.position[v];
    return Vec3d{p.x, p.y, fresh_height(s, v)};
  };
  const Vec3d p = at(vertex);
  Vec3d sum;
  s.surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    sum += cross(at(s.surface.mesh.target(h)) - p, at(s.surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))) - p);
  });
  const double l = length(sum);
  return l > 0 && sum.z > 0 ? sum * (1 / l) : Vec3d{0, 0, 1};
}

Footing footing_at(std::uint32_t vertex, const Situation& s) {
  const Vec3 p = s.surface.position[vertex];
  Footing f{.vertex = vertex, .material = s.surface.material[vertex], .x = p.x, .y = p.y, .vertex_position = p};
  f.arm_x = f.x, f.arm_y = f.y;
  f.height = f.fresh = f.original = p.z;
  const std::uint32_t column = s.surface.column[vertex];
  if (column == kNone) {
    f.area = state::cell_area(s.surface, vertex);
  } else {
    f.height = std::max(p.z, s.soil.rest[column].z);
    f.fresh = s.soil.fresh_height(column);
    f.original = s.soil.original[column].z;
    f.plastic = s.soil.plastic[column];
    f.area = s.soil.cell[column];
    f.shear = to_double(s.soil.shear[column]);
    const std::uint32_t i = s.soil.particle[column];
    f.carried = i != kNone && s.particles.hold[i] == Hold::carried;
    if (i != kNone) f.speed = s.particles.vz[i];
    if (f.carried) f.pull = s.particles.held_pull[i];
  }
  f.mass = s.media[f.material].areal_mass * f.area;
  return f;
}

const Press* find_press(const std::vector<Press>& last, std::uint32_t vertex) {
  const auto at =
      std::lower_bound(last.begin(), last.end(), vertex, [](const Press& p, std::uint32_t v) { return p.vertex < v; });
  return at != last.end() && at->vertex == vertex ? &*at : nullptr;
}

// Meets a column at x, y instead of at its vertex, on the plane of the unpressed ground there.
void meet_at(const Situation& s, double x, double y, Footing& f) {
  const Vec3d normal = fresh_normal(s, f.vertex);
  const double rise = -(normal.x * (x - f.x) + normal.y * (y - f.y)) / normal.z;
  f.x = f.arm_x = x, f.y = f.arm_y = y;
  for (double* height : {&f.above_vertex, &f.height, &f.fresh, &f.original}) *height += rise;
}

std::vector<Footing>::iterator nearest_to(double x, double y, std::vector<Footing>& footings) {
  const auto squared = [&](const Footing& f) { return (f.x - x) * (f.x - x) + (f.y - y) * (f.y - y); };
  return std::min_element(footings.begin(), footings.end(),
                          [&](const Footing& a, const Footing& b) { return squared(a) < squared(b); });
}

// Share of a column's distance from the line of touch that it keeps in soft ground: a truck's way then depends least on
// the grid's spacing. At 1 wheels that run along the grid are off most, at 0 those that cross it.
constexpr double kRolledAside = 0.5;

// A line of touch from above.
struct Line {
  double x, y, dx, dy, squared;

  explicit Line(const geometry::Ridge& r)
      : x(r.from.x), y(r.from.y), dx(r.to.x - x), dy(r.to.y - y), squared(dx * dx + dy * dy) {}
  // Where along it a column's foot is, from 0 to 1, or beyond its ends.
  double along(const Footing& f) const { return ((f.x - x) * dx + (f.y - y) * dy) / squared; }
  double foot(const Footing& f) const { return std::clamp(along(f), 1e-6, 1 - 1e-6); }
  // How far a column is left of it, in lengths of the line.
  double beside(const Footing& f) const { return ((f.y - y) * dx - (f.x - x) * dy) / squared; }
  double distance(const Footing& f, double at) const { return std::hypot(f.x - x - at * dx, f.y - y - at * dy); }
};

// The columns beside the line that are nearest to their own foot on it. By distance, not by cells: where the shear has
// drawn vertices apart, a wheel would find the gap between two cells. What stands past the line's ends, as in the wall
// of a wheel's rut, is only met where nothing else is beside the line.
void choose_on_line(const Line& line, double spacing, const std::vector<Footing>& footings,
                    std::vector<std::uint32_t>& beside, std::vector<std::uint32_t>& chosen) {
  beside.clear(), chosen.clear();
  for (std::uint32_t k = 0; k < footings.size(); ++k)
    if (line.distance(footings[k], line.foot(footings[k])) < spacing) beside.push_back(k);
  const auto is_past = [&](std::uint32_t k) { return line.along(footings[k]) != line.foot(footings[k]); };
  if (!std::all_of(beside.begin(), beside.end(), is_past))
    beside.erase(std::remove_if(beside.begin(), beside.end(), is_past), beside.end());
  for (const std::uint32_t own : beside) {
    const double at = line.foot(footings[own]), near = line.distance(footings[own], at);
    const bool beaten = std::any_of(beside.begin(), beside.end(), [&](std::uint32_t other) {
      const double distance = line.distance(footings[other], at);
      return distance < near || (distance == near && other < own);
    });
    if (!beaten) chosen.push_back(own);
  }
}

// Each column carries the part of the line that is nearer to its foot than to any other's, in the middle of that, with
// such a share of the area of all: where feet stand unevenly, a wheel that crosses the grid at an angle would tilt to
// and fro otherwise, and brake and turn by that. It keeps `aside` of its distance from the line.
void share_line(const Line& line, double aside, const Situation& s, std::vector<Footing>& footings,
                std::vector<std::uint32_t>& chosen) {
  std::sort(chosen.begin(), chosen.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = line.foot(footings[a]), at_b = line.foot(footings[b]);
    return at_a != at_b ? at_a < at_b : a < b;
  });
  double area = 0, from = 0;
  for (const std::uint32_t k : chosen) area += footings[k].area;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    Footing& f = footings[chosen[i]];
    const double to = i + 1 < chosen.size() ? 0.5 * (line.foot(f) + line.foot(footings[chosen[i + 1]])) : 1;
    const double middle = 0.5 * (from + to), beside = aside * line.beside(f);
    f.area = std::max((to - from) * area, 0.01 * f.area);
    meet_at(s, line.x + middle * line.dx - beside * line.dy, line.y + middle * line.dy + beside * line.dx, f);
    from = to;
  }
}

// How much of its distance from the line of touch a column keeps under a patch so wide, m.
double kept_aside(double patch_width, double spacing) {
  return kRolledAside * std::clamp(patch_width / spacing - 1, 0.0, 1.0);
}

// Vertices sample the ground too coarsely for a hard ball or wheel on hard ground: it would drop between them. The
// columns that its line of touch runs through are therefore met on that line instead of at their vertices. Where the
// ground is so soft that the patch is several columns wide, nearer to their vertices: on the line itself a wheel would
// find the last of its way down done without having pushed forward for it, and roll too easily; at the vertex it would
// drop whenever it leaves one. To count only the part of a cell before the line was tried: wheels sank too deep.
void meet_on_ridge(const geometry::PosedPiece& piece, const state::Body& body, const Situation& s,
                   Scratch::PerBody& scratch) {
  std::vector<Footing>& footings = scratch.footings;
  const Vec3d middle = 0.5 * (piece.low + piece.high);
  const auto below = nearest_to(middle.x, middle.y, footings);
  const auto ridge = piece.ridge(fresh_normal(s, below->vertex));
  if (!ridge) return;
  const Line line(*ridge);
  if (line.squared < 1e-12) {
    // Of a round patch the width is its radius; a square as large has this side.
    const double half = 0.5 * body.spacing, side = std::sqrt(std::numbers::pi) * body.patch_width;
    const double aside = kept_aside(side, body.spacing);
    const auto touched = nearest_to(line.x, line.y, footings);
    if (std::abs(touched->x - line.x) <= half && std::abs(touched->y - line.y) <= half)
      meet_at(s, line.x + aside * (touched->x - line.x), line.y + aside * (touched->y - line.y), *touched);
    return;
  }
  choose_on_line(line, body.spacing, footings, scratch.found, scratch.ring);
  share_line(line, kept_aside(body.patch_width, body.spacing), s, footings, scratch.ring);
}

// From `start` over the half-edges to the vertex nearest to x, y.
std::uint32_t walk_to(const state::Surface& surface, std::uint32_t start, double x, double y) {
  const auto squared = [&](std::uint32_t v) {
    const double dx = surface.position[v].x - x, dy = surface.position[v].y - y;
    return dx * dx + dy * dy;
  };
  std::uint32_t at = start;
  for (bool moved = true; moved;) {
    moved = false;
    double best = squared(at);
    const std::uint32_t here = at;
    surface.mesh.for_each_neighbour(here, [&](std::uint32_t u) {
      if (const double d = squared(u); d < best) best = d, at = u, moved = true;
    });
  }
  return at;
}

Footing* find_footing(std::vector<Footing>& footings, std::uint32_t vertex) {
  const auto at = std::lower_bound(footings.begin(), footings.end(), vertex,
                                   [](const Footing& f, std::uint32_t v) { return f.vertex < v; });
  return at != footings.end() && at->vertex == vertex ? &*at : nullptr;
}

// Columns are met no nearer to a body's edge than this share of a cell, so that a wall which leans out a little, as
// when a box has tilted, is not taken for the underside. Steeper than kFlat it is none.
constexpr double kInside = 0.25, kFlat = 0.5;
// A column comes under a body when it lies outside by this share of a cell, and stays under it until it does by that:
// one on the line of a wheel's side would rise and be pressed again with the faintest turn, by the depth of the rut.
constexpr double kComes = 0.05, kStays = 0.25;

// The column well inside the outline that takes over what the body covers of the cell at `f`, outside of it.
Footing* heir_of(const geometry::PosedPiece& piece, const Footing& f, double width, const state::Surface& surface,
                 std::vector<Footing>& footings) {
  double x = f.x, y = f.y;
  Vec3d away;
  // A corner is left in one direction after the other.
  for (int turn = 0; turn < 3; ++turn) {
    const double out = piece.outside(x, y, away);
    if (out <= -0.49 * width) break;
    x -= away.x * (out + 0.5 * width), y -= away.y * (out + 0.5 * width);
  }
  return find_footing(footings, walk_to(surface, f.vertex, x, y));
}

// The soil of the cell at `f`, which stands before the edge of a flat underside at a height of `foot`.
Wall wall_at(const Footing& f, const Vec3d& away, double out, double width, double foot,
             const geometry::PosedPiece& piece, const Vec3d& centre, const Situation& s) {
  const double height = std::min(f.height, piece.high.z) - foot;
  const std::uint32_t column = s.surface.column[f.vertex];
  const double loose = column == kNone ? 0.0 : s.soil.loose[column];
  // Its pressure grows with depth and so acts a third up.
  const Vec3d arm = Vec3d{f.x - out * away.x, f.y - out * away.y, foot + height / 3} - centre, turn = cross(arm, away);
  return {{away.x, away.y, 0, turn.x, turn.y, turn.z},
          width * laws::passive_force(s.media[f.material], height, loose, length(s.gravity))};
}

// Where the edge of a body stands in the ground it cuts through cells. Each column then counts with the area that is
// covered and pushes in its middle; what is covered of cells whose vertices lie outside goes to the nearest column
// inside, as only those are pressed. A plate's area and its balance are therefore exact on any grid, and steady when it
// slides. Meeting the columns in those middles was tried: as these wander, the ground's memory of what pressed it did
// not fit any more, and plates crept.
void cover(const geometry::PosedSolid& body, double travel, const Situation& s, Scratch::PerBody& scratch) {
  std::vector<Footing>& footings = scratch.footings;
  std::vector<geometry::Cover>& covers = scratch.covers;
  covers.assign(footings.size(), {}), scratch.walls.clear();
  const auto add = [&](std::size_t k, const geometry::Cover& c, double sign) {
    covers[k].area += sign * c.area, covers[k].x += sign * c.area * c.x, covers[k].y += sign * c.area * c.y;
  };
  bool any = false;
  for (const geometry::PosedPiece& piece : body.pieces()) {
    for (std::size_t k = 0; k < footings.size(); ++k) {
      Footing& f = footings[k];
      const double width = std::sqrt(f.area);
      Vec3d away;
      const double out = piece.outside(f.x, f.y, away);
      if (out < -0.71 * width || out > width) continue;
      // Is it the edge of a flat side, in the ground, or may it come there?
      const double inward = out + kInside * width;
      const geometry::Underside edge = piece.underside(f.x - away.x * inward, f.y - away.y * inward);
      if (!edge.below || -edge.normal.z < kFlat || edge.height >= f.height + travel) continue;
      // One row of cells stands before each side.
      if (out > 0 && edge.height < f.height && s.media[f.material].ground)
        scratch.walls.push_back(wall_at(f, away, out, width, edge.height, piece, body.position(), s));
      if (out > 0.71 * width) continue;
      any = true;
      const geometry::Cover covered = piece.covered(f.x, f.y, width);
      if (out <= kComes * width || (out < kStays * width && find_press(scratch.presses, f.vertex) != nullptr)) {
        add(k, covered, 1), add(k, {f.area, f.vertex_position.x, f.vertex_position.y}, -1);
        // The edge itself may move outward of the vertex within the step.
        const double nudge = std::max(0.0, out + kInside * width);
        f.x -= away.x * nudge, f.y -= away.y * nudge;
      } else if (const Footing* heir = heir_of(piece, f, width, s.surface, footings);
                 heir != nullptr && piece.underside(heir->x, heir->y).below) {
        add(static_cast<std::size_t>(heir - footings.data()), covered, 1);
      }
    }
  }
  if (!any) return;
  for (std::size_t k = 0; k < footings.size(); ++k) {
    Footing& f = footings[k];
    if (covers[k].area == 0 && covers[k].x == 0 && covers[k].y == 0) continue;
    const Vec3 own = f.vertex_position;
    add(k, {f.area, own.x, own.y}, 1);
    const double least = 0.01 * f.area, area = covers[k].area;
    f.area = std::max(area, least);
    if (area > least) f.arm_x = covers[k].x / area, f.arm_y = covers[k].y / area;
  }
}

// A body smaller than the cells may be over no vertex: the nearest column is met under its lowest point then, with the
// area that the body covers.
void meet_small_body(const geometry::PosedSolid& body, double spacing, const Situation& s,
                     std::vector<Footing>& footings) {
  for (const geometry::PosedPiece& piece : body.pieces()) {
    const auto over = [&](const Footing& f) { return piece.underside(f.x, f.y).below; };
    if (piece.piece().kind == geometry::Piece::Kind::sphere) continue;  // its ridge is met wherever it is
    if (std::any_of(footings.begin(), footings.end(), over)) continue;
    const Vec3d low = piece.lowest();
    const auto touched = nearest_to(low.x, low.y, footings);
    if (std::hypot(touched->x - low.x, touched->y - low.y) > spacing) continue;
    // Just inside the outline, where the body is over it.
    const Vec3d middle = 0.5 * (piece.low + piece.high);
    meet_at(s, low.x + 1e-3 * (middle.x - low.x), low.y + 1e-3 * (middle.y - low.y), *touched);
    touched->area = std::min(touched->area, (piece.high.x - piece.low.x) * (piece.high.y - piece.low.y));
  }
}

// Ground that stands deeper than the pressure of the last step explains must not throw the body out. Where this body
// pressed it, the rest is slack. What comes under it deep down counts as pressed for good, be it that the body was born
// in the ground, that its edge moved over a column or that a lip rose; but it answers with the mean pressure under the
// body, else a plate whose edge plays over the columns would lose its support, and creep.
void take_up_slack(const state::Body& body, const geometry::PosedSolid& posed, const Situation& s,
                   const std::vector<Press>& last, double mean_pressure, Footing& f) {
  const geometry::Underside under = posed.underside(f.x, f.y);
  if (!under.below || under.height >= f.height) return;
  const laws::Medium& medium = s.media[f.material];
  const double sunk = f.fresh - under.height;
  if (f.carried) {
    const Press* press = find_press(last, f.vertex);
    const double elastic = (press ? press->pressure : 0.0) / medium.elastic_stiffness;
    f.slack = std::max(0.0, sunk - f.plastic - elastic);
    f.fresh -= f.slack;
  } else {
    const double width = std::max(body.patch_width, 0.5 * body.spacing);
    const double pressure = std::min(laws::bekker_pressure<double>(medium, sunk, width), mean_pressure);
    f.plastic = std::max(f.plastic, sunk - pressure / medium.elastic_stiffness);
  }
}

// Across the plane that lies nearest to the unpressed ground within the body's reach, 1 high.
Vec3d across_ground(const std::vector<Footing>& footings, double spacing) {
  double x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  const Footing& first = footings.front();
  for (const Footing& f : footings) {
    const double dx = f.x - first.x, dy = f.y - first.y, dz = f.fresh - first.fresh;
    x += dx, y += dy, z += dz;
    xx += dx * dx, xy += dx * dy, yy += dy * dy, xz += dx * dz, yz += dy * dz;
  }
  // A few columns in a row say nothing of the slope across it: level there.
  const auto n = static_cast<double>(footings.size());
  const double least = 1e-3 * spacing * spacing;
  xx += least - x * x / n, yy += least - y * y / n, xy -= x * y / n, xz -= x * z / n, yz -= y * z / n;
  const double det = xx * yy - xy * xy;
  return {-(xz * yy - yz * xy) / det, -(yz * xx - xz * xy) / det, 1};
}

}  // namespace

void gather(const state::Body& body, const Situation& s, Scratch::PerBody& scratch) {
  std::vector<Footing>& footings = scratch.footings;
  footings.clear(), scratch.walls.clear();
  const double reach = step_reach(body, s);
  for (const std::uint32_t vertex : body.near)
    if (scratch.start.within_reach(s.surface.position[vertex], reach)) footings.push_back(footing_at(vertex, s));
  if (footings.empty()) return;
  scratch.end.place(*body.solid, body.position + s.dt * body.velocity,
                    math::spun(body.orientation, body.angular_velocity, s.dt), true);
  cover(scratch.end, reach - 0.5 * body.spacing, s, scratch);
  for (const geometry::PosedPiece& piece : scratch.end.pieces()) meet_on_ridge(piece, body, s, scratch);
  meet_small_body(scratch.end, body.spacing, s, footings);
  double sum = 0;
  for (const Press& press : scratch.presses) sum += press.pressure;
  const double mean = scratch.presses.empty() ? 0 : sum / static_cast<double>(scratch.presses.size());
  scratch.ground = across_ground(footings, body.spacing);
  for (Footing& f : footings) take_up_slack(body, scratch.start, s, scratch.presses, mean, f);
}

}  // namespace divot::contact
