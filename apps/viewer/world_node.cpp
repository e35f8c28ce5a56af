#include "divot_osg/world_node.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <osg/FrameStamp>
#include <osg/NodeVisitor>

#include "viewer/body_node.h"
#include "viewer/node_look.h"
#include "viewer/snapshot.h"
#include "viewer/sphere.h"
#include "viewer/terrain_node.h"

namespace divot::viewer {

struct WorldNode::Impl {
  Impl(World taken, const WorldNodeOptions& asked) : world(std::move(taken)), options(asked), balls(make_sphere()) {
    style = options.look == NodeLook::divot ? make_divot_style(terrain, balls)
                                            : make_application_style(terrain, balls.root(), options);
    terrain.set_looks(style->looks(world.materials(), world.scene().folder));
  }

  void place_models(const Snapshot& snapshot);

  World world;
  WorldNodeOptions options;
  TerrainNode terrain;
  BodyNode balls;
  std::unique_ptr<NodeStyle> style;
  std::map<std::uint32_t, osg::ref_ptr<osg::MatrixTransform>> models;  // by body
  double due = 0;                                                      // s that no step has covered yet
  std::optional<double> last_time;                                     // s, of the frame stamp
};

void WorldNode::Impl::place_models(const Snapshot& snapshot) {
  for (const auto& [body, node] : models) {
    const BodyView& view = snapshot.bodies[body];
    const Vec3d& p = view.position;
    const Quat& q = view.orientation;
    node->setMatrix(osg::Matrixd::rotate(osg::Quat(q.x, q.y, q.z, q.w)) * osg::Matrixd::translate(p.x, p.y, p.z));
    balls.hide(body);
  }
}

WorldNode::WorldNode(World world, const WorldNodeOptions& options)
    : impl_(std::make_unique<Impl>(std::move(world), options)) {
  // What is drawn is relative to the surface's origin, so that floats have digits left for it.
  const Vec3d origin = impl_->world.surface().origin;
  osg::ref_ptr<osg::MatrixTransform> place =
      new osg::MatrixTransform(osg::Matrixd::translate(origin.x, origin.y, origin.z));
  place->addChild(&impl_->style->root());
  addChild(place);
  setNumChildrenRequiringUpdateTraversal(getNumChildrenRequiringUpdateTraversal() + 1);
  refresh();
}

WorldNode::~WorldNode() = default;

Result<osg::ref_ptr<WorldNode>> WorldNode::create(const Scene& scene, std::shared_ptr<const Jobs> jobs,
                                                  const WorldNodeOptions& options) {
  return World::create(scene, std::move(jobs)).map([&](World&& world) {
    return osg::ref_ptr<WorldNode>(new WorldNode(std::move(world), options));
  });
}

World& WorldNode::world() { return impl_->world; }
const World& WorldNode::world() const { return impl_->world; }
std::uint64_t WorldNode::uploaded_bytes() const { return impl_->terrain.uploaded_bytes(); }

int WorldNode::advance(double seconds) {
  const double dt = impl_->world.scene().dt;
  impl_->due += seconds;
  int steps = 0;
  for (; impl_->due >= dt && steps < impl_->options.most_steps; ++steps) {
    impl_->world.step();
    impl_->due -= dt;
  }
  impl_->due = std::fmod(impl_->due, dt);
  if (steps > 0) refresh();
  return steps;
}

void WorldNode::refresh() {
  const Snapshot snapshot = take_snapshot(impl_->world);
  impl_->terrain.update(snapshot.surface, snapshot.dirty, snapshot.topology, snapshot.sinkage);
  impl_->balls.update(snapshot.surface.origin, snapshot.bodies);
  impl_->place_models(snapshot);
  impl_->style->update(snapshot, impl_->terrain);
}

osg::MatrixTransform& WorldNode::body_node(BodyId body) {
  osg::ref_ptr<osg::MatrixTransform>& node = impl_->models[body.value];
  if (!node) {
    node = new osg::MatrixTransform;
    addChild(node);
    refresh();
  }
  return *node;
}

void WorldNode::traverse(osg::NodeVisitor& visitor) {
  const osg::FrameStamp* stamp = visitor.getFrameStamp();
  if (visitor.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR && stamp != nullptr) {
    // The same time twice, from a second view or parent, is no time at all; nor is one that was set back.
    const double now = stamp->getSimulationTime();
    advance(std::max(0.0, now - impl_->last_time.value_or(now)));
    impl_->last_time = now;
  }
  osg::Group::traverse(visitor);
}

}  // namespace divot::viewer
