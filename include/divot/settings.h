#pragma once

#include <cstdint>

namespace divot {

enum class Cohesion : std::uint8_t { lennard_jones, mass_spring };  ///< eq. 6, eq. 1
enum class Blast : std::uint8_t { scaled, paper };                  ///< docs/physics.md, "Blast"
enum class Integrator : std::uint8_t { automatic, euler, rk4 };  ///< automatic: rk4 while a blast acts, euler otherwise
enum class Neighbours : std::uint8_t { grid, kd_tree };          ///< both give the same rows

/// How often a search structure is brought up to date (the paper's Figure 1).
struct UpdatePolicy {
  /// See `kind`.
  enum class Kind : std::uint8_t { adaptive, every_step, every };
  Kind kind = Kind::adaptive;  ///< adaptive: when the ground has moved so far that something could be missed
  int steps = 1;               ///< kind every: rebuilt each so many steps, whatever is missed in between; >= 1
  friend bool operator==(const UpdatePolicy&, const UpdatePolicy&) = default;  ///< member by member
};

/// How a world is solved. Set by designated initialisers.
struct Settings {
  Cohesion cohesion = Cohesion::lennard_jones;    ///< force between particles
  Blast blast = Blast::scaled;                    ///< what a bomb does
  Integrator integrator = Integrator::automatic;  ///< how particles move
  Neighbours neighbours = Neighbours::grid;       ///< how rows are found
  UpdatePolicy neighbour_update;                  ///< of the rows of neighbours
  UpdatePolicy bvh_update;                        ///< of the bounding volume hierarchy
  double cutoff =
      1.6;             ///< range of cohesion in grid spacings, [1.1, 4]; 1.6 reaches the eight nearest on a square grid
  double skin = 0.38;  ///< reach added to neighbour rows so that they last, in grid spacings, (0, 2]
};

}  // namespace divot
