#include "divot_osg/collect_triangles.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/Transform>
#include <osg/TriangleFunctor>
#include <unordered_map>

#include "divot/ids.h"
#include "viewer/failure.h"

namespace divot::viewer {
namespace {

// A cell of space, or with a tolerance of 0 a single place.
using Cell = std::array<double, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::size_t hash = 0;
    for (const double number : cell) hash = hash * 0x9e3779b97f4a7c15u + std::hash<double>()(number);
    return hash ^ hash >> 29;
  }
};

// Joins corners that are near each other. The table is only asked, never walked: ids follow the corners' order.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance) {}

  std::uint32_t vertex_at(const Vec3d& p) {
    const Cell cell = cell_of(p);
    if (const auto near = find(cell, p); near != kNone) return near;
    const auto id = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(p);
    cells_[cell].push_back(id);
    return id;
  }

  std::vector<Vec3d>& vertices() { return vertices_; }

 private:
  Cell cell_of(const Vec3d& p) const {
    if (tolerance_ == 0) return {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 is 0
    return {std::floor(p.x / tolerance_), std::floor(p.y / tolerance_), std::floor(p.z / tolerance_)};
  }

  // The nearest vertex within the tolerance; it lies in the cell or in one beside it.
  std::uint32_t find(const Cell& cell, const Vec3d& p) const {
    const int reach = tolerance_ > 0 ? 1 : 0;
    std::uint32_t best = kNone;
    double nearest = tolerance_;
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const auto found = cells_.find({cell[0] + x, cell[1] + y, cell[2] + z});
          if (found == cells_.end()) continue;
          for (const std::uint32_t id : found->second) {
            const double away = length(vertices_[id] - p);
            if (away < nearest || (best == kNone && away <= nearest)) best = id, nearest = away;
          }
        }
      }
    }
    return best;
  }

  double tolerance_;  // m
  std::vector<Vec3d> vertices_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

// Corners of a drawable's triangles, in its own coordinates.
struct Corners {
  std::vector<osg::Vec3> list;
  void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c) { list.insert(list.end(), {a, b, c}); }
};

class Collector : public osg::NodeVisitor {
 public:
  explicit Collector(double tolerance) : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), welder_(tolerance) {}

  using osg::NodeVisitor::apply;

  void apply(osg::Transform& transform) override {
    const osg::Matrixd before = matrix_;
    transform.computeLocalToWorldMatrix(matrix_, this);
    traverse(transform);
    matrix_ = before;
  }

  void apply(osg::Drawable& drawable) override {
    osg::TriangleFunctor<Corners> corners;
    drawable.accept(corners);
    // A mirror turns triangles over.
    const bool mirrored = (osg::Vec3d(matrix_(0, 0), matrix_(0, 1), matrix_(0, 2)) ^
                           osg::Vec3d(matrix_(1, 0), matrix_(1, 1), matrix_(1, 2))) *
                              osg::Vec3d(matrix_(2, 0), matrix_(2, 1), matrix_(2, 2)) <
                          0;
    for (std::size_t i = 0; i < corners.list.size(); i += 3) {
      add(corners.list[i], corners.list[i + (mirrored ? 2 : 1)], corners.list[i + (mirrored ? 1 : 2)]);
    }
  }

  MeshTerrain take() { return {std::move(welder_.vertices()), std::move(triangles_)}; }

 private:
  void add(const osg::Vec3d& a, const osg::Vec3d& b, const osg::Vec3d& c) {
    std::array<std::uint32_t, 3> id;
    std::size_t k = 0;
    for (const osg::Vec3d& corner : {a, b, c}) {
      const osg::Vec3d p = corner * matrix_;
      id[k++] = welder_.vertex_at({p.x(), p.y(), p.z()});
    }
    const auto at = [&](std::size_t corner) { return welder_.vertices()[id[corner]]; };
    const bool has_area = length(cross(at(1) - at(0), at(2) - at(0))) > 0;
    if (has_area) triangles_.insert(triangles_.end(), id.begin(), id.end());
  }

  osg::Matrixd matrix_;  // from where the traversal is to the sub-graph's parent
  Welder welder_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

Result<MeshTerrain> collect_triangles(osg::Node& subgraph, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    return failure(fmt::format("corners cannot be joined within {} m", tolerance), "expected 0 or more", "tolerance");
  }
  Collector collector(tolerance);
  subgraph.accept(collector);
  MeshTerrain mesh = collector.take();
  if (mesh.triangles.empty()) {
    return failure(fmt::format("the sub-graph \"{}\" has no triangles", subgraph.getName()),
                   "expected geometry that is switched on");
  }
  return mesh;
}

}  // namespace divot::viewer
