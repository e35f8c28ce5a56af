#pragma once

#include <string>
#include <vector>

namespace divot::scene {

/// A key of the scene file as docs/scene-format.md shows it.
struct KeyInfo {
  std::string path;           ///< `bodies[].mass`, `materials.NAME.kphi`
  std::string type;           ///< `number, kg`
  std::string range;          ///< `> 0`; empty where there is none
  std::string default_value;  ///< `required` where the file must hold it
  std::string meaning;
};

/// Every key, in the order of the page. [O(keys)]
std::vector<KeyInfo> scene_keys();

}  // namespace divot::scene
