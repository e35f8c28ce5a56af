#include "viewer/explosion_node.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

constexpr double kGravity = 9.81;  // m/s^2: dust takes as long as soil would need to fall
constexpr double kReach = 3.565;   // m, half the width of the crater of 1 t (eq. 10)
constexpr double kLife = 5.0;      // of the dust, in fall times
constexpr std::uint32_t kFineDust = 56, kFastDust = 32, kClods = 36;
const osg::Vec3 kFire(1.0f, 0.62f, 0.22f), kSmoke(0.40f, 0.34f, 0.28f), kPale(0.66f, 0.60f, 0.52f);
const osg::Vec3 kClod(0.16f, 0.11f, 0.08f), kGlare(1.0f, 0.93f, 0.75f);

// A number in [0, 1) that belongs to particle `i` of an explosion and nothing else.
float chance(std::uint32_t seed, std::uint32_t i, std::uint32_t use) {
  std::uint32_t h = seed * 0x9e3779b9u + i * 0x85ebca6bu + use * 0xc2b2ae35u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / 16777216.0f;
}

float mix(float a, float b, float t) { return a + (b - a) * t; }
osg::Vec3 mix(const osg::Vec3& a, const osg::Vec3& b, float t) { return a + (b - a) * t; }

osg::Vec4 premultiplied(const osg::Vec3& color, float opacity) { return {color * opacity, opacity}; }

osg::Vec3 around(float turn) {
  const float angle = 2 * std::numbers::pi_v<float> * turn;
  return {std::cos(angle), std::sin(angle), 0};
}

}  // namespace

ExplosionNode::ExplosionNode()
    : puffs_(new osg::Geometry),
      centers_(new osg::Vec3Array),
      corners_(new osg::Vec3Array),
      tints_(new osg::Vec4Array),
      drawn_(new osg::DrawArrays(GL_QUADS, 0, 0)) {
  puffs_->setDataVariance(osg::Object::DYNAMIC);
  puffs_->setUseDisplayList(false);
  puffs_->setUseVertexBufferObjects(true);
  puffs_->setVertexArray(centers_);
  puffs_->setTexCoordArray(0, corners_, osg::Array::BIND_PER_VERTEX);
  puffs_->setColorArray(tints_, osg::Array::BIND_PER_VERTEX);
  puffs_->addPrimitiveSet(drawn_);
  // Bounds know the centres only.
  puffs_->setCullingActive(false);
  osg::StateSet* state = puffs_->getOrCreateStateSet();
  state->setAttributeAndModes(puff_program());
  state->setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, false));
  state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

void ExplosionNode::update(const Vec3d& origin, std::span<const BombView> bombs, double time, const osg::Vec3d& eye,
                           Quality quality) {
  const bool nothing_before = list_.empty();
  list_.clear();
  dust_ = quality == Quality::fast ? kFastDust : kFineDust;
  for (std::size_t i = 0; i < bombs.size(); ++i) {
    if (!bombs[i].exploded) continue;
    const Vec3d p = bombs[i].position - origin;
    add_explosion(osg::Vec3d(p.x, p.y, p.z), bombs[i].yield, time - bombs[i].time, static_cast<std::uint32_t>(i));
  }
  if (nothing_before && list_.empty()) return;
  const osg::Vec3 from(eye);
  for (Puff& puff : list_) puff.distance2 = (puff.center - from).length2();
  std::stable_sort(list_.begin(), list_.end(), [](const Puff& a, const Puff& b) { return a.distance2 > b.distance2; });
  fill_arrays();
}

void ExplosionNode::add_explosion(const osg::Vec3& at, double yield, double age, std::uint32_t seed) {
  const double reach = kReach * std::cbrt(yield), fall_time = std::sqrt(2 * reach / kGravity);
  if (age < 0 || age > kLife * fall_time) return;
  add_clods(at, static_cast<float>(reach), age, seed);
  add_dust(at, static_cast<float>(reach), static_cast<float>(age / fall_time), seed);
  add_flash(at, static_cast<float>(reach), static_cast<float>(age / fall_time));
}

