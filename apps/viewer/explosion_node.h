#pragma once

#include <osg/Geometry>
#include <span>
#include <vector>

#include "divot/views.h"
#include "viewer/look.h"

namespace divot::viewer {

/// Flash, thrown clods and dust of bombs that went off, as soft particles that face the eye. Where each particle is
/// follows from the bomb and the time alone: pausing, slow motion and running again show the same explosion.
class ExplosionNode {
 public:
  ExplosionNode();

  /// `origin`: the surface's, m. `eye`: m, relative to it; what is far is drawn first. `time`: of the world, s.
  /// Fast quality has less dust: covering the same pixel again and again is what explosions cost.
  /// [O(bombs + particles log particles)]
  void update(const Vec3d& origin, std::span<const BombView> bombs, double time, const osg::Vec3d& eye,
              Quality quality);

  osg::Node& root() { return *puffs_; }

 private:
  struct Puff {
    osg::Vec3 center;  // m
    float radius;      // m
    osg::Vec4 tint;    // colour times opacity, opacity
    float distance2;   // m^2, from the eye
  };
  void add_explosion(const osg::Vec3& at, double yield, double age, std::uint32_t seed);
  void add_flash(const osg::Vec3& at, float reach, float age);
  void add_dust(const osg::Vec3& at, float reach, float age, std::uint32_t seed);
  void add_clods(const osg::Vec3& at, float reach, double seconds, std::uint32_t seed);
  void fill_arrays();

  std::uint32_t dust_ = 0;  // puffs of an explosion
  std::vector<Puff> list_;
  osg::ref_ptr<osg::Geometry> puffs_;
  osg::ref_ptr<osg::Vec3Array> centers_, corners_;
  osg::ref_ptr<osg::Vec4Array> tints_;
  osg::ref_ptr<osg::DrawArrays> drawn_;
};

}  // namespace divot::viewer
