#include "viewer/camera_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace divot::viewer {
namespace {

constexpr double kTurn = std::numbers::pi;         // rad for a drag over the window's height
constexpr double kLowest = -0.3, kHighest = 1.55;  // rad; straight down would have no up
constexpr double kNotch = 7.0 / 6;
constexpr double kNearest = 0.01;  // m

}  // namespace

CameraControl::CameraControl(const Camera& start) : target_(start.target), fov_deg_(start.fov_deg) {
  const Vec3d out = start.eye - start.target;
  distance_ = length(out);
  azimuth_ = std::atan2(out.y, out.x);
  elevation_ = std::asin(std::clamp(out.z / distance_, -1.0, 1.0));
}

Vec3d CameraControl::back() const {
  return {std::cos(azimuth_) * std::cos(elevation_), std::sin(azimuth_) * std::cos(elevation_), std::sin(elevation_)};
}

void CameraControl::orbit(double right, double up) {
  azimuth_ -= right * kTurn;
  elevation_ = std::clamp(elevation_ - up * kTurn, kLowest, kHighest);
}

void CameraControl::pan(double right, double up) {
  const Vec3d side = {-std::sin(azimuth_), std::cos(azimuth_), 0}, above = cross(back(), side);
  const double height = 2 * distance_ * std::tan(fov_deg_ * std::numbers::pi / 360);  // m that the window shows
  target_ -= (side * right + above * up) * height;
}

void CameraControl::zoom(double notches) { distance_ = std::max(distance_ / std::pow(kNotch, notches), kNearest); }

void CameraControl::shift(const Vec3d& by) { target_ += by; }

void CameraControl::keep_above(double ground, double clearance) {
  const double missing = ground + clearance - camera().eye.z;
  if (missing > 0) target_.z += missing;
}

Camera CameraControl::camera() const {
  return {.eye = target_ + back() * distance_, .target = target_, .fov_deg = fov_deg_};
}

}  // namespace divot::viewer
