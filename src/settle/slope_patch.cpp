#include "settle/slope_patch.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "laws/slope.h"

namespace divot::settle {
namespace {

// Ground that moves faster than this share of what falls by a spacing has not come down yet.
constexpr double kFast = 0.1;
// Intact ground that was steeper than loose soil stands holds up to so many times its slope.
constexpr double kToSpare = 1.1;
// Soil that lies thinner than this share of a spacing does not slide by itself.
constexpr double kThinnest = 1e-3;
constexpr double kNoCeiling = std::numeric_limits<double>::infinity();
constexpr std::size_t kGrain = 256;

// A body has it, a blast makes it flow, or it moves as fast as what slides: `fast`, m^2/s^2.
bool is_held(const Ground& ground, double fast, std::uint32_t vertex) {
  const std::uint32_t column = ground.surface.column[vertex];
  if (column == kNone) return false;
  const std::uint32_t i = ground.soil.particle[column];
  const state::Particles& p = ground.particles;
  if (i == kNone || p.hold[i] == Hold::anchor) return false;
  return p.hold[i] == Hold::carried || p.flow_rate[i] > 0 || dot(p.velocity(i), p.velocity(i)) > fast;
}

}  // namespace

double SlopePatch::Flat::size() const { return std::sqrt(x * x + y * y); }

template <class Height>
SlopePatch::Flat SlopePatch::gradient(const Face& face, const Height& height) const {
  // Differences, as heights are large and slopes small.
  const double low = height(corners_[face.corner[0]]);
  const double a = height(corners_[face.corner[1]]) - low, b = height(corners_[face.corner[2]]) - low;
  return {a * face.pull[1].x + b * face.pull[2].x, a * face.pull[1].y + b * face.pull[2].y};
}

SlopePatch::Face SlopePatch::make_face(const Ground& ground, double fast, std::uint32_t id) const {
  const state::Surface& surface = ground.surface;
  Face face;
  std::array<Vec3d, 3> p, then;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = surface.mesh.origin(3 * id + k), column = surface.column[vertex];
    face.corner[k] = set_.index_of(vertex);
    if (is_held(ground, fast, vertex)) return face;
    p[k] = to_double(surface.position[vertex]);
    then[k] = column == kNone ? p[k] : to_double(ground.soil.original[column]);
  }
  const auto shadow = [](const std::array<Vec3d, 3>& q) {
    return (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[1].y - q[0].y) * (q[2].x - q[0].x);
  };
  const double area = shadow(p);
  if (!(area > 0)) return face;
  face.area = area;
  double longest = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3d &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
    face.pull[k] = {(a.y - b.y) / area, (b.x - a.x) / area};
    longest = std::max(longest, (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }
  face.stable = area * area / (6 * longest);
  if (const double before = shadow(then); before > 0) {
    const Vec3d u = then[1] - then[0], v = then[2] - then[0];
    face.before = Flat{(u.z * v.y - v.z * u.y) / before, (v.z * u.x - u.z * v.x) / before}.size();
  }
  return face;
}

// Soil that slides does not lift a body off its bed, nor creep in below it.
void SlopePatch::lower_ceilings(const Ground& ground, const state::Body& body) {
  if (body.near.empty()) return;
  posed_.place(*body.solid, body.position, body.orientation);
  for (const std::uint32_t vertex : body.near) {
    const std::uint32_t k = set_.index_of(vertex);
    if (k == kNone) continue;
    const Vec3 place = ground.surface.position[vertex];
    const geometry::Underside over = posed_.underside(place.x, place.y);
    if (over.below) corners_[k].ceiling = std::min(corners_[k].ceiling, over.height);
  }
}

void SlopePatch::build(const Ground& ground, const SlopeLaws& slope_laws, std::span<const state::Body> bodies,
                       std::span<const std::uint32_t> faces, const Jobs& jobs) {
  const state::Surface& surface = ground.surface;
  spacing_ = surface.spacing;
  for (const std::uint32_t face : faces)
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) set_.insert(surface.mesh.origin(h));
  set_.list(vertices_);
  corners_.resize(vertices_.size());
  const auto make_corners = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t v = vertices_[k], column = surface.column[v];
      const double z = surface.position[v].z;
      Corner& c = corners_[k];
      c = {.now = z, .then = z, .area = state::vertex_area(surface, v), .material = surface.material[v]};
      if (column == kNone) continue;
      c.then = ground.soil.original[column].z;
      c.loose = ground.soil.loose[column], c.excess = ground.soil.excess[column];
    }
  };
  jobs.for_ranges(vertices_.size(), kGrain, std::ref(make_corners));  // by reference: a copy would be an allocation
  for (const state::Body& body : bodies) lower_ceilings(ground, body);
  const double fast = kFast * kFast * slope_laws.gravity * spacing_;
  faces_.resize(faces.size()), slides_.resize(faces.size());
  const auto make_faces = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) faces_[k] = make_face(ground, fast, faces[k]);
  };
  jobs.for_ranges(faces.size(), kGrain, std::ref(make_faces));
  set_.clear();

  std::erase_if(faces_, [](const Face& face) { return face.area == 0; });
  first_.assign(vertices_.size() + 2, 0);
  for (const Face& face : faces_)
    for (const std::uint32_t c : face.corner) ++first_[c + 2];
  for (std::size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
  meets_.resize(3 * faces_.size());
  for (std::uint32_t k = 0; k < faces_.size(); ++k)
    for (std::uint32_t j = 0; j < 3; ++j) meets_[first_[faces_[k].corner[j] + 1]++] = 3 * k + j;
  rose_.resize(vertices_.size());
}

