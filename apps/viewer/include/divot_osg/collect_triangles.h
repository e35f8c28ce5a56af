#pragma once

#include <osg/Node>

#include "divot/scene.h"

namespace divot::viewer {

/// The triangles of a sub-graph as ground to stand on, with the transforms within it (its own root's included) applied:
/// in the coordinates of the sub-graph's parent. Nodes that are switched off are left out; of levels of detail the
/// finest is taken, of paged ones what is loaded.
///
/// Corners nearer than `tolerance` (m, >= 0) to an earlier one become that one; 0 joins equal ones only. Triangles
/// without area are dropped. Fails when none are left or `tolerance` is out of range; whether what is left makes ground
/// is checked where a world is made of it. [O(triangles)]
Result<MeshTerrain> collect_triangles(osg::Node& subgraph, double tolerance = 0);

}  // namespace divot::viewer
