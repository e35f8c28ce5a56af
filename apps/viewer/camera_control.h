#pragma once

#include "viewer/camera.h"

namespace divot::viewer {

/// A camera that a hand on a mouse moves around a point.
class CameraControl {
 public:
  CameraControl() = default;
  explicit CameraControl(const Camera& start);

  /// `right`, `up`: how far the mouse went, in heights of the window.
  void orbit(double right, double up);

  /// What was under the mouse stays under it.
  void pan(double right, double up);

  /// Closer by a seventh for each `notch`, farther where it is negative.
  void zoom(double notches);

  /// Moves eye and target.
  void shift(const Vec3d& by);

  /// The eye stays `clearance` m above `ground`, its height below the eye, m; NaN: there is none.
  void keep_above(double ground, double clearance);

  Camera camera() const;
  double distance() const { return distance_; }

 private:
  Vec3d back() const;  // unit, from the target to the eye

  Vec3d target_;
  double distance_ = 1;     // m
  double azimuth_ = 0;      // rad
  double elevation_ = 0.5;  // rad
  double fov_deg_ = 32;
};

}  // namespace divot::viewer
