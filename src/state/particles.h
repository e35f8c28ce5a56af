#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"
#include "divot/views.h"
#include "state/slot_reads.h"

namespace divot::state {

using divot::Hold;

/// The surface particle system: every vertex that is awake, and the ring of anchors around them, ascending by vertex so
/// that rows near in memory are near on the ground.
struct Particles {
  std::vector<std::uint32_t> vertex, column;  ///< [particle] ; activation/
  std::vector<float> x, y, z;                 ///< [particle] m, relative to the surface's origin; integration/
  std::vector<float> vx, vy, vz;              ///< [particle] m/s; integration/
  std::vector<float> fx, fy, fz;              ///< [particle] N, at the last evaluation; forces/
  std::vector<float> mass;                    ///< [particle] kg; activation/
  std::vector<float> flow_rate;  ///< [particle] 1/s, drag of soil that a blast has made flow, 0 otherwise; events/
  std::vector<float> held_pull;  ///< [particle] N, vertical cohesion on it when last evaluated; forces/
  std::vector<float> yielded;  ///< [particle] m it was pressed for good in this step, where a body carries it; contact/
  std::vector<std::uint32_t> carrier;      ///< [particle] index of that body, else kNone; contact/
  std::vector<std::uint8_t> material;      ///< [particle] ; activation/
  std::vector<Hold> hold;                  ///< [particle] ; activation/, contact/
  std::vector<std::uint16_t> still_steps;  ///< [particle] steps it has been still; settle/
  std::size_t size() const { return vertex.size(); }

  Vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3 velocity(std::size_t i) const { return {vx[i], vy[i], vz[i]}; }
  void set_position(std::size_t i, const Vec3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
  void set_velocity(std::size_t i, const Vec3& v) { vx[i] = v.x, vy[i] = v.y, vz[i] = v.z; }

  /// Calls f(column_array) for every array, so that rows are added, moved and dropped in one place.
  template <class F>
  void for_each_array(F f) {
    for_each_array_of(*this, f);
  }
  template <class F>
  void for_each_array(F f) const {
    for_each_array_of(*this, f);
  }

 private:
  template <class Self, class F>
  static void for_each_array_of(Self& p, F f) {
    f(p.vertex), f(p.column), f(p.x), f(p.y), f(p.z), f(p.vx), f(p.vy), f(p.vz), f(p.fx), f(p.fy), f(p.fz), f(p.mass),
        f(p.flow_rate), f(p.held_pull), f(p.yielded), f(p.carrier), f(p.material), f(p.hold), f(p.still_steps);
  }
};

/// Cohesion between particles: rows of neighbours and, for each, the length at which it is at rest. Eight rows that
/// follow each other are a block; it lies in memory slot by slot, a slot holding one neighbour of each of the eight.
/// Neighbours of a row ascend from slot to slot.
struct Bonds {
  static constexpr std::uint32_t kLanes = SlotReads::kLanes;
  static constexpr std::uint8_t kSeveral = 0xff;

  std::size_t count = 0;                 ///< particles; neighbours/, as are the next four
  std::vector<std::uint32_t> first;      ///< [block + 1] its first slot
  std::vector<std::uint32_t> neighbour;  ///< [slot][lane] particle; that of the lane itself where it has none
  std::vector<SlotReads> reads;          ///< [slot] how its neighbours are found
  std::vector<std::uint8_t> medium;      ///< [block] that all particles and neighbours have in common, or kSeveral
  std::vector<float> rest_length;        ///< [slot][lane] m, 0 while the two are out of range, -1: no pair; forces/

  std::size_t block_count() const { return first.empty() ? 0 : first.size() - 1; }
  /// Calls f(entry) for each neighbour of particle i, ascending: an index of `neighbour` and `rest_length`.
  template <class F>
  void for_each_entry(std::size_t i, F f) const {
    for (std::size_t slot = first[i / kLanes]; slot < first[i / kLanes + 1]; ++slot)
      if (const std::size_t entry = slot * kLanes + i % kLanes; !(rest_length[entry] < 0)) f(entry);
  }
};

}  // namespace divot::state
