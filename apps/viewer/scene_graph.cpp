#include "viewer/scene_graph.h"

#include <osg/CullFace>
#include <osg/LineWidth>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>

#include "viewer/shaders.h"
#include "viewer/sky.h"
#include "viewer/sphere.h"

namespace divot::viewer {
namespace {

// Of the gradient behind a lit picture, as shown.
const osg::Vec3 kSkyTop(0.56f, 0.69f, 0.84f), kSkyBottom(0.90f, 0.93f, 0.95f);
// Of a line drawing.
const osg::Vec3 kPaper(0.972f, 0.972f, 0.962f), kInk(0.20f, 0.25f, 0.32f), kTurnedInk(0.62f, 0.24f, 0.10f);
const osg::Vec3 kBodyInk(0.10f, 0.28f, 0.52f), kBombInk(0.05f, 0.05f, 0.06f);
// Linear colours of balls.
const osg::Vec3 kBodyColor(0.80f, 0.80f, 0.78f), kPatternColor(0.07f, 0.12f, 0.20f), kBombColor(0.012f, 0.012f, 0.014f);

constexpr float kDetailWaves = 5;     // longest waves of colour across the region
constexpr double kFlatRelief = 0.01;  // terrain whose relief is a smaller share of its extent has no colours of height

osg::ref_ptr<osg::Group> group_of(std::initializer_list<osg::Node*> children, osg::Program* program) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (osg::Node* child : children) group->addChild(child);
  group->getOrCreateStateSet()->setAttributeAndModes(program);
  return group;
}

void set_colors(osg::Group& balls, const osg::Vec3& color, const osg::Vec3& pattern) {
  balls.getOrCreateStateSet()->addUniform(new osg::Uniform("ball_color", color));
  balls.getOrCreateStateSet()->addUniform(new osg::Uniform("pattern_color", pattern));
}

// `nodes` in one colour. `turned`: for ground that moved. `cell`: width of a mesh cell in m, by which lines far away
// fade; 0: never.
osg::ref_ptr<osg::Group> inked(std::initializer_list<osg::Node*> nodes, osg::Program* program, const osg::Vec3& color,
                               const osg::Vec3& turned, osg::Uniform* cell) {
  osg::ref_ptr<osg::Group> group = group_of(nodes, program);
  osg::StateSet* state = group->getOrCreateStateSet();
  state->addUniform(new osg::Uniform("ink", color));
  state->addUniform(new osg::Uniform("turned_ink", turned));
  state->addUniform(cell);
  return group;
}

void draw_edges(osg::Group& group) {
  osg::StateSet* state = group.getOrCreateStateSet();
  state->setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
  state->setAttributeAndModes(new osg::LineWidth(1.0f));
}

}  // namespace

SceneGraph::SceneGraph(const Sun& sun, bool wireframe)
    : root_(new osg::Group),
      bodies_(wireframe ? make_line_sphere() : make_sphere()),
      bombs_(make_sphere()),
      lighting_(sun),
      height_range_(new osg::Uniform("height_range", osg::Vec2())),
      detail_wave_(new osg::Uniform("detail_wave", 1.0f)),
      sinkage_scale_(new osg::Uniform("sinkage_scale", 1.0f)),
      ink_cell_(new osg::Uniform("ink_cell", 0.0f)) {
  for (const auto& uniform : {height_range_, detail_wave_, sinkage_scale_}) {
    root_->getOrCreateStateSet()->addUniform(uniform);
  }
  wireframe ? build_wireframe() : build_lit();
}

void SceneGraph::build_lit() {
  root_->addChild(make_background(kSkyTop, kSkyBottom));
  for (osg::Group* caster : {&terrain_.ground(), &terrain_.walls(), &bodies_.root(), &bombs_.root()}) {
    lighting_.shadow_pass().addChild(caster);
  }
  root_->addChild(&lighting_.shadow_pass());

  osg::ref_ptr<osg::Program> ball = ball_program();
  osg::ref_ptr<osg::Group> lit = new osg::Group;
  lighting_.apply(*lit->getOrCreateStateSet());
  // Ground and walls are seen from outside only: from inside they would flicker along ridges and far edges.
  osg::ref_ptr<osg::Group> block = new osg::Group;
  block->addChild(group_of({&terrain_.ground()}, ground_program()));
  block->addChild(group_of({&terrain_.walls()}, wall_program()));
  block->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
  lit->addChild(block);
  osg::ref_ptr<osg::Group> bodies = group_of({&bodies_.root()}, ball), bombs = group_of({&bombs_.root()}, ball);
  set_colors(*bodies, kBodyColor, kPatternColor);
  set_colors(*bombs, kBombColor, kBombColor);
  lit->addChild(bodies);
  lit->addChild(bombs);
  root_->addChild(lit);
}

// Hidden lines: everything is first filled with paper, pushed back a little, and then drawn as edges.
void SceneGraph::build_wireframe() {
  root_->addChild(make_background(kPaper, kPaper));
  root_->getOrCreateStateSet()->addUniform(new osg::Uniform("paper", kPaper));
  osg::ref_ptr<osg::Program> ink = ink_program();
  osg::ref_ptr<osg::Uniform> never = new osg::Uniform("ink_cell", 0.0f);
  osg::ref_ptr<osg::Group> filling =
      inked({&terrain_.ground(), &terrain_.walls(), &bodies_.root()}, ink, kPaper, kPaper, never);
  filling->getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(1, 1));
  osg::ref_ptr<osg::Group> ground = inked({&terrain_.ground()}, ink, kInk, kTurnedInk, ink_cell_);
  osg::ref_ptr<osg::Group> bodies = inked({&bodies_.root()}, ink, kBodyInk, kBodyInk, never);
  draw_edges(*ground);
  draw_edges(*bodies);
  root_->addChild(filling);
  root_->addChild(ground);
  root_->addChild(bodies);
  root_->addChild(inked({&bombs_.root()}, ink, kBombInk, kBombInk, never));
}

void SceneGraph::update(const SurfaceView& surface, std::span<const DirtyRange> dirty, std::span<const BodyView> bodies,
                        std::span<const BombView> bombs, const Sinkage& sinkage) {
  terrain_.update(surface, dirty, sinkage);
  const float relief = terrain_.highest() - terrain_.lowest();
  const bool flat = relief < kFlatRelief * terrain_.bounds().extent();
  height_range_->set(osg::Vec2(terrain_.lowest(), flat ? 0.0f : 1 / relief));
  sinkage_scale_->set(static_cast<float>(surface.spacing));
  ink_cell_->set(static_cast<float>(surface.spacing));
  bodies_.update(surface.origin, bodies);
  bombs_.update(surface.origin, bombs, extent_);
  lighting_.set_occluders(surface.origin, bodies);
}

void SceneGraph::set_view(const Vec3d& origin, const Region& region, const Camera& camera) {
  extent_ = region.extent();
  detail_wave_->set(static_cast<float>(extent_) / kDetailWaves);
  // Shadows reach past the region's corners, as what lies there is in the picture too.
  const Vec3d center = region.center() - origin;
  lighting_.set_focus({center.x, center.y, center.z}, 0.85 * length(region.max - region.min));
  lighting_.set_haze(length(camera.target - camera.eye));
}

}  // namespace divot::viewer
