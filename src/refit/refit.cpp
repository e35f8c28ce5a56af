#include "refit/refit.h"

#include <algorithm>

namespace divot::refit {
namespace {

void refit_moved(Tree& tree, const state::Surface& surface) {
  std::sort(tree.moved.begin(), tree.moved.end());
  tree.moved.erase(std::unique(tree.moved.begin(), tree.moved.end()), tree.moved.end());
  for (const std::uint32_t vertex : tree.moved)
    surface.mesh.for_each_face(vertex, [&](std::uint32_t face) { tree.bvh.touch(face, surface.position); });
  tree.refits += tree.bvh.refit(surface.position) > 0;
}

}  // namespace

void build(Tree& tree, const state::Surface& surface, const Jobs& jobs) {
  tree.bvh.build(surface.mesh.triangles(), surface.position, tree.margin, jobs);
  tree.moved.clear();
  tree.drift = 0;
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
  tree.moved.insert(tree.moved.end(), moved.begin(), moved.end());
  if (tree.drift <= tree.margin) return;
  if (tree.bvh.degradation() > kWorn) return build(tree, surface, jobs);
  refit_moved(tree, surface);
  tree.moved.clear();
  tree.drift = 0;
}

}  // namespace divot::refit
