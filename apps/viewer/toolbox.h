#pragma once

#include <string>
#include <vector>

#include "divot/world.h"

namespace divot::viewer {

/// What a hand can throw into a world: a bomb of a chosen yield and bodies to choose from.
class Toolbox {
 public:
  /// The bodies are those of the scene, and two balls in proportion to its ground: heavy enough for its soil to give
  /// way.
  explicit Toolbox(const World& world);

  /// Steps of 1, 2, 5, 10 ... from 0.1 t to 100 kt. `up` false: less.
  void change_yield(bool up);
  double yield() const;  ///< t of TNT

  void next_body();
  /// What is chosen, for people.
  std::string body_text() const;

  /// Sets off a bomb on the ground at x, y, m, in the terrain's coordinates, in the next step.
  Result<void> bomb(World& world, double x, double y) const;
  /// Lets the chosen body fall from above the ground at x, y.
  Result<void> drop(World& world, double x, double y) const;

 private:
  int yield_step_ = 0;  // thirds of a power of ten
  std::vector<BodySettings> bodies_;
  std::size_t body_ = 0;
};

}  // namespace divot::viewer
