#pragma once

#include <string>
#include <vector>

#include "divot/world.h"

namespace divot::viewer {

/// What a hand can throw into a world: a bomb of a chosen yield and bodies to choose from.
class Toolbox {
 public:
  /// The bodies are those of the scene, those that joints hold together as one, and two balls in proportion to its
  /// ground: heavy enough for the soil that they are dropped on to give way. `world`: as created.
  explicit Toolbox(const World& world);

  /// Steps of 1, 2, 5, 10 ... from 0.1 t to 100 kt. `up` false: less.
  void change_yield(bool up);
  double yield() const;  ///< t of TNT

  void next_body();
  /// What is chosen, for people.
  std::string body_text() const;

  /// Sets off a bomb on the ground at x, y, m, in the terrain's coordinates, in the next step.
  Result<void> bomb(World& world, double x, double y) const;
  /// Lets the chosen body, with all that joints hold to it, fall from above the ground at x, y. Joints with the terrain
  /// stay behind. [O(vertices) for a ball that its soil weighs]
  Result<void> drop(World& world, double x, double y) const;

 private:
  // What falls as one: a body, or all that joints hold together.
  struct Tool {
    std::vector<BodySettings> bodies;  // position: from that of the first
    std::vector<double> radii;         // [body] m, of the balls that hold them
    std::vector<Joint> joints;         // between them
    bool weighed = false;              // gets its mass from the soil that it is dropped on
  };
  static Tool take_assembly(const World& world, std::vector<bool>& taken, std::size_t first);
  static Result<void> drop_bodies(World& world, const Tool& tool, const Vec3d& at);

  int yield_step_ = 0;  // thirds of a power of ten
  std::vector<Tool> tools_;
  std::size_t tool_ = 0;
};

}  // namespace divot::viewer
