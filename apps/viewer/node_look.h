#pragma once

#include <memory>
#include <osg/Group>
#include <span>
#include <string>
#include <vector>

#include "divot_osg/world_node.h"
#include "viewer/body_node.h"
#include "viewer/snapshot.h"
#include "viewer/terrain_node.h"

namespace divot::viewer {

/// How a WorldNode draws what it holds.
class NodeStyle {
 public:
  virtual ~NodeStyle() = default;
  /// State of the ground by material, see TerrainNode::set_looks.
  virtual std::vector<osg::ref_ptr<osg::StateSet>> looks(std::span<const Material> materials,
                                                         const std::string& folder) = 0;
  /// Follows the world, after ground and bodies were updated.
  virtual void update(const Snapshot& snapshot, TerrainNode& terrain) = 0;
  /// What is to be drawn, in coordinates relative to the surface's origin.
  virtual osg::Node& root() = 0;
};

/// Under the application's own state: colours by vertex, which its lights may shade.
std::unique_ptr<NodeStyle> make_application_style(TerrainNode& terrain, osg::Group& bodies,
                                                  const WorldNodeOptions& options);

/// With this library's shaders, sun and shadows; the sky is the application's.
std::unique_ptr<NodeStyle> make_divot_style(TerrainNode& terrain, BodyNode& bodies);

}  // namespace divot::viewer
