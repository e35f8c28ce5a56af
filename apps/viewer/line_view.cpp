#include "viewer/line_view.h"

#include <osg/LineWidth>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>

#include "viewer/shaders.h"
#include "viewer/sky.h"

namespace divot::viewer {
namespace {

const osg::Vec3 kPaper(0.972f, 0.972f, 0.962f), kInk(0.20f, 0.25f, 0.32f), kTurnedInk(0.62f, 0.24f, 0.10f);
const osg::Vec3 kBodyInk(0.10f, 0.28f, 0.52f), kBombInk(0.05f, 0.05f, 0.06f);

// `nodes` in one colour, another where ground has moved.
osg::ref_ptr<osg::Group> inked(std::initializer_list<osg::Node*> nodes, osg::Program* program, const osg::Vec3& color,
                               const osg::Vec3& turned) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (osg::Node* node : nodes) group->addChild(node);
  osg::StateSet* state = group->getOrCreateStateSet();
  state->setAttributeAndModes(program);
  state->addUniform(new osg::Uniform("ink", color));
  state->addUniform(new osg::Uniform("turned_ink", turned));
  return group;
}

// No fading, and no colours of numbers.
void make_plain(osg::Group& group) {
  group.getOrCreateStateSet()->addUniform(new osg::Uniform("ink_cell", 0.0f));
  group.getOrCreateStateSet()->addUniform(new osg::Uniform("color_by", 0));
}

void draw_edges(osg::Group& group) {
  osg::StateSet* state = group.getOrCreateStateSet();
  state->setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
  state->setAttributeAndModes(new osg::LineWidth(1.0f));
}

}  // namespace

// Everything is first filled with paper, pushed back a little, and then drawn as edges.
osg::ref_ptr<osg::Group> make_line_view(const Subjects& subjects, osg::Uniform& cell) {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(make_background(kPaper, kPaper, Quality::fast));
  root->getOrCreateStateSet()->addUniform(new osg::Uniform("paper", kPaper));
  osg::ref_ptr<osg::Program> ink = ink_program();
  osg::ref_ptr<osg::Group> filling = inked({&subjects.ground, &subjects.walls, &subjects.bodies}, ink, kPaper, kPaper);
  filling->getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(1, 1));
  osg::ref_ptr<osg::Group> ground = inked({&subjects.ground}, ink, kInk, kTurnedInk);
  ground->getOrCreateStateSet()->addUniform(&cell);
  osg::ref_ptr<osg::Group> bodies = inked({&subjects.bodies}, ink, kBodyInk, kBodyInk);
  osg::ref_ptr<osg::Group> bombs = inked({&subjects.bombs}, ink, kBombInk, kBombInk);
  for (osg::Group* plain : {filling.get(), bodies.get(), bombs.get()}) make_plain(*plain);
  draw_edges(*ground);
  draw_edges(*bodies);
  for (osg::Group* part : {filling.get(), ground.get(), bodies.get(), bombs.get()}) root->addChild(part);
  return root;
}

}  // namespace divot::viewer
