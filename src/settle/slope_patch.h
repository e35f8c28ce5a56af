#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "divot/jobs.h"
#include "geometry/posed_solid.h"
#include "laws/medium.h"
#include "settle/ground.h"
#include "state/bodies.h"

namespace divot::settle {

/// What soils do on a slope.
struct SlopeLaws {
  std::span<const laws::Medium> media;
  std::span<const double> stands;  ///< [medium] height up to which it stands vertically, m
  double gravity = 0;              ///< m/s^2
};

/// The faces that may slide in a step, by themselves: heights and loose soil change from sweep to sweep, and all that
/// does not is found once. Sweeps then read a few packed arrays instead of the half-edges, columns and particles.
class SlopePatch {
 public:
  /// Takes the `faces`, ascending. Those that a body has a corner of, or that move, stay as they are; others fill up to
  /// the undersides of `bodies` at most.
  void build(const Ground& ground, const SlopeLaws& slope_laws, std::span<const state::Body> bodies,
             std::span<const std::uint32_t> faces, const Jobs& jobs);

  /// Finds which faces are too steep to rest as they now are, and how easily the soil there flows. Returns the most by
  /// which any would overshoot in `dt` seconds: 1 is stable, 0 is at rest.
  double find_slides(const SlopeLaws& slope_laws, double dt, const Jobs& jobs);
  /// Lets them slide for `dt` seconds. Returns how far a vertex rose or fell at most, m.
  float slide(double dt, const Jobs& jobs);

  /// Calls `f(vertex, volume, area)` for each vertex that something slid at, ascending: the soil that came to it, m^3,
  /// and its vertex_area().
  template <class F>
  void for_each_moved(F f) const {
    for (std::size_t v = 0; v < corners_.size(); ++v)
      if (corners_[v].moved) f(vertices_[v], corners_[v].came, corners_[v].area);
  }

 private:
  // A vertex: height of the surface there, before the first touch, and of the underside of a body over it.
  struct Corner {
    double now = 0, then = 0, loose = 0;  // m
    double ceiling = std::numeric_limits<double>::infinity();
    double came = 0, area = 0;  // m^3, m^2
    float excess = 0;           // m
    std::uint8_t material = 0;
    bool moved = false;
  };
  struct Flat {
    double x = 0, y = 0;
    double size() const;
  };
  // A face: what its corners' heights make of its slope, and its slope of them.
  struct Face {
    std::array<std::uint32_t, 3> corner;  // indices
    std::array<Flat, 3> pull;             // gradient of a height of 1 at one corner, 1/m
    double area = 0;                      // twice its shadow's, m^2; 0: it does not slide
    double stable = 0;                    // mobility times time that it takes without overshooting, m^2
    double before = 0;                    // slope before the first touch
  };
  struct Slide {
    std::array<double, 3> share{};  // soil that it brings to each corner, m^3 per unit of mobility and time
    double wanted = 0;              // mobility of the ground, m^2/s; 0: it rests
    double most = 0;                // that times time: no more is taken without overshooting, is loose or has room, m^2
  };

  template <class Height>
  Flat gradient(const Face& face, const Height& height) const;
  Face make_face(const Ground& ground, double fast, std::uint32_t face) const;
  Slide look_at(const SlopeLaws& slope_laws, const Face& face) const;

  void lower_ceilings(const Ground& ground, const state::Body& body);

  float spacing_ = 0;
  geometry::PosedSolid posed_;
  core::IdSet set_;
  std::vector<std::uint32_t> vertices_;  // [corner] ascending
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  std::vector<Slide> slides_;         // [face]
  std::vector<std::uint32_t> first_;  // [corner + 1] its first place in meets_
  std::vector<std::uint32_t> meets_;  // 3 * face + which of its corners this is, ascending for each corner
  std::vector<float> rose_;           // [corner] m, in the last sweep
};

}  // namespace divot::settle
