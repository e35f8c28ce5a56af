#pragma once

#include <string>
#include <vector>

#include "scene/reader.h"

namespace divot::scene {

/// Another file whose bodies, joints, bombs and materials join the scene.
struct Include {
  std::string file = {};   ///< relative paths start at the folder of the file that includes
  std::string name = {};   ///< put before the names of its bodies and joints, with a slash; empty: nothing
  Vec3d position = {};     ///< m, where its origin comes to lie
  bool on_ground = false;  ///< its bodies stand on the ground at x, y as one assembly
  double heading_deg = 0;  ///< it is turned by this about z, counter-clockwise from above
};

/// The keys of an include, for reading and for the docs.
void describe(Visitor& visitor, std::vector<Include>& includes);

/// Replaces `include` in a document by what the named files hold, theirs included. Nodes keep the file and line they
/// come from. `file`: what the document was parsed as; `chain`: the files that led to it. Returns what is wrong.
Errors expand_includes(toml::table& document, const std::string& file, std::vector<std::string> chain = {});

/// The text of a file; fails with the system's reason.
Result<std::string> read_scene_file(const std::string& path);

}  // namespace divot::scene
