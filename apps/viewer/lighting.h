#pragma once

#include <osg/Camera>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <span>
#include <vector>

#include "divot/views.h"
#include "viewer/camera.h"
#include "viewer/look.h"

namespace divot::viewer {

/// Where the sun stands.
struct Sun {
  double azimuth_deg = 68;    ///< degrees clockwise from north (y)
  double elevation_deg = 29;  ///< degrees above the horizon, (0, 90]; low suns show relief
};

/// Sun, sky light, haze and shadows, as uniforms and a shadow map for all that is lit.
class Lighting {
 public:
  Lighting(const Sun& sun, Quality quality);

  /// Adds the light to what is drawn under `state`.
  void apply(osg::StateSet& state);

  /// What throws shadows: children of this are drawn as the sun sees them.
  osg::Group& casters() { return *shadow_pass_; }

  /// The pass that draws the casters. Put it beside what is lit.
  osg::Node& shadow_root() { return *shadow_root_; }

  /// The casters have changed: the next picture draws the shadow map anew, otherwise it stays as it is.
  void renew_shadows();

  /// Lays the shadow map over `center` with `radius` (m, relative to the surface's origin; > 0); beyond it nothing
  /// throws shadows.
  void set_focus(const osg::Vec3d& center, double radius);

  /// Haze begins at `distance` from the eye, m, > 0.
  void set_haze(double distance);

  /// Call after set_focus(). Balls darken the ground beneath them, and throw round shadows where the quality is fast.
  /// `origin`: the surface's. [O(bodies log bodies)]
  void set_occluders(const Vec3d& origin, std::span<const BodyView> bodies);

 private:
  void set_ball_count(std::size_t count);

  osg::Vec3d sun_direction_;  // unit, towards the sun
  Quality quality_;
  std::size_t ball_count_ = 0;  // that throw shadows by formula
  osg::Matrixd shadow_space_;   // to the shadow map, 0 to 1
  double shadow_radius_ = 1;    // m
  int shadow_size_;             // texels along a side
  osg::ref_ptr<osg::Group> shadow_root_;
  osg::ref_ptr<osg::Camera> shadow_pass_;
  osg::ref_ptr<osg::Texture2D> shadow_map_;
  std::vector<osg::ref_ptr<osg::StateSet>> lit_;  // what apply() was called with
  osg::ref_ptr<osg::Uniform> shadow_matrix_, shadow_texel_, haze_range_, occluders_, occluder_count_, ball_shadows_;
};

}  // namespace divot::viewer
