#include "viewer/lighting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <osg/PolygonOffset>
#include <string>
#include <vector>

#include "viewer/body_node.h"
#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

constexpr int kFineShadow = 3072, kFastShadow = 1024;  // texels along a side
constexpr std::size_t kFastOccluders = 6;              // each costs a little in every pixel of the ground
constexpr unsigned kShadowUnit = 1;                    // texture unit; captions use 0
constexpr double kHazeReach = 2.6;  // haze hides 63 % after so many times the distance at which it begins

// Linear colours: a low warm sun against a blue sky, and light thrown back by brown ground.
const osg::Vec3 kSunColor(2.90f, 2.50f, 1.95f);
const osg::Vec3 kSkyColor(0.50f, 0.60f, 0.78f);
const osg::Vec3 kBounceColor(0.26f, 0.21f, 0.16f);
const osg::Vec3 kHazeColor(0.62f, 0.72f, 0.86f);

osg::Vec3d direction_to(const Sun& sun) {
  const double azimuth = osg::DegreesToRadians(sun.azimuth_deg), elevation = osg::DegreesToRadians(sun.elevation_deg);
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

osg::ref_ptr<osg::Texture2D> make_shadow_map(int size) {
  const bool fast = size == kFastShadow;
  osg::ref_ptr<osg::Texture2D> map = new osg::Texture2D;
  map->setTextureSize(size, size);
  map->setInternalFormat(fast ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT24);
  map->setSourceFormat(GL_DEPTH_COMPONENT);
  map->setSourceType(fast ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT);
  map->setShadowComparison(true);
  map->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  map->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  // Beyond it nothing throws shadows.
  map->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_BORDER);
  map->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_BORDER);
  map->setBorderColor(osg::Vec4d(1, 1, 1, 1));
  return map;
}

osg::ref_ptr<osg::Camera> make_shadow_pass(osg::Texture2D& map, int size) {
  osg::ref_ptr<osg::Camera> pass = new osg::Camera;
  pass->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  pass->setRenderOrder(osg::Camera::PRE_RENDER);
  pass->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  pass->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  pass->setViewport(0, 0, size, size);
  pass->setClearMask(GL_DEPTH_BUFFER_BIT);
  pass->attach(osg::Camera::DEPTH_BUFFER, &map);
  osg::StateSet* state = pass->getOrCreateStateSet();
  constexpr auto kOverride = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
  state->setAttributeAndModes(depth_program(), kOverride);
  state->setAttributeAndModes(new osg::PolygonOffset(1.5f, 2.0f), kOverride);
  return pass;
}

// Lets the traversal through once for each renew().
struct Gate : osg::NodeCallback {
  bool open = true;
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    if (open) traverse(node, visitor);
    open = false;
  }
};

}  // namespace

Lighting::Lighting(const Sun& sun, Quality quality)
    : sun_direction_(direction_to(sun)),
      quality_(quality),
      shadow_size_(quality == Quality::fast ? kFastShadow : kFineShadow),
      shadow_root_(new osg::Group),
      shadow_map_(make_shadow_map(shadow_size_)),
      shadow_matrix_(new osg::Uniform(osg::Uniform::FLOAT_MAT4, "shadow_matrix")),
      shadow_texel_(new osg::Uniform("shadow_texel", 1.0f)),
      haze_range_(new osg::Uniform("haze_range", osg::Vec2(1, 1))),
      occluders_(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "occluders", kMaxOccluders)),
      occluder_count_(new osg::Uniform("occluder_count", 0)),
      ball_shadows_(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "ball_shadows", kMaxBallShadows)) {
  shadow_pass_ = make_shadow_pass(*shadow_map_, shadow_size_);
  shadow_root_->addChild(shadow_pass_);
  shadow_root_->setCullCallback(new Gate);
  set_focus({}, 1);
}

void Lighting::apply(osg::StateSet& state) {
  lit_.push_back(&state);
  state.setTextureAttributeAndModes(kShadowUnit, shadow_map_);
  state.addUniform(new osg::Uniform("shadow_map", static_cast<int>(kShadowUnit)));
  state.addUniform(new osg::Uniform("sun_direction", osg::Vec3(sun_direction_)));
  state.addUniform(new osg::Uniform("sun_color", kSunColor));
  state.addUniform(new osg::Uniform("sky_color", kSkyColor));
  state.addUniform(new osg::Uniform("bounce_color", kBounceColor));
  state.addUniform(new osg::Uniform("haze_color", kHazeColor));
  for (const auto& uniform : {shadow_matrix_, shadow_texel_, haze_range_, occluders_, occluder_count_, ball_shadows_}) {
    state.addUniform(uniform);
  }
}

void Lighting::set_focus(const osg::Vec3d& center, double radius) {
  // Seen from far towards the sun, so that hills outside the map still throw their shadows into it.
  const osg::Vec3d up = std::abs(sun_direction_.z()) > 0.99 ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1);
  const osg::Matrixd view = osg::Matrixd::lookAt(center + sun_direction_ * (4 * radius), center, up);
  const osg::Matrixd projection = osg::Matrixd::ortho(-radius, radius, -radius, radius, radius, 7 * radius);
  shadow_pass_->setViewMatrix(view);
  shadow_pass_->setProjectionMatrix(projection);
  shadow_space_ = view * projection * osg::Matrixd::translate(1, 1, 1) * osg::Matrixd::scale(0.5, 0.5, 0.5);
  shadow_radius_ = radius;
  shadow_matrix_->set(osg::Matrixf(shadow_space_));
  shadow_texel_->set(static_cast<float>(2 * radius / shadow_size_));
  renew_shadows();
}

void Lighting::renew_shadows() { dynamic_cast<Gate&>(*shadow_root_->getCullCallback()).open = true; }

void Lighting::set_haze(double distance) { haze_range_->set(osg::Vec2(osg::Vec2d(distance, kHazeReach * distance))); }

void Lighting::set_occluders(const Vec3d& origin, std::span<const BodyView> bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return ball_radius(bodies[i]) == 0; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ball_radius(bodies[a]) > ball_radius(bodies[b]); });
  order.resize(std::min<std::size_t>(order.size(), kMaxOccluders));
  set_ball_count(quality_ == Quality::fast ? std::min<std::size_t>(order.size(), kMaxBallShadows) : 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BodyView& body = bodies[order[i]];
    const Vec3d p = body.position - origin;
    const double radius = ball_radius(body);
    const auto index = static_cast<unsigned>(i);
    occluders_->setElement(index, osg::Vec4(osg::Vec4d(p.x, p.y, p.z, radius)));
    if (i >= ball_count_) continue;
    const osg::Vec3d place = osg::Vec3d(p.x, p.y, p.z) * shadow_space_;
    ball_shadows_->setElement(index, osg::Vec4(osg::Vec4d(place, 2 * shadow_radius_ / radius)));
  }
  occluder_count_->set(static_cast<int>(order.size()));
}

// A loop of known length is several times cheaper, so each number has a program of its own.
void Lighting::set_ball_count(std::size_t count) {
  if (count == ball_count_) return;
  ball_count_ = count;
  for (const auto& state : lit_) {
    state->removeDefine("BALLS");
    if (count > 0) state->setDefine("BALLS", std::to_string(count));
  }
}

}  // namespace divot::viewer
