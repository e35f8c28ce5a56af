#include "refit/refit.h"

namespace divot::refit {
namespace {

// Each vertex once, however often it moves: a bit for each says whether it is in the list.
void note_moved(Tree& tree, const std::vector<std::uint32_t>& moved, std::size_t vertices) {
  if (tree.is_moved.size() < vertices / 64 + 1) tree.is_moved.resize(vertices / 64 + 1, 0);
  for (const std::uint32_t vertex : moved) {
    std::uint64_t& word = tree.is_moved[vertex / 64];
    const std::uint64_t bit = std::uint64_t{1} << vertex % 64;
    if ((word & bit) != 0) continue;
    word |= bit;
    tree.moved.push_back(vertex);
  }
}

void forget_moved(Tree& tree) {
  for (const std::uint32_t vertex : tree.moved) tree.is_moved[vertex / 64] = 0;
  tree.moved.clear();
  tree.drift = 0;
}

// Corners of the faces that the terrain started with.
geometry::Bvh::Corners corners_of(const state::Surface& surface) {
  if (!surface.bisection.any()) return geometry::corners_in(surface.mesh.triangles());
  return [&surface](std::uint32_t face) { return surface.bisection.base_corners(surface.mesh, face); };
}

void refit_moved(Tree& tree, const state::Surface& surface) {
  const geometry::Bisection& bisection = surface.bisection;
  for (const std::uint32_t vertex : tree.moved) {
    if (bisection.any() && vertex >= bisection.base_vertex_count()) continue;  // no corner of a face in the tree
    // Of the faces round a vertex of a grid, most share their leaf with the one before.
    std::uint32_t last = kNone;
    surface.mesh.for_each_face(vertex, [&](std::uint32_t face) {
      const std::uint32_t base = bisection.any() ? bisection.base_of(face) : face, leaf = tree.bvh.leaf_of(base);
      if (leaf != last) tree.bvh.touch(base, surface.position[vertex]);
      last = leaf;
    });
  }
  tree.refits += tree.bvh.refit(corners_of(surface), surface.position) > 0;
}

}  // namespace

void build(Tree& tree, const state::Surface& surface, const Jobs& jobs) {
  const std::uint32_t faces = surface.bisection.any() ? surface.bisection.base_face_count() : surface.mesh.face_count();
  // A raster's faces are numbered tile by tile.
  const auto order = surface.raster ? geometry::Bvh::Order::as_numbered : geometry::Bvh::Order::by_place;
  tree.bvh.build(faces, corners_of(surface), surface.position, tree.margin, order, jobs);
  forget_moved(tree);
  ++tree.rebuilds;
}

void update(Tree& tree, const state::Surface& surface, const std::vector<std::uint32_t>& moved, float distance,
            const UpdatePolicy& policy, const Jobs& jobs) {
  ++tree.steps;
  if (policy.kind != UpdatePolicy::Kind::adaptive) {
    const bool due =
        policy.kind == UpdatePolicy::Kind::every_step || tree.steps % static_cast<std::uint64_t>(policy.steps) == 0;
    if (due) build(tree, surface, jobs);
    return;
  }
  tree.drift += distance;
  note_moved(tree, moved, surface.position.size());
  if (tree.drift <= tree.margin) return;
  if (tree.bvh.degradation() > kWorn) return build(tree, surface, jobs);
  refit_moved(tree, surface);
  forget_moved(tree);
}

}  // namespace divot::refit
