#pragma once

#include <cstdint>
#include <memory>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/Vec4>

#include "divot/world.h"

namespace divot::viewer {

/// How a world looks within somebody else's scene.
enum class NodeLook : std::uint8_t {
  application,  ///< vertices, normals and colours under the application's own lights, shaders and state
  divot,        ///< this library's shaders with its own sun and shadows; needs OpenGL 3.0 with compatibility
};

struct WorldNodeOptions {
  NodeLook look = NodeLook::application;
  int most_steps = 4;  ///< in one update, >= 1; what they cannot catch up with is dropped: simulated time lags then
  // Colours of NodeLook::application, red, green, blue and opacity, each 0 to 1. Materials with a colour or texture of
  // their own have those.
  osg::Vec4 soil = {0.48f, 0.45f, 0.28f, 1};    ///< that nothing has touched
  osg::Vec4 turned = {0.30f, 0.22f, 0.14f, 1};  ///< that was sunk, thrown or rolled over
  osg::Vec4 body = {0.80f, 0.80f, 0.78f, 1};
};

/// A world as a node of an application's scene graph: ground and bodies, in the terrain's coordinates. Each update
/// traversal steps it as far as the frame stamp's simulation time went on, so that an application that pauses its time
/// pauses the world. Several can stand in one graph.
class WorldNode : public osg::Group {
 public:
  /// Takes over `world`. [O(faces)]
  explicit WorldNode(World world, const WorldNodeOptions& options = {});

  /// Loads a scene's world into a node. Fails like World::create.
  static Result<osg::ref_ptr<WorldNode>> create(const Scene& scene, std::shared_ptr<const Jobs> jobs = nullptr,
                                                const WorldNodeOptions& options = {});

  /// For bombs, bodies and questions; not while the graph is being updated. What take_dirty() names is lost for the
  /// picture: leave that to the node.
  World& world();
  const World& world() const;

  /// Steps as far as `seconds` (>= 0) of simulated time ask for, without a frame stamp. Returns the steps made.
  int advance(double seconds);

  /// Shows the world as it is now; advance() and update traversals do it when they have stepped. [O(chunks + bodies +
  /// dirty chunks)]
  void refresh();

  /// The transform that follows a body, with its centre at the origin and its axes as they were at the start: what is
  /// put below it moves as the body does, in metres. From now on the body is not drawn in its shape. `body`: of this
  /// world.
  osg::MatrixTransform& body_node(BodyId body);

  /// Bytes of vertices and indices that were handed over to be sent to the graphics card so far.
  std::uint64_t uploaded_bytes() const;

  const char* libraryName() const override { return "divot"; }
  const char* className() const override { return "WorldNode"; }
  void traverse(osg::NodeVisitor& visitor) override;

 protected:
  ~WorldNode() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot::viewer
