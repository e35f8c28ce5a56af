#pragma once

#include <osg/Geometry>

#include "divot/views.h"

namespace divot::viewer {

/// The particles that are awake as points; those that are fixed in another colour.
class ParticleNode {
 public:
  ParticleNode();

  /// `spacing`: m, of the ground; points are a third of it wide. [O(particles)]
  void update(const ParticleView& particles, double spacing);

  osg::Node& root() { return *points_; }

 private:
  osg::ref_ptr<osg::Geometry> points_;
  osg::ref_ptr<osg::Vec3Array> positions_;
  osg::ref_ptr<osg::Vec4ubArray> colors_;
  osg::ref_ptr<osg::DrawArrays> drawn_;
  osg::ref_ptr<osg::Uniform> size_;
};

}  // namespace divot::viewer
