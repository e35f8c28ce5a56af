#pragma once

#include <array>
#include <osg/Group>
#include <span>

#include "viewer/body_node.h"
#include "viewer/bomb_node.h"
#include "viewer/box_node.h"
#include "viewer/camera.h"
#include "viewer/color_scale.h"
#include "viewer/explosion_node.h"
#include "viewer/lit_view.h"
#include "viewer/look.h"
#include "viewer/particle_node.h"
#include "viewer/snapshot.h"
#include "viewer/terrain_node.h"

namespace divot::viewer {

/// All that a picture or a window shows of a world, but not where it is shown.
class SceneGraph {
 public:
  SceneGraph(const Sun& sun, const Look& look);

  /// From now on draws like this. Takes effect on the next update().
  void set_look(const Look& look);
  const Look& look() const { return look_; }

  /// What is updated next is another world, of the same materials.
  void begin_another_world();

  /// Takes over the world as it is now; see TerrainNode::update for its cost.
  void update(const Snapshot& snapshot);

  /// Fits detail of the ground and the size of bombs to `region`, and lights what `camera` sees of it. Call it before
  /// update().
  void set_view(const Vec3d& origin, const Region& region, const Camera& camera);

  /// Moves shadows and haze to `region`, seen from `camera`.
  void set_focus(const Vec3d& origin, const Region& region, const Camera& camera);

  /// Where the world is looked at from, m, relative to the surface's origin: dust is sorted by it.
  void set_eye(const osg::Vec3d& eye) { eye_ = eye; }

  /// Shows these boxes; none hides them.
  void set_boxes(std::span<const std::pair<Vec3, Vec3>> boxes) { boxes_.update(boxes); }

  /// What the ground's colours tell now.
  const ColorScale& scale() const { return scale_; }

  TerrainNode& terrain() { return terrain_; }
  osg::Group& root() { return *root_; }

 private:
  void show_scale(const Snapshot& snapshot);
  void renew_shadows(double time, bool ground_moved, bool bodies_move);
  LitView& lit() { return look_.quality == Quality::fast ? fast_ : fine_; }

  osg::ref_ptr<osg::Group> root_;
  TerrainNode terrain_;
  BodyNode bodies_, line_bodies_;
  BombNode bombs_;
  ParticleNode particles_;
  ExplosionNode explosions_;
  BoxNode boxes_;
  LitView fine_, fast_;
  bool has_looks_ = false;
  Look look_;
  ColorScale scale_;
  osg::Vec3d eye_;
  double extent_ = 1;                    // m, of the region that is looked at
  double view_height_ = 1;               // m, that the picture shows from top to bottom where the camera looks at
  double time_ = -1, shadow_time_ = -1;  // s, of the last update and of the world that fast shadows show
  bool shadows_late_ = false;
  osg::ref_ptr<osg::Uniform> height_range_, detail_wave_, sinkage_scale_, ink_cell_, color_by_, ramp_, ramp_range_;
  osg::ref_ptr<osg::Group> lines_;
};

}  // namespace divot::viewer
