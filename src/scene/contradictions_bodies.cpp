#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/solid.h"
#include "scene/check.h"

namespace divot::scene {
namespace {

void note(Errors& errors, std::string key, std::string problem, std::string expected) {
  errors.push_back({{}, 0, std::move(key), std::move(problem), std::move(expected)});
}

void check_hull(const Hull& hull, const std::string& path, Errors& errors) {
  if (hull.file.empty() && hull.points.empty())
    note(errors, path + ".file", "is missing", "expected the name of an OBJ, PLY, STL or glTF file");
}

void check_shape(const Shape& shape, const std::string& path, Errors& errors) {
  if (const auto* hull = std::get_if<Hull>(&shape)) check_hull(*hull, path + ".hull", errors);
  const auto* compound = std::get_if<Compound>(&shape);
  if (compound == nullptr) return;
  if (compound->parts.empty()) note(errors, path + ".compound", "has no parts", "expected at least one");
  for (std::size_t i = 0; i < compound->parts.size(); ++i)
    if (const auto* hull = std::get_if<Hull>(&compound->parts[i].shape))
      check_hull(*hull, fmt::format("{}.compound[{}].hull", path, i), errors);
}

// A body cannot be such that one principal moment exceeds the sum of the two others.
void check_inertia(const BodySettings& body, const std::string& path, Errors& errors) {
  if (!body.inertia) return;
  const Vec3d i = *body.inertia;
  const double most = std::max({i.x, i.y, i.z});
  if (most > (i.x + i.y + i.z - most) * (1 + 1e-9))
    note(errors, path + ".inertia", fmt::format("{} exceeds the sum of the two others", number_text(most)),
         "expected each at most the sum of the others");
}

void check_name(const Scene& scene, const std::string& name, const std::string& path, Errors& errors) {
  std::vector<std::string> known;
  for (const BodySettings& body : scene.bodies) {
    if (body.name == name) return;
    if (!body.name.empty()) known.push_back(body.name);
  }
  note(errors, path, fmt::format("there is no body \"{}\"", name),
       known.empty() ? "expected a body's name" : "expected " + one_of(known));
}

void check_axes(const Joint& joint, const std::string& path, Errors& errors) {
  if (!(length(joint.axis) > 0)) note(errors, path + ".axis", "has no direction", "expected a vector that is not 0");
  if (joint.type != JointType::wheel) return;
  const double across = length(cross(joint.axis, joint.axle));
  if (!(across > 0.1 * length(joint.axis) * length(joint.axle)) || !(length(joint.axle) > 0))
    note(errors, path + ".axle", "does not point across axis", "expected a vector at a right angle to axis");
}

// Keys that a type of joint would leave without meaning.
void check_keys(const Joint& joint, const std::string& path, Errors& errors) {
  const bool springs = joint.type == JointType::spring || joint.type == JointType::wheel;
  const auto only = [&](bool used, const char* key, const char* types) {
    if (used)
      note(errors, path + "." + key, "means nothing for this type", fmt::format("expected it only with {}", types));
  };
  const auto set = [](const Profile& p) {
    return std::any_of(p.points.begin(), p.points.end(), [](const auto& point) { return point.second != 0; });
  };
  only(!springs && joint.stiffness != 0, "stiffness", "spring or wheel");
  only(!springs && joint.damping != 0, "damping", "spring or wheel");
  only(!springs && joint.preload != 0, "preload", "spring or wheel");
  only(joint.type == JointType::fixed && joint.lower.has_value(), "lower", "other types");
  only(joint.type == JointType::fixed && joint.upper.has_value(), "upper", "other types");
  only(joint.type == JointType::fixed && set(joint.motor_force), "motor_force", "other types");
  only(joint.type != JointType::wheel && set(joint.steering_deg), "steering_deg", "wheel");
  if (springs && joint.stiffness == 0)
    note(errors, path + ".stiffness", "0 is no spring", "expected a number > 0 (N/m), or type = \"slider\"");
  if (joint.lower && joint.upper && *joint.lower > *joint.upper)
    note(errors, path + ".lower", "exceeds upper", fmt::format("expected at most {}", number_text(*joint.upper)));
}

}  // namespace

Errors contradictions(const BodySettings& body, const std::string& path) {
  Errors errors;
  check_shape(body.shape, path + ".shape", errors);
  check_inertia(body, path, errors);
  return errors;
}

Errors contradictions(const Joint& joint, const Scene& scene, const std::string& path) {
  Errors errors;
  if (!joint.first.empty()) check_name(scene, joint.first, path + ".first", errors);
  check_name(scene, joint.second, path + ".second", errors);
  if (joint.first == joint.second && !joint.first.empty())
    note(errors, path + ".second", "is the same body as first", "expected another one");
  check_axes(joint, path, errors);
  check_keys(joint, path, errors);
  return errors;
}

}  // namespace divot::scene