void ExplosionNode::add_flash(const osg::Vec3& at, float reach, float age) {
  const float glow = std::exp(-age / 0.05f);
  if (glow < 0.01f) return;
  // Opacity 0: it only adds light.
  list_.push_back({at + osg::Vec3(0, 0, 0.3f * reach), reach * mix(3.0f, 1.6f, glow), {kGlare * glow, 0}, 0});
}

// A stem that rises and slows down, and a ring that runs outward along the ground.
void ExplosionNode::add_dust(const osg::Vec3& at, float reach, float age, std::uint32_t seed) {
  const float spread = 1 - std::exp(-age / 0.25f), left = 1 - age / static_cast<float>(kLife);
  for (std::uint32_t i = 0; i < dust_; ++i) {
    const bool stem = i % 5 < 3;
    const float size = mix(0.7f, 1.3f, chance(seed, i, 0)), high = chance(seed, i, 1), out = chance(seed, i, 2);
    const float up = stem ? mix(0.2f, 1.9f, high) : mix(0.08f, 0.3f, high);
    const float away = stem ? mix(0.05f, 0.3f, out) + 0.5f * high * high * out : mix(0.7f, 1.5f, out);
    const osg::Vec3 place = around(chance(seed, i, 3)) * (away * spread) + osg::Vec3(0, 0, up * spread + 0.04f * age);
    const float opacity = (stem ? 0.9f : 0.8f) * std::min(age / 0.05f, 1.0f) * left * left;
    const osg::Vec3 dust = mix(kSmoke, kPale, mix(0.7f * high, 1.0f, std::min(0.25f * age, 0.6f)));
    const osg::Vec3 color = mix(kFire, dust, std::clamp(age / (stem ? 0.35f : 0.12f), 0.0f, 1.0f));
    const float radius = size * (stem ? 0.20f + 0.32f * spread : 0.14f + 0.26f * spread) + 0.03f * age;
    list_.push_back({at + place * reach, radius * reach, premultiplied(color, opacity), 0});
  }
}

// Ballistic, until they are back on the ground.
void ExplosionNode::add_clods(const osg::Vec3& at, float reach, double seconds, std::uint32_t seed) {
  const auto t = static_cast<float>(seconds), gravity = static_cast<float>(kGravity);
  for (std::uint32_t i = 0; i < kClods; ++i) {
    const float rise = std::sqrt(2 * gravity * reach * mix(0.3f, 1.5f, chance(seed, i, 4)));
    const float out = mix(0.6f, 2.6f, chance(seed, i, 5)) * reach * gravity / (2 * rise);
    const float height = rise * t - gravity * t * t / 2;
    if (height < 0) continue;
    const osg::Vec3 place = around(chance(seed, i, 6)) * (out * t) + osg::Vec3(0, 0, height);
    list_.push_back({at + place, reach * mix(0.02f, 0.05f, chance(seed, i, 7)), premultiplied(kClod, 1), 0});
  }
}

void ExplosionNode::fill_arrays() {
  centers_->clear();
  corners_->clear();
  tints_->clear();
  for (const Puff& puff : list_) {
    for (const auto& [x, y] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
      centers_->push_back(puff.center);
      corners_->push_back(osg::Vec3(x, y, puff.radius));
      tints_->push_back(puff.tint);
    }
  }
  for (osg::Array* array :
       {static_cast<osg::Array*>(centers_), static_cast<osg::Array*>(corners_), static_cast<osg::Array*>(tints_)}) {
    array->dirty();
  }
  drawn_->setCount(static_cast<GLsizei>(centers_->size()));
  drawn_->dirty();
  puffs_->dirtyBound();
}

}  // namespace divot::viewer
