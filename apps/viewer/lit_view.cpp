#include "viewer/lit_view.h"

#include <osg/CullFace>

#include "viewer/grain.h"
#include "viewer/sky.h"

namespace divot::viewer {
namespace {

// Of the gradient behind a lit picture, as shown.
const osg::Vec3 kSkyTop(0.56f, 0.69f, 0.84f), kSkyBottom(0.90f, 0.93f, 0.95f);
// Linear colours of balls.
const osg::Vec3 kBodyColor(0.80f, 0.80f, 0.78f), kPatternColor(0.07f, 0.12f, 0.20f), kBombColor(0.012f, 0.012f, 0.014f);

constexpr unsigned kGrainUnit = 2;  // texture unit; shadows use 1

osg::ref_ptr<osg::Group> group_of(osg::Node& child, osg::Program* program) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(&child);
  group->getOrCreateStateSet()->setAttributeAndModes(program);
  return group;
}

osg::ref_ptr<osg::Group> balls(osg::Node& child, osg::Program* program, const osg::Vec3& color,
                               const osg::Vec3& pattern) {
  osg::ref_ptr<osg::Group> group = group_of(child, program);
  group->getOrCreateStateSet()->addUniform(new osg::Uniform("ball_color", color));
  group->getOrCreateStateSet()->addUniform(new osg::Uniform("pattern_color", pattern));
  group->getOrCreateStateSet()->addUniform(new osg::Uniform("pattern_share", 1.0f));
  return group;
}

}  // namespace

LitView::LitView(const Subjects& subjects, const Sun& sun, Quality quality)
    : style_{.quality = quality},
      ground_(group_of(subjects.ground, ground_program(style_))),
      root_(new osg::Group),
      lighting_(sun, quality) {
  for (osg::Group* caster : {&subjects.ground, &subjects.walls, &subjects.bombs}) lighting_.casters().addChild(caster);
  // Where quality is fast the shadows of balls are formulas.
  lighting_.casters().addChild(quality == Quality::fine ? &subjects.bodies : &subjects.solids);
  root_->addChild(&lighting_.shadow_root());

  // Ground and walls are seen from outside only: from inside they would flicker along ridges and far edges.
  osg::ref_ptr<osg::Group> block = new osg::Group;
  block->addChild(ground_);
  block->addChild(group_of(subjects.walls, wall_program(quality)));
  block->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));

  osg::ref_ptr<osg::Group> lit = new osg::Group;
  osg::StateSet* state = lit->getOrCreateStateSet();
  lighting_.apply(*state);
  if (quality == Quality::fast) {
    state->setTextureAttributeAndModes(kGrainUnit, make_grain());
    state->addUniform(new osg::Uniform("grain", static_cast<int>(kGrainUnit)));
  }
  osg::ref_ptr<osg::Program> ball = ball_program(quality);
  lit->addChild(block);
  lit->addChild(balls(subjects.bodies, ball, kBodyColor, kPatternColor));
  lit->addChild(balls(subjects.bombs, ball, kBombColor, kBombColor));
  root_->addChild(lit);
  root_->addChild(make_background(kSkyTop, kSkyBottom, quality));
}

void LitView::set_style(bool numbers, bool dense) {
  const GroundStyle wanted{.quality = style_.quality, .numbers = numbers, .dense = dense};
  if (wanted == style_) return;
  style_ = wanted;
  ground_->getOrCreateStateSet()->setAttributeAndModes(ground_program(style_));
}

}  // namespace divot::viewer
