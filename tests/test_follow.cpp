// The surface follows its particles: eight at a time as one by one, and no volume is lost on the way.
#include "settle/follow.h"
#include "settle/slump.h"
#include "support.h"

namespace divot::settle {
namespace {

using test::Sheet;

// Ground that is rough, with holes of anchors in it, whose particles have gone somewhere else. Its sides are no
// multiples of a tile's, so that blocks lie across rows and tiles.
Sheet rough_sheet(unsigned seed, float roughness) {
  Sheet s = test::make_sheet({.columns = 45, .rows = 38, .spacing = 0.5});
  test::Random random(seed);
  state::Particles& p = s.particles;
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    Vec3& place = s.surface.position[i];
    place.z = random.in(-roughness, roughness);
    if (!s.surface.mesh.is_boundary(i)) place.x += random.in(-0.1f, 0.1f), place.y += random.in(-0.1f, 0.1f);
    p.set_position(i, place);
    if (random.below(9) == 0) {
      p.hold[i] = Hold::anchor;
      continue;
    }
    if (random.below(9) != 0)
      p.set_position(i, place + Vec3{random.in(-0.1f, 0.1f), random.in(-0.1f, 0.1f), random.in(-0.2f, 0.2f)});
    p.set_velocity(i, {random.in(-0.1f, 0.1f), 0, 0});
  }
  return s;
}

struct Follow {
  Moved moved;
  FollowScratch scratch;
  void operator()(Sheet& s, const RingKernel& kernel, int threads = 1) {
    Ground ground{s.particles, s.soil, s.surface, moved};
    moved = {};
    follow({0.05f, 0.001f, 3}, false, ground, scratch, Jobs(threads), kernel);
  }
  std::vector<std::uint32_t> restless(Sheet& s, const Slopes& slopes, const RingKernel& kernel) {
    const Ground ground{s.particles, s.soil, s.surface, moved};
    std::vector<std::uint32_t> list;
    add_restless(slopes, ground, scratch, Jobs(2), list, kernel);
    return list;
  }
};

// Volume between the surface and z = -10, by its faces.
double volume_of(const state::Surface& surface) {
  double sum = 0;
  for (std::uint32_t f = 0; f < surface.mesh.face_count(); ++f) {
    const auto at = [&](std::uint32_t k) { return to_double(surface.position[surface.mesh.origin(3 * f + k)]); };
    const Vec3d a = at(0), b = at(1), c = at(2);
    sum += cross(b - a, c - a).z / 2 * ((a.z + b.z + c.z) / 3 + 10);
  }
  return sum;
}

TEST(Follow, WithRingsAndWithoutGivesTheSameBits) {
  for (const unsigned seed : {1u, 2u}) {
    Sheet plain = rough_sheet(seed, 0.05f);
    Follow one;
    one(plain, kRingsBaseline);
    ASSERT_FALSE(one.scratch.rings.valid);
    for (const RingKernel* kernel : ring_kernels()) {
      for (const int threads : {1, 3}) {
        Sheet s = rough_sheet(seed, 0.05f);
        Follow eight;
        eight.scratch.unchanged = 1;  // for the second step in a row: time for rings
        eight(s, *kernel, threads);
        ASSERT_TRUE(eight.scratch.rings.valid);
        EXPECT_EQ(eight.scratch.lost, one.scratch.lost);
        EXPECT_EQ(s.soil.compacted, plain.soil.compacted);
        EXPECT_EQ(s.soil.loose, plain.soil.loose);
        EXPECT_EQ(s.surface.position, plain.surface.position);
        EXPECT_EQ(s.particles.still_steps, plain.particles.still_steps);
        EXPECT_EQ(eight.moved.vertices, one.moved.vertices);
        EXPECT_EQ(eight.moved.distance, one.moved.distance);
      }
    }
  }
}

TEST(Follow, WhatIsLostIsWhatTheSurfaceSweeps) {
  for (const int unchanged : {0, 1}) {
    Sheet s = rough_sheet(3, 0.3f);
    const double before = volume_of(s.surface);
    Follow step;
    step.scratch.unchanged = unchanged;
    step(s, kRingsBaseline);
    double lost = 0, sizes = 0;
    for (const float volume : step.scratch.lost) lost += volume, sizes += std::abs(volume);
    EXPECT_NEAR(lost, before - volume_of(s.surface), 1e-6 * sizes);
    EXPECT_GT(sizes, 1);
  }
}

// What is left out has no face steeper than soil rests, nor anything that cohesion holds up.
TEST(Follow, LeavesOutOnlyWhatRests) {
  const auto medium = [](const char* name) { return laws::make_medium(*find_preset(name)); };
  for (const char* name : {"dry_sand", "clay_wet"}) {
    const std::vector<laws::Medium> media = {medium(name)};
    const Slopes slopes = sliding_slopes(media, 9.81);
    Sheet s = rough_sheet(4, 0.04f);
    s.soil.excess[900] = 0.1f;
    Follow step;
    step.scratch.unchanged = 1;
    step(s, fastest_rings());
    const auto listed = step.restless(s, slopes, fastest_rings());
    for (const RingKernel* kernel : ring_kernels()) EXPECT_EQ(step.restless(s, slopes, *kernel), listed);
    EXPECT_GT(listed.size(), s.particles.size() / 20);
    EXPECT_LT(listed.size(), step.moved.vertices.size());
    const auto at = [&](std::uint32_t v) { return to_double(s.surface.position[v]); };
    for (const std::uint32_t v : step.moved.vertices) {
      bool steep = false;
      s.surface.mesh.for_each_face(v, [&](std::uint32_t f) {
        const Vec3d n = cross(at(s.surface.mesh.origin(3 * f + 1)) - at(s.surface.mesh.origin(3 * f)),
                              at(s.surface.mesh.origin(3 * f + 2)) - at(s.surface.mesh.origin(3 * f)));
        steep |= std::hypot(n.x, n.y) > (media[0].tan_repose + 0.01) * std::abs(n.z);
      });
      if (slopes.edges)
        s.surface.mesh.for_each_neighbour(v, [&](std::uint32_t u) {
          const Vec3d way = at(u) - at(v);
          steep |= std::abs(way.z) > media[0].tan_repose * std::hypot(way.x, way.y);
          steep |= s.soil.excess[s.surface.column[u]] > 0;
        });
      if (steep) {
        EXPECT_TRUE(std::binary_search(listed.begin(), listed.end(), v)) << name << ", vertex " << v;
      }
    }
  }
}

}  // namespace
}  // namespace divot::settle
