#include "events/scaled_blast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "events/targets.h"
#include "events/together.h"
#include "laws/crater.h"
#include "laws/crust.h"

namespace divot::events {
namespace {

// The crater of the burst in each soil of the terrain.
struct Sizes {
  std::vector<laws::CraterSize> of;  // [material]
  std::vector<double> leaves;        // [material] share of its volume that does not stay below it
  double largest = 0;                // m, radius
  bool heaves = false;               // some soil cannot be compacted as much as it sinks
};

Sizes crater_sizes(const Burst& burst, std::span<const laws::Medium> media) {
  Sizes sizes;
  for (const laws::Medium& m : media) {
    const laws::CraterSize size = laws::scaled_crater(burst.yield, burst.height, m, burst.gravity);
    const double buried = std::max(0.0, -burst.height);
    const double leaves = size.radius > 0 ? laws::leaving_share(size, buried, m.compaction_limit) : 0;
    sizes.of.push_back(size);
    sizes.leaves.push_back(leaves);
    sizes.largest = std::max(sizes.largest, size.radius);
    sizes.heaves |= leaves > size.lip_share;
  }
  return sizes;
}

// Where the crater ends, all round: where soils differ, the mean of their craters, squared and weighted by the ground
// that each covers in a direction.
class Edge {
 public:
  Edge(const Sizes& sizes, std::span<const Target> reached, const state::Surface& surface) {
    std::array<double, kSectors> area{}, squares{};
    for (const Target& t : reached) {
      if (t.radius > sizes.largest) continue;
      const double own = sizes.of[surface.material[t.vertex]].radius, a = state::vertex_area(surface, t.vertex);
      const auto sector = static_cast<std::size_t>(place(t)) % kSectors;
      area[sector] += a, squares[sector] += a * own * own;
    }
    for (std::size_t k = 0; k < kSectors; ++k)
      radius_[k] = area[k] > 0 ? std::sqrt(squares[k] / area[k]) : sizes.largest;
  }
  double radius(const Target& t) const {
    const double at = place(t) + kSectors - 0.5, part = at - std::floor(at);
    const auto first = static_cast<std::size_t>(at) % kSectors;
    return (1 - part) * radius_[first] + part * radius_[(first + 1) % kSectors];
  }

 private:
  static constexpr std::size_t kSectors = 16;
  // In sectors, [0, kSectors].
  static double place(const Target& t) {
    return std::clamp((std::atan2(t.y, t.x) / (2 * std::numbers::pi) + 0.5) * kSectors, 0.0, double{kSectors});
  }
  std::array<double, kSectors> radius_{};
};

// On a slope what is thrown flies further downhill: at 45 degrees its range along the ground goes with 1 + tan(slope).
double range(const state::Blast& blast, const Target& t) {
  const double flat = std::hypot(t.x, t.y), down = static_cast<double>(blast.direction.z);
  if (flat == 0) return 1;
  // The outward normal leans downhill.
  const double slope = (blast.direction.x * t.x + blast.direction.y * t.y) / (flat * down);
  return std::clamp(1 + slope, 0.25, 2.0);
}

// The charge's distance from ground that slopes is shorter than its height over it, and ground zero is the point next
// to it.
void face_slope(Burst& burst, state::Blast& blast, const state::Surface& surface, const geometry::Bvh& bvh,
                state::RegionScratch& scratch) {
  if (burst.height == 0) return;
  const float distance = static_cast<float>(burst.height) * -blast.direction.z;
  const Vec3 charge = blast.ground_zero + Vec3{0, 0, static_cast<float>(burst.height)};
  const Vec3 next = charge + distance * blast.direction;
  const state::SurfacePoint foot = state::surface_at(surface, bvh, next, scratch);
  if (!foot.found) return;
  blast.ground_zero = foot.position;
  burst.height = distance;
}

// What this charge breaks of the crusts around it is gone before the ground below answers.
void break_crusts(const Burst& burst, const state::Blast& blast, state::Surface& surface, const geometry::Bvh& bvh,
                  std::span<const laws::Medium> media, state::RegionScratch& scratch) {
  std::vector<double> radius(media.size(), 0.0);
  for (std::size_t m = 0; m < media.size(); ++m) {
    if (media[m].below != laws::kNoLayer)
      radius[m] = laws::broken_radius(media[m], media[media[m].below], burst.yield, burst.height, burst.gravity);
  }
  const double furthest = *std::max_element(radius.begin(), radius.end());
  if (furthest <= 0) return;
  for (const Target& t : targets(blast, furthest, surface, bvh, scratch)) {
    std::uint8_t& material = surface.material[t.vertex];
    while (t.radius < radius[material]) material = media[material].below;
  }
}

struct Landing {
  double ejecta = 0, upthrust = 0;  // m, of unit crests
};

// The crater that one of several charges would make.
struct Part {
  Sizes sizes;
  double weight;                // of its lip
  std::vector<Target> reached;  // the same vertices in all parts
  Edge edge;

