#include "viewer/scene_graph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "viewer/line_view.h"
#include "viewer/soil_looks.h"
#include "viewer/sphere.h"

namespace divot::viewer {
namespace {

constexpr float kDetailWaves = 5;     // longest waves of colour across the region
constexpr double kFlatRelief = 0.01;  // terrain whose relief is a smaller share of its extent has no colours of height
constexpr double kDenseCell = 1.0 / 360;  // of the picture's height: a mesh cell of two pixels
// Simulated s between two shadow maps where quality is fast and only the ground moves, or bodies too.
constexpr double kGroundPause = 0.06, kBodyPause = 0.03;

void show(osg::Node& node, bool shown) { node.setNodeMask(shown ? ~0u : 0u); }

}  // namespace

SceneGraph::SceneGraph(const Sun& sun, const Look& look)
    : root_(new osg::Group),
      bodies_(make_sphere()),
      line_bodies_(make_line_sphere()),
      bombs_(make_sphere()),
      fine_({terrain_.ground(), terrain_.walls(), bodies_.root(), bodies_.solids(), bombs_.root()}, sun, Quality::fine),
      fast_({terrain_.ground(), terrain_.walls(), bodies_.root(), bodies_.solids(), bombs_.root()}, sun, Quality::fast),
      height_range_(new osg::Uniform("height_range", osg::Vec2())),
      detail_wave_(new osg::Uniform("detail_wave", 1.0f)),
      sinkage_scale_(new osg::Uniform("sinkage_scale", 1.0f)),
      ink_cell_(new osg::Uniform("ink_cell", 0.0f)),
      color_by_(new osg::Uniform("color_by", 0)),
      ramp_(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "ramp", kScaleStops)),
      ramp_range_(new osg::Uniform("ramp_range", osg::Vec2(0, 1))) {
  lines_ = make_line_view(
      {terrain_.mesh(), terrain_.walls(), line_bodies_.root(), line_bodies_.solids(), bombs_.root()}, *ink_cell_);
  for (const auto& uniform : {height_range_, detail_wave_, sinkage_scale_, color_by_, ramp_, ramp_range_}) {
    root_->getOrCreateStateSet()->addUniform(uniform);
  }
  for (osg::Node* child : {static_cast<osg::Node*>(&fine_.root()), static_cast<osg::Node*>(&fast_.root()),
                           static_cast<osg::Node*>(lines_), &particles_.root(), &boxes_.root(), &explosions_.root()}) {
    root_->addChild(child);
  }
  set_look(look);
}

void SceneGraph::set_look(const Look& look) {
  if (look.wireframe != look_.wireframe || look.quality != look_.quality) {
    // The view that comes has not followed the world.
    fine_.lighting().renew_shadows();
    fast_.lighting().renew_shadows();
  }
  look_ = look;
  show(*lines_, look.wireframe);
  show(fine_.root(), !look.wireframe && look.quality == Quality::fine);
  show(fast_.root(), !look.wireframe && look.quality == Quality::fast);
  show(particles_.root(), look.particles);
  show(explosions_.root(), look.effects && !look.wireframe);
  color_by_->set(static_cast<int>(look.color));
}

void SceneGraph::begin_another_world() {
  terrain_.forget();
  fine_.lighting().renew_shadows();
  fast_.lighting().renew_shadows();
}

void SceneGraph::update(const Snapshot& snapshot) {
  const SurfaceView& surface = snapshot.surface;
  if (!std::exchange(has_looks_, true)) terrain_.set_looks(soil_looks(snapshot.materials, snapshot.folder));
  terrain_.update(surface, snapshot.dirty, snapshot.topology, snapshot.sinkage);
  if (look_.color == ColorBy::awake) terrain_.mark_awake(snapshot.particles.vertices);
  const float relief = terrain_.highest() - terrain_.lowest();
  const bool flat = relief < kFlatRelief * terrain_.bounds().extent();
  height_range_->set(osg::Vec2(terrain_.lowest(), flat ? 0.0f : 1 / relief));
  sinkage_scale_->set(static_cast<float>(surface.spacing));
  ink_cell_->set(static_cast<float>(surface.spacing));
  show_scale(snapshot);
  lit().set_style(look_.color != ColorBy::natural, surface.spacing < kDenseCell * view_height_);

  bodies_.update(surface.origin, snapshot.bodies);
  line_bodies_.update(surface.origin, snapshot.bodies);
  bombs_.update(surface.origin, snapshot.bombs, extent_);
  if (look_.particles) particles_.update(snapshot.particles, surface.spacing);
  if (look_.effects) explosions_.update(surface.origin, snapshot.bombs, snapshot.time, eye_, look_.quality);
  lit().lighting().set_occluders(surface.origin, snapshot.bodies);
  const bool rolls = std::any_of(snapshot.bodies.begin(), snapshot.bodies.end(),
                                 [](const BodyView& b) { return ball_radius(b) == 0 && b.velocity != Vec3d(); });
  renew_shadows(snapshot.time, !snapshot.dirty.empty(), rolls);
}

void SceneGraph::show_scale(const Snapshot& snapshot) {
  scale_ = color_scale(look_.color, {.lowest = terrain_.lowest(),
                                     .highest = terrain_.highest(),
                                     .largest_sinkage = terrain_.largest_sinkage(),
                                     .materials = snapshot.materials});
  for (unsigned i = 0; i < kScaleStops; ++i) {
    const ColorScale::Rgb& c = scale_.stops[i];
    ramp_->setElement(i, osg::Vec3(c[0], c[1], c[2]));
  }
  ramp_range_->set(osg::Vec2(scale_.low, 1 / (scale_.high - scale_.low)));
}

// Fine shadows are always up to date. Fast ones, but those of balls, may be a little late, and catch up when time
// stops.
void SceneGraph::renew_shadows(double time, bool ground_moved, bool bodies_move) {
  if (look_.quality == Quality::fine) return fine_.lighting().renew_shadows();
  const bool stopped = std::exchange(time_, time) == time;
  shadows_late_ = shadows_late_ || ground_moved || (bodies_move && !stopped);
  if (!shadows_late_) return;
  const double age = time - shadow_time_;
  if (!stopped && age >= 0 && age < (bodies_move ? kBodyPause : kGroundPause)) return;
  shadows_late_ = false;
  shadow_time_ = time;
  fast_.lighting().renew_shadows();
}

void SceneGraph::set_view(const Vec3d& origin, const Region& region, const Camera& camera) {
  extent_ = region.extent();
  detail_wave_->set(static_cast<float>(extent_) / kDetailWaves);
  const Vec3d eye = camera.eye - origin;
  set_eye({eye.x, eye.y, eye.z});
  set_focus(origin, region, camera);
}

void SceneGraph::set_focus(const Vec3d& origin, const Region& region, const Camera& camera) {
  // Shadows reach past the region's corners, as what lies there is in the picture too.
  const Vec3d center = region.center() - origin;
  const double distance = length(camera.target - camera.eye);
  view_height_ = 2 * distance * std::tan(camera.fov_deg * std::numbers::pi / 360);
  for (LitView* view : {&fine_, &fast_}) {
    view->lighting().set_focus({center.x, center.y, center.z}, 0.85 * length(region.max - region.min));
    view->lighting().set_haze(distance);
  }
}

}  // namespace divot::viewer
