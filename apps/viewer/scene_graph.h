#pragma once

#include <osg/Group>
#include <span>

#include "divot/views.h"
#include "viewer/body_node.h"
#include "viewer/bomb_node.h"
#include "viewer/camera.h"
#include "viewer/lighting.h"
#include "viewer/terrain_node.h"

namespace divot::viewer {

/// All that a picture or a window shows of a world, but not where it is shown.
class SceneGraph {
 public:
  /// `wireframe`: lines on paper instead of lit ground. It says what kind of drawing this is, for good.
  SceneGraph(const Sun& sun, bool wireframe);

  /// Takes over the world as it is now; see TerrainNode::update for `dirty` and its cost.
  void update(const SurfaceView& surface, std::span<const DirtyRange> dirty, std::span<const BodyView> bodies,
              std::span<const BombView> bombs, const Sinkage& sinkage);

  /// Fits shadows, haze, detail and the size of bombs to what is looked at: `region` from `camera`. Call it before
  /// update().
  void set_view(const Vec3d& origin, const Region& region, const Camera& camera);

  osg::Group& root() { return *root_; }

 private:
  void build_lit();
  void build_wireframe();

  osg::ref_ptr<osg::Group> root_;
  TerrainNode terrain_;
  BodyNode bodies_;
  BombNode bombs_;
  Lighting lighting_;
  double extent_ = 1;  // m, of the region that is looked at
  osg::ref_ptr<osg::Uniform> height_range_, detail_wave_, sinkage_scale_, ink_cell_;
};

}  // namespace divot::viewer