  // How deep the ground fails, m; `sunk`: how far it has sunk already.
  double depth(std::size_t i, double sunk, std::uint8_t material) const {
    const laws::CraterSize& size = sizes.of[material];
    return size.radius > 0 ? size.depth * laws::crater_profile(reached[i].radius, reached[i].above + sunk, size.radius)
                           : 0;
  }
  // Raises what lands to its own.
  void land(std::size_t i, const state::Blast& blast, Landing& lands) const {
    const double end = edge.radius(reached[i]);
    if (end == 0) return;
    const double ratio = reached[i].radius / end;
    lands.ejecta = std::max(lands.ejecta, weight * laws::ejecta_profile(1 + (ratio - 1) / range(blast, reached[i])));
    if (sizes.heaves) lands.upthrust = std::max(lands.upthrust, weight * laws::upthrust_profile(ratio));
  }
};

// All parts with all vertices that one of them reaches from the place of the first.
std::vector<Part> parts_of(const std::vector<Charge>& charges, const state::Surface& surface, const geometry::Bvh& bvh,
                           std::span<const laws::Medium> media, state::RegionScratch& scratch) {
  std::vector<Sizes> sizes;
  double reach = 0, largest = 0;
  for (const Charge& charge : charges) {
    const Sizes& own = sizes.emplace_back(crater_sizes(charge.burst, media));
    const double away = length(charge.blast.ground_zero - charges.front().blast.ground_zero);
    reach = std::max(reach, away + (own.heaves ? laws::kUpthrustEnd : 2 * laws::kEjectaEnd) * own.largest);
    largest = std::max(largest, own.largest);
  }
  const std::vector<Target> reached = targets(charges.front().blast, reach, surface, bvh, scratch);
  std::vector<Part> parts;
  for (std::size_t k = 0; k < charges.size(); ++k) {
    std::vector<Target> own = reached;
    if (k > 0)
      for (Target& t : own) t = seen(charges[k].blast, t.vertex, surface);
    const Edge edge(sizes[k], own, surface);
    const double weight = sizes[k].largest / largest;
    parts.push_back({std::move(sizes[k]), weight, std::move(own), edge});
  }
  return parts;
}

// Heights for each m^3 that lands: the shapes of both kinds, each with its share of what leaves the crater.
void set_heights(state::Blast& blast, const std::vector<Landing>& landing, double thrown, double heaved,
                 const state::Soil& soil) {
  double ejecta = 0, upthrust = 0;
  for (std::size_t k = 0; k < landing.size(); ++k) {
    const double area = soil.area[blast.landing[k]];
    ejecta += landing[k].ejecta * area, upthrust += landing[k].upthrust * area;
  }
  // On a mesh too coarse for the lip there may be room for one kind only.
  if (ejecta == 0) heaved += thrown, thrown = 0;
  if (upthrust == 0) thrown += heaved, heaved = 0;
  const double all = thrown + heaved;
  for (const Landing& one : landing) {
    const double height =
        (thrown > 0 ? one.ejecta * thrown / ejecta : 0) + (heaved > 0 ? one.upthrust * heaved / upthrust : 0);
    blast.landing_height.push_back(all > 0 ? static_cast<float>(height / all) : 0.0f);
  }
}

}  // namespace

void push_scaled(const Burst& given, state::Blast& blast, std::span<state::Blast> earlier, state::Surface& surface,
                 state::Soil& soil, const geometry::Bvh& bvh, std::span<const laws::Medium> media,
                 state::RegionScratch& scratch) {
  Burst burst = given;
  if (const double radius = crater_sizes(burst, media).largest; radius > 0) {
    blast.direction = into_ground(surface, targets(blast, radius, surface, bvh, scratch));
    face_slope(burst, blast, surface, bvh, scratch);
  }
  // What is on its way down counts as it stood.
  const Company company(blast, earlier, surface, soil);
  const double sunk = company.ground_zero_sunk();
  blast.ground_zero -= static_cast<float>(sunk) * blast.direction;
  burst.height -= sunk;
  blast.height = burst.height;
  blast.radius = crater_sizes(burst, media).largest;
  if (blast.radius == 0) return;
  std::vector<Charge> charges = company.diggers({burst, blast}, blast.radius);
  const std::size_t diggers = charges.size();
  blast.pulse = charges.back().blast.pulse;  // what flows in several has one drag
  for (Charge& other : company.at_once(charges.front(), blast.radius)) charges.push_back(std::move(other));

  for (std::size_t k = 0; k < diggers; ++k)
    break_crusts(charges[k].burst, charges[k].blast, surface, bvh, media, scratch);
  const std::vector<Part> parts = parts_of(charges, surface, bvh, media, scratch);
  double thrown = 0, heaved = 0;
  std::vector<Landing> landing;
  for (std::size_t i = 0; i < parts.front().reached.size(); ++i) {
    const std::uint32_t vertex = parts.front().reached[i].vertex;
    const std::uint8_t material = surface.material[vertex];
    double deep = 0;
    for (std::size_t k = 0; k < diggers; ++k) deep = std::max(deep, parts[k].depth(i, company.sunk(vertex), material));
    if (deep > 0) {
      const std::uint32_t column = state::touch_column(surface, soil, vertex);
      const Sizes& sizes = parts[diggers - 1].sizes;
      // What the others threw there goes on.
      const double lip_share = sizes.of[material].lip_share, leaves = sizes.leaves[material],
                   raised = company.raised(vertex);
      // A push falling to 0 over the time P against a relaxation time 2 P ends push P^2 deep.
      blast.column.push_back(column);
      blast.push.push_back(static_cast<float>((deep + raised) / (blast.pulse * blast.pulse)));
      blast.thrown.push_back(static_cast<float>((leaves * deep + raised) / (deep + raised)));
      thrown += (lip_share * deep + raised) * soil.area[column];
      heaved += (leaves - lip_share) * deep * soil.area[column];
      continue;
    }
    Landing lands;
    for (const Part& part : parts) part.land(i, blast, lands);
    if (lands.ejecta == 0 && lands.upthrust == 0) continue;
    blast.landing.push_back(state::touch_column(surface, soil, vertex));
    landing.push_back(lands);
  }
  set_heights(blast, landing, thrown, heaved, soil);
  blast.flow_rate = static_cast<float>(1 / (2 * blast.pulse));
  share_ground(blast, earlier, soil);
}

}  // namespace divot::events