SlopePatch::Slide SlopePatch::look_at(const SlopeLaws& slope_laws, const Face& face) const {
  const Flat g = gradient(face, [](const Corner& c) { return c.now; });
  const double slope = g.size();
  // The soil at the highest corner is what would slide.
  std::uint32_t highest = 0;
  for (std::uint32_t k = 1; k < 3; ++k)
    if (corners_[face.corner[k]].now > corners_[face.corner[highest]].now) highest = k;
  const Corner& top = corners_[face.corner[highest]];
  const laws::Medium& medium = slope_laws.media[top.material];
  if (slope <= medium.tan_repose + laws::kAtRest) return {};
  if (const double stands = slope_laws.stands[top.material]; stands > 0)
    if (laws::counted_height(top.excess, slope, medium.tan_repose) <= stands) return {};
  // Intact ground rests as it stood before anything touched it, with a little to spare, or else a pit in a steep slope
  // would pull down all that lies above it, to the top.
  const double intact = face.before > medium.tan_repose ? kToSpare * face.before : medium.tan_repose;
  const double below = gradient(face, [](const Corner& c) { return c.now - c.loose; }).size();
  const bool only_loose = std::min(slope, below) <= intact + laws::kAtRest;
  if (only_loose && top.loose <= kThinnest * spacing_) return {};
  const double rest = only_loose ? medium.tan_repose : intact;

  double low = top.now, height = 0;
  for (const std::uint32_t c : face.corner) {
    low = std::min(low, corners_[c].now);
    height = std::max(height, std::abs(corners_[c].now - corners_[c].then));
  }
  // Soil that a flow through the face brings to each of its corners: linear finite elements. Next to rest the root is
  // steep: no more flows than evens out what the corners' slopes differ by.
  const double root = laws::root_of_excess(slope, rest), share = 0.5 * face.area * root;
  Slide slide{.wanted = laws::slide_mobility(std::max(height, top.now - low), slope_laws.gravity),
              .most = face.stable * root};
  for (std::uint32_t k = 0; k < 3; ++k) {
    slide.share[k] = -share * (g.x * face.pull[k].x + g.y * face.pull[k].y);
    const Corner& c = corners_[face.corner[k]];
    if (slide.share[k] <= 0 || c.ceiling == kNoCeiling) continue;
    const double room = c.ceiling - c.now;
    if (room <= kThinnest * spacing_) return {};
    slide.most = std::min(slide.most, room * face.area / 6 / slide.share[k]);
  }
  // What lies loose on ground that stands goes, but takes none of that ground along: the face's part of the column.
  if (const double leaves = -slide.share[highest]; only_loose && leaves > 0)
    slide.most = std::min(slide.most, top.loose * face.area / 6 / leaves);
  return slide;
}

// Bound by arithmetic, mostly two square roots and a few divisions a face: the corners it reads stay in cache.
double SlopePatch::find_slides(const SlopeLaws& slope_laws, double dt, const Jobs& jobs) {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) slides_[k] = look_at(slope_laws, faces_[k]);
  };
  jobs.for_ranges(faces_.size(), kGrain, std::ref(work));
  double most = 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) most = std::max(most, slides_[k].wanted * dt / faces_[k].stable);
  return most;
}

float SlopePatch::slide(double dt, const Jobs& jobs) {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Corner& c = corners_[v];
      double comes = 0;
      for (std::uint32_t m = first_[v]; m < first_[v + 1]; ++m) {
        const Slide& slide = slides_[meets_[m] / 3];
        if (slide.wanted == 0) continue;
        c.moved = true;
        comes += std::min(slide.wanted * dt, slide.most) * slide.share[meets_[m] % 3];
      }
      const double rises = c.area > 0 ? comes / c.area : 0;  // as bring() has it
      c.came += comes, c.now += rises;
      c.loose = std::max(0.0, c.loose + rises);
      rose_[v] = static_cast<float>(std::abs(rises));
    }
  };
  jobs.for_ranges(corners_.size(), kGrain, std::ref(work));
  return rose_.empty() ? 0 : *std::max_element(rose_.begin(), rose_.end());
}

}  // namespace divot::settle
