#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "divot/views.h"

namespace divot::viewer {

/// A grid of ground for tests, centred on x = y = 0 of coordinates far from zero, as a DEM's are.
class TestSurface {
 public:
  TestSurface(int columns, int rows, double spacing, const std::function<double(double x, double y)>& height)
      : spacing_(spacing) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const double x = (column - (columns - 1) / 2.0) * spacing, y = (row - (rows - 1) / 2.0) * spacing;
        positions_.push_back(to_float(Vec3d{x, y, height(x, y)}));
        original_.push_back(positions_.back().z);
      }
    }
    const auto id = [&](int column, int row) { return static_cast<std::uint32_t>(row * columns + column); };
    for (int row = 0; row + 1 < rows; ++row) {
      for (int column = 0; column + 1 < columns; ++column) {
        const std::uint32_t a = id(column, row), b = id(column + 1, row), c = id(column, row + 1),
                            d = id(column + 1, row + 1);
        triangles_.insert(triangles_.end(), {a, b, d, a, d, c});
      }
    }
    materials_.resize(positions_.size());
  }

  /// A bowl of that width and depth at x, y with a lip of a quarter of the depth. Returns the vertices that moved.
  std::vector<DirtyRange> dig(double x, double y, double width, double depth) {
    std::vector<DirtyRange> dirty;
    for (std::uint32_t i = 0; i < positions_.size(); ++i) {
      Vec3& p = positions_[i];
      const double r = std::hypot(p.x - x, p.y - y) / (width / 2);
      if (r > 2) continue;
      const double bowl = r < 1 ? -depth * (1 - r * r) : 0;
      const double lip = r < 1 ? depth / 4 * std::pow(r, 6) : depth / 4 * std::pow(r, -4) * (2 - r);
      p.z += static_cast<float>(bowl + lip);
      if (!dirty.empty() && dirty.back().second == i) {
        ++dirty.back().second;
      } else {
        dirty.emplace_back(i, i + 1);
      }
    }
    return dirty;
  }

  /// What the ground is made of, by place relative to its middle.
  void set_materials(const std::function<std::uint8_t(double x, double y)>& material) {
    for (std::size_t i = 0; i < positions_.size(); ++i) materials_[i] = material(positions_[i].x, positions_[i].y);
  }

  SurfaceView view() const {
    SurfaceView view;
    view.origin = {700000, 4000000, 120};
    view.positions = positions_;
    view.triangles = triangles_;
    view.materials = materials_;
    view.spacing = spacing_;
    return view;
  }

  /// How far the vertex lies below the height it was made with, m.
  float sinkage(std::uint32_t vertex) const { return original_[vertex] - positions_[vertex].z; }

  /// In the terrain's coordinates from ones relative to the origin.
  Vec3d place(double x, double y, double z) const { return view().origin + Vec3d{x, y, z}; }

 private:
  double spacing_;
  std::vector<Vec3> positions_;
  std::vector<float> original_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint8_t> materials_;
};

}  // namespace divot::viewer
