// A program that puts a world into a scene graph with an installed divot.
#include "divot_osg/collect_triangles.h"
#include "divot_osg/world_node.h"

int main() {
  const auto node = divot::viewer::WorldNode::create(divot::Scene{});
  return node && divot::viewer::collect_triangles(**node) ? 0 : 1;
}
