#include "viewer/shape_mesh.h"

#include <array>
#include <cmath>
#include <numbers>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <vector>

namespace divot::viewer {
namespace {

constexpr unsigned kSectors = 32;  // around what is round

// Points of an outline from the axis z (radius 0) upward or downward back to it, with the outline's normal there:
// (radial, along z).
struct OutlinePoint {
  double radius, z;
  osg::Vec2d normal;
};

class Mesh {
 public:
  unsigned add(const osg::Vec3d& point, const osg::Vec3d& normal) {
    points_->push_back(point);
    normals_->push_back(normal);
    return static_cast<unsigned>(points_->size()) - 1;
  }
  void face(GLenum mode, std::initializer_list<unsigned> corners) {
    auto& list = mode == GL_QUADS ? quads_ : triangles_;
    for (const unsigned corner : corners) list->push_back(corner);
  }
  osg::ref_ptr<osg::Geometry> finish(bool patterned) const {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(points_);
    geometry->setNormalArray(normals_, osg::Array::BIND_PER_VERTEX);
    for (const auto& list : {quads_, triangles_})
      if (!list->empty()) geometry->addPrimitiveSet(list);
    if (!patterned) geometry->getOrCreateStateSet()->addUniform(new osg::Uniform("pattern_share", 0.0f));
    return geometry;
  }

 private:
  osg::ref_ptr<osg::Vec3Array> points_ = new osg::Vec3Array, normals_ = new osg::Vec3Array;
  osg::ref_ptr<osg::DrawElementsUInt> quads_ = new osg::DrawElementsUInt(GL_QUADS),
                                      triangles_ = new osg::DrawElementsUInt(GL_TRIANGLES);
};

osg::ref_ptr<osg::Node> transformed(const osg::Matrixd& matrix, osg::Node& child) {
  osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(matrix);
  place->addChild(&child);
  return place;
}

// Turns pieces of an outline about z; pieces do not share points, so that there are edges between them. Outlines run
// from the lowest point to the highest.
osg::ref_ptr<osg::Geometry> turned(const std::vector<std::vector<OutlinePoint>>& pieces) {
  Mesh mesh;
  for (const auto& piece : pieces) {
    std::vector<unsigned> rings;
    for (const OutlinePoint& p : piece) {
      for (unsigned s = 0; s <= kSectors; ++s) {
        const double angle = 2 * std::numbers::pi * s / kSectors, c = std::cos(angle), d = std::sin(angle);
        const unsigned index =
            mesh.add({p.radius * c, p.radius * d, p.z}, {p.normal.x() * c, p.normal.x() * d, p.normal.y()});
        if (s == 0) rings.push_back(index);
      }
    }
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
      for (unsigned s = 0; s < kSectors; ++s) {
        mesh.face(GL_QUADS, {rings[k] + s, rings[k] + s + 1, rings[k + 1] + s + 1, rings[k + 1] + s});
      }
    }
  }
  return mesh.finish(true);
}

std::vector<OutlinePoint> half_ball(double radius, double middle, bool upper) {
  constexpr int kRings = 8;
  std::vector<OutlinePoint> points;
  for (int k = 0; k <= kRings; ++k) {
    const double angle = std::numbers::pi / 2 * (upper ? k : k - kRings) / kRings;
    const osg::Vec2d normal(std::cos(angle), std::sin(angle));
    points.push_back({radius * normal.x(), middle + radius * normal.y(), normal});
  }
  return points;
}

// From z, about which outlines turn, to y.
osg::ref_ptr<osg::Node> lying(osg::Node& child) {
  return transformed(osg::Matrixd::rotate(osg::Vec3d(0, 0, 1), osg::Vec3d(0, 1, 0)), child);
}

osg::ref_ptr<osg::Node> make(const Sphere& ball, osg::Node& unit) {
  return transformed(osg::Matrixd::scale(ball.radius, ball.radius, ball.radius), unit);
}

osg::ref_ptr<osg::Node> make(const Box& box, osg::Node&) {
  Mesh mesh;
  const osg::Vec3d half(box.size.x / 2, box.size.y / 2, box.size.z / 2);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      osg::Vec3d normal, u, v;
      normal[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1;
      std::array<unsigned, 4> corners;
      const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = mesh.add(osg::componentMultiply(normal + u * signs[k][0] + v * signs[k][1], half), normal);
      }
      mesh.face(GL_QUADS, {corners[0], corners[1], corners[2], corners[3]});
    }
  }
  return mesh.finish(false);
}

osg::ref_ptr<osg::Node> make(const Cylinder& c, osg::Node&) {
  const double half = c.length / 2, r = c.radius;
  return lying(*turned({{{0, -half, {0, -1}}, {r, -half, {0, -1}}},
                        {{r, -half, {1, 0}}, {r, half, {1, 0}}},
                        {{r, half, {0, 1}}, {0, half, {0, 1}}}}));
}

osg::ref_ptr<osg::Node> make(const Capsule& c, osg::Node&) {
  auto outline = half_ball(c.radius, -c.length / 2, false);
  const auto upper = half_ball(c.radius, c.length / 2, true);
  outline.insert(outline.end(), upper.begin(), upper.end());
  return lying(*turned({outline}));
}

osg::ref_ptr<osg::Node> make(const Cone& cone, osg::Node&) {
  const double half = cone.height / 2, r = cone.radius, slant = std::hypot(r, cone.height);
  const osg::Vec2d side(cone.height / slant, r / slant);
  return turned({{{0, -half, {0, -1}}, {r, -half, {0, -1}}}, {{r, -half, side}, {0, half, side}}});
}

osg::ref_ptr<osg::Node> make(const Hull& hull, osg::Node&) {
  Mesh mesh;
  const auto point = [&](std::size_t corner) {
    const Vec3d& p = hull.points[hull.triangles[corner]];
    return osg::Vec3d(p.x, p.y, p.z);
  };
  for (std::size_t t = 0; t + 2 < hull.triangles.size(); t += 3) {
    const osg::Vec3d a = point(t), b = point(t + 1), c = point(t + 2);
    osg::Vec3d normal = (b - a) ^ (c - a);
    normal.normalize();
    mesh.face(GL_TRIANGLES, {mesh.add(a, normal), mesh.add(b, normal), mesh.add(c, normal)});
  }
  return mesh.finish(false);
}

osg::ref_ptr<osg::Node> make(const Compound& compound, osg::Node& unit) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (const Part& part : compound.parts) {
    const osg::ref_ptr<osg::Node> shape = std::visit([&](const auto& s) { return make(s, unit); }, part.shape);
    const Quat q = rotation(part.rotation_deg);
    const Vec3d& p = part.position;
    group->addChild(transformed(
        osg::Matrixd::rotate(osg::Quat(q.x, q.y, q.z, q.w)) * osg::Matrixd::translate(p.x, p.y, p.z), *shape));
  }
  return group;
}

}  // namespace

osg::ref_ptr<osg::Node> make_shape(const Shape& shape, osg::Node& ball) {
  return std::visit([&](const auto& s) { return make(s, ball); }, shape);
}

}  // namespace divot::viewer
