#include "contact/punch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/crust.h"

namespace divot::contact {
namespace {

// The columns of one crust under a body push together on the plug that would break out.
bool is_punched(const std::vector<Press>& presses, std::uint8_t material, const state::Surface& surface,
                const state::Soil& soil, const laws::Medium& crust) {
  double area = 0, force = 0;
  for (const Press& press : presses) {
    if (surface.material[press.vertex] != material || press.pressure <= 0) continue;
    const double own = soil.cell[surface.column[press.vertex]];
    area += own, force += own * press.pressure;
  }
  return area > 0 && force > area * laws::punching_pressure(crust, std::sqrt(area / std::numbers::pi));
}

}  // namespace

void find_punched(const Scratch& scratch, const state::Surface& surface, const state::Soil& soil,
                  std::span<const laws::Medium> media, std::vector<std::uint32_t>& broken) {
  for (const Scratch::PerBody& body : scratch.bodies) {
    for (std::uint8_t material = 0; material < media.size(); ++material) {
      if (media[material].below == laws::kNoLayer) continue;
      if (!is_punched(body.presses, material, surface, soil, media[material])) continue;
      for (const Press& press : body.presses)
        if (surface.material[press.vertex] == material && press.pressure > 0) broken.push_back(press.vertex);
    }
  }
}

}  // namespace divot::contact
