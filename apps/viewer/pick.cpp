#include "viewer/pick.h"

#include <cmath>
#include <numbers>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

namespace divot::viewer {

std::optional<Vec3d> pick_ground(osg::Group& ground, const Vec3d& origin, const Camera& camera, double aspect,
                                 const WindowPoint& at, double reach) {
  const Vec3d toward = camera.target - camera.eye, forward = toward * (1 / length(toward));
  const Vec3d side = cross(forward, {0, 0, 1}), right = side * (1 / length(side)), up = cross(right, forward);
  const double slope = std::tan(camera.fov_deg * std::numbers::pi / 360);
  const Vec3d ray = forward + right * (slope * aspect * at.x) + up * (slope * at.y);
  const Vec3d start = camera.eye - origin, end = start + ray * reach;
  osg::ref_ptr<osgUtil::LineSegmentIntersector> segment =
      new osgUtil::LineSegmentIntersector(osg::Vec3d(start.x, start.y, start.z), osg::Vec3d(end.x, end.y, end.z));
  osgUtil::IntersectionVisitor visitor(segment);
  ground.accept(visitor);
  if (!segment->containsIntersections()) return {};
  const osg::Vec3d hit = segment->getFirstIntersection().getWorldIntersectPoint();
  return origin + Vec3d{hit.x(), hit.y(), hit.z()};
}

}  // namespace divot::viewer
