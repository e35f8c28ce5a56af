// An OpenSceneGraph application whose terrain gives way: osg_node [SCENE.osgt] [--shot FILE.png]
#include <cstdio>
#include <osg/ArgumentParser>
#include <osgDB/ReadFile>
#include <osgViewer/Viewer>

#include "divot_osg/collect_triangles.h"
#include "divot_osg/world_node.h"
#include "shot.h"

struct FindByName : osg::NodeVisitor {
  explicit FindByName(const char* wanted) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), name(wanted) {}
  void apply(osg::Node& node) override {
    if (node.getName() == name) found = &node;
    traverse(node);
  }
  std::string name;
  osg::ref_ptr<osg::Node> found;
};

int fail(const std::string& why) {
  std::fprintf(stderr, "osg_node: %s\n", why.c_str());
  return 2;
}

int main(int argc, char** argv) {
  osg::ArgumentParser arguments(&argc, argv);
  std::string shot;
  arguments.read("--shot", shot);
  const std::string file = argc > 1 ? argv[1] : HILLS_OSGT;
  osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(file);
  if (!root) return fail(file + ": cannot be read");

  // The ground: triangles that are in the scene already.
  FindByName find("terrain");
  root->accept(find);
  if (!find.found || find.found->getNumParents() == 0) return fail(file + ": has no node \"terrain\" below its root");
  auto mesh = divot::viewer::collect_triangles(*find.found, 1e-3);
  if (!mesh) return fail(mesh.error().front().text());

  // What happens on it: a boulder, and a bomb of 20 t half a second later.
  const divot::Vec3d center = mesh->vertices[mesh->vertices.size() / 2];
  divot::Scene scene;
  scene.terrain = {.shape = std::move(*mesh), .material = "dry_sand"};
  scene.bodies = {
      {.name = "boulder", .shape = divot::Sphere{3}, .mass = 200e3, .position = center + divot::Vec3d{-48, -4, 0}}};
  scene.bodies[0].position.z = 0;
  scene.bodies[0].above_ground = true;
  scene.bodies[0].velocity = {20, 0, 0};
  scene.bombs = {{.time = 0.5, .position = center, .yield = 20}};
  auto world = divot::viewer::WorldNode::create(scene);
  if (!world) return fail(world.error().front().text());
  find.found->getParent(0)->replaceChild(find.found, *world);

  osgViewer::Viewer viewer;
  viewer.setLightingMode(osg::View::NO_LIGHT);  // the scene has a sun
  viewer.setSceneData(root);
  return shot.empty() ? viewer.run() : take_shot(viewer, shot);
}
