#include "contact/touches.h"

#include <algorithm>

#include "core/archive.h"

namespace divot::contact {
namespace {

template <class Archive, class Point>
void archive_point(Archive& a, Point& p) {
  for (auto* v : {&p.m_localPointA, &p.m_localPointB, &p.m_positionWorldOnA, &p.m_positionWorldOnB, &p.m_normalWorldOnB,
                  &p.m_lateralFrictionDir1, &p.m_lateralFrictionDir2})
    a((*v)[0], (*v)[1], (*v)[2]);
  a(p.m_distance1, p.m_combinedFriction, p.m_combinedRollingFriction, p.m_combinedSpinningFriction,
    p.m_combinedRestitution, p.m_partId0, p.m_partId1, p.m_index0, p.m_index1, p.m_contactPointFlags,
    p.m_appliedImpulse, p.m_prevRHS, p.m_appliedImpulseLateral1, p.m_appliedImpulseLateral2, p.m_contactMotion1,
    p.m_contactMotion2, p.m_contactCFM, p.m_contactERP, p.m_frictionCFM, p.m_lifeTime);
}

// Of a manifold in which there is a point. All triangles of the ground are one part.
std::array<int, 6> key_of(const btPersistentManifold& manifold) {
  const btManifoldPoint& point = manifold.getContactPoint(0);
  const int first = manifold.getBody0()->getUserIndex(), second = manifold.getBody1()->getUserIndex();
  std::array<int, 6> key{first, second, point.m_partId0, point.m_index0, point.m_partId1, point.m_index1};
  if (first == Touches::kGround) key[2] = key[3] = 0;
  if (second == Touches::kGround) key[4] = key[5] = 0;
  return key;
}

// The points of the step before, with those of this step in their place where they are the same, as far as they still
// hold: what Bullet does with a memory of its own.
void merge(const Touch& before, btPersistentManifold& manifold) {
  std::array<btManifoldPoint, MANIFOLD_CACHE_SIZE> found;
  const int count = manifold.getNumContacts();
  for (int k = 0; k < count; ++k) found[static_cast<std::size_t>(k)] = manifold.getContactPoint(k);
  manifold.clearManifold();
  for (std::uint8_t k = 0; k < before.count; ++k) manifold.addManifoldPoint(before.points[k]);
  for (int k = 0; k < count; ++k) {
    const btManifoldPoint& point = found[static_cast<std::size_t>(k)];
    if (const int same = manifold.getCacheEntry(point); same >= 0)
      manifold.replaceContactPoint(point, same);
    else
      manifold.addManifoldPoint(point);
  }
  manifold.refreshContactPoints(manifold.getBody0()->getWorldTransform(), manifold.getBody1()->getWorldTransform());
}

}  // namespace

template <class Archive, core::Is<Touch> T>
void archive(Archive& a, T& touch) {
  a(touch.key, touch.breaking, touch.processing, touch.count);
  if constexpr (Archive::kReads)
    if (touch.count == 0 || touch.count > touch.points.size()) a.fail(), touch.count = 0;
  for (std::uint8_t k = 0; k < touch.count; ++k) archive_point(a, touch.points[k]);
}

void Touches::clear(btDispatcher& dispatcher) {
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) dispatcher.getManifoldByIndexInternal(k)->clearManifold();
}

const btRigidBody* Touches::body(int index) const {
  return index == kGround ? ground_ : bodies_[static_cast<std::size_t>(index)];
}

// Is the ground's triangle met from the side it faces? Its edges are met from all sides, but up is not for it to push,
// and a body that has sunk beside the top of a wall is behind it.
bool Touches::is_faced(const btPersistentManifold& manifold, const btManifoldPoint& point) const {
  constexpr double kLeast = 0.5, kUp = 0.2;
  const bool first = manifold.getBody0() == ground_;
  const btVector3 outward = first ? -point.m_normalWorldOnB : point.m_normalWorldOnB;
  const int triangle = first ? point.m_index0 : point.m_index1;
  return outward.dot(normals_[static_cast<std::size_t>(triangle)]) > kLeast && outward.z() < kUp;
}

void Touches::drop_unfaced(btPersistentManifold& manifold) const {
  if (ground_ == nullptr || (manifold.getBody0() != ground_ && manifold.getBody1() != ground_)) return;
  for (int k = manifold.getNumContacts(); k-- > 0;)
    if (!is_faced(manifold, manifold.getContactPoint(k))) manifold.removeContactPoint(k);
}

btPersistentManifold& Touches::next_own(const Touch& touch) {
  if (own_used_ == own_.size()) own_.push_back(std::make_unique<btPersistentManifold>());
  btPersistentManifold& own = *own_[own_used_++];
  own.setBodies(body(touch.key[0]), body(touch.key[1]));
  own.setContactBreakingThreshold(touch.breaking);
  own.setContactProcessingThreshold(touch.processing);
  own.clearManifold();
  return own;
}

std::span<btPersistentManifold*> Touches::recall(btPersistentManifold** found, int count) {
  const auto key = [](const btPersistentManifold* manifold) { return key_of(*manifold); };
  found_.assign(found, found + count);
  for (btPersistentManifold* manifold : found_) drop_unfaced(*manifold);
  std::erase_if(found_, [](const btPersistentManifold* m) { return m->getNumContacts() == 0; });
  std::ranges::sort(found_, {}, key);
  now_.clear(), own_used_ = 0;
  auto next = found_.begin();
  for (const Touch& touch : touches_) {
    for (; next != found_.end() && key(*next) < touch.key; ++next) now_.push_back(*next);
    const bool found_again = next != found_.end() && key(*next) == touch.key;
    btPersistentManifold& manifold = found_again ? **next++ : next_own(touch);
    merge(touch, manifold);
    if (manifold.getNumContacts() > 0) now_.push_back(&manifold);
  }
  now_.insert(now_.end(), next, found_.end());
  return now_;
}

void Touches::remember() {
  touches_.clear();
  for (const btPersistentManifold* manifold : now_) {
    Touch& touch = touches_.emplace_back();
    touch.key = key_of(*manifold);
    touch.breaking = manifold->getContactBreakingThreshold();
    touch.processing = manifold->getContactProcessingThreshold();
    touch.count = static_cast<std::uint8_t>(manifold->getNumContacts());
    for (std::uint8_t point = 0; point < touch.count; ++point) touch.points[point] = manifold->getContactPoint(point);
  }
}

std::string Touches::save() const {
  core::ByteWriter writer;
  writer(touches_);
  return writer.take();
}

bool Touches::restore(std::string_view bytes) {
  core::ByteReader reader(bytes);
  reader(touches_);
  const auto is_body = [&](int index) {
    return index == kGround ? ground_ != nullptr : index >= 0 && static_cast<std::size_t>(index) < bodies_.size();
  };
  const auto is_between_bodies = [&](const Touch& t) { return is_body(t.key[0]) && is_body(t.key[1]); };
  const bool good = reader.ok() && reader.at_end() && std::ranges::is_sorted(touches_, {}, &Touch::key) &&
                    std::ranges::all_of(touches_, is_between_bodies);
  if (!good) touches_.clear();
  return good;
}

}  // namespace divot::contact
