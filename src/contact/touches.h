#pragma once

#include <btBulletDynamicsCommon.h>

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace divot::contact {

/// Points at which a piece of one body touches one of another.
struct Touch {
  std::array<int, 6> key{};             ///< Bullet's indices of the two bodies, then of their parts
  double breaking = 0, processing = 0;  ///< m, Bullet's thresholds of the two
  std::uint8_t count = 0;
  std::array<btManifoldPoint, MANIFOLD_CACHE_SIZE> points;
};

/// Where bodies touch each other, remembered from one step to the next outside of Bullet, whose own memory also depends
/// on which boxes overlapped long ago. Bullet finds touches anew in each step, as a rule a point for each pair of
/// pieces; those of the step before that still hold come to them, and all keep their impulses.
class Touches {
 public:
  /// User index of the ground's rigid faces.
  static constexpr int kGround = std::numeric_limits<int>::max();

  /// What stands still, with the outward normal of each of its triangles, 1 long.
  void add_ground(const btRigidBody& ground, std::vector<btVector3> normals) {
    ground_ = &ground, normals_ = std::move(normals);
  }

  /// A body that others may touch; its user index counts up from 0.
  void add(const btRigidBody& body) { bodies_.push_back(&body); }

  /// Before Bullet looks for touches: it knows of none.
  static void clear(btDispatcher& dispatcher);

  /// Adds what is remembered and still holds to the `count` that Bullet found. What there is then, in an order that
  /// tells nothing of the past, and ready to be solved.
  std::span<btPersistentManifold*> recall(btPersistentManifold** found, int count);

  /// After the step: remembers what it left.
  void remember();

  /// All that is remembered, as bytes, and back. False where the bytes are not of that kind; nothing is remembered
  /// then.
  std::string save() const;
  bool restore(std::string_view bytes);

 private:
  btPersistentManifold& next_own(const Touch& touch);
  const btRigidBody* body(int index) const;
  bool is_faced(const btPersistentManifold& manifold, const btManifoldPoint& point) const;
  void drop_unfaced(btPersistentManifold& manifold) const;

  std::vector<const btRigidBody*> bodies_;
  const btRigidBody* ground_ = nullptr;
  std::vector<btVector3> normals_;                          // [triangle of the ground]
  std::vector<Touch> touches_;                              // ascending by key
  std::vector<btPersistentManifold*> found_, now_;          // likewise
  std::vector<std::unique_ptr<btPersistentManifold>> own_;  // for touches that Bullet found no more
  std::size_t own_used_ = 0;
};

}  // namespace divot::contact
