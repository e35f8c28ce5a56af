#include "viewer/bomb_node.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <osg/MatrixTransform>

namespace divot::viewer {
namespace {

constexpr double kTntDensity = 1.65;     // t/m^3, cast
constexpr double kLeastRadius = 0.0075;  // of the largest bomb over the region's width
constexpr double kSmallestRatio = 0.5;   // of a small bomb's least radius to the largest's, so that it stays visible

double charge_radius(double yield) { return std::cbrt(yield / kTntDensity * 3 / (4 * std::numbers::pi)); }

}  // namespace

BombNode::BombNode(osg::ref_ptr<osg::Node> sphere) : sphere_(std::move(sphere)), root_(new osg::Group) {}

void BombNode::update(const Vec3d& origin, std::span<const BombView> bombs, double extent) {
  root_->removeChildren(0, root_->getNumChildren());
  double largest = 0;
  for (const BombView& bomb : bombs) largest = std::max(largest, charge_radius(bomb.yield));
  for (const BombView& bomb : bombs) {
    if (bomb.exploded) continue;
    const double real = charge_radius(bomb.yield);
    const double radius = std::max(real, kLeastRadius * extent * std::max(real / largest, kSmallestRatio));
    const Vec3d p = bomb.position - origin;
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::scale(radius, radius, radius) * osg::Matrixd::translate(p.x, p.y, p.z));
    place->addChild(sphere_);
    root_->addChild(place);
  }
}

}  // namespace divot::viewer
