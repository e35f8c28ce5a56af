#include <algorithm>

#include "contact/punch.h"
#include "world/state.h"

namespace divot {
namespace {

// What has sunk by more than the thickness of its crust has none left, whatever drove it down.
void find_sunk(const state::Particles& p, const state::Soil& soil, const state::Surface& surface,
               std::span<const laws::Medium> media, std::vector<std::uint32_t>& broken) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Of the surface: a particle may not have heard yet that a blast broke its crust.
    const laws::Medium& medium = media[surface.material[p.vertex[i]]];
    if (p.hold[i] == Hold::anchor || medium.below == laws::kNoLayer) continue;
    if (soil.original[p.column[i]].z - p.z[i] > medium.thickness) broken.push_back(p.vertex[i]);
  }
}

}  // namespace

bool World::Impl::break_crusts() {
  if (std::ranges::none_of(media, [](const laws::Medium& m) { return m.below != laws::kNoLayer; })) return false;
  contact::find_punched(contact_scratch, surface, soil, media, broken);
  find_sunk(particles, soil, surface, media, broken);
  std::sort(broken.begin(), broken.end());
  broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
  // For good: from now on the ground there is what lay below.
  for (const std::uint32_t vertex : broken) {
    surface.material[vertex] = media[surface.material[vertex]].below;
    dirty_chunk[vertex / kDirtyChunk] = true;
  }
  // A blast has broken some by itself, so that all that are awake are looked at.
  bool changed = false;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::uint8_t material = surface.material[particles.vertex[i]];
    if (particles.material[i] == material) continue;
    changed = true;
    particles.material[i] = material;
    particles.mass[i] = media[material].areal_mass * soil.cell[particles.column[i]];
  }
  broken.clear();
  return changed;
}

}  // namespace divot
