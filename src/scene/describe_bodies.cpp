#include "scene/bounds.h"
#include "scene/describe.h"

namespace divot::scene {
namespace {

constexpr const char* kJointTypes[] = {"hinge", "slider", "fixed", "spring", "wheel"};

constexpr Key length_key(const char* name, const char* meaning) {
  return {.name = name, .unit = "m", .range = above(0, kLong), .meaning = meaning, .required = true};
}

constexpr Branch kSphere = {"sphere", {}, "sphere = { radius = 1.0 }"};
constexpr Branch kBox = {"box", {}, "box = { size = [2, 1, 1] }"};
constexpr Branch kCylinder = {"cylinder", {}, "cylinder = { radius = 0.4, length = 0.3 }"};
constexpr Branch kCapsule = {"capsule", {}, "capsule = { radius = 0.3, length = 1.0 }"};
constexpr Branch kCone = {"cone", {}, "cone = { radius = 0.3, height = 1.0 }"};
constexpr Branch kHull = {"hull", {}, "hull = { file = \"rock.obj\" }"};

// One of the convex shapes, by its place in ConvexShape and in Shape.
template <class Variant>
void describe_convex(Visitor& v, std::size_t index, Variant& shape) {
  if (index == 0) {
    v.table({.name = "sphere", .example = kSphere.example},
            [&] { v.number(length_key("radius", "of the ball"), as<Sphere>(shape).radius); });
  } else if (index == 1) {
    v.table({.name = "box", .example = kBox.example},
            [&] { v.vector(length_key("size", "whole lengths along the body's x, y, z"), as<Box>(shape).size); });
  } else if (index == 2) {
    v.table({.name = "cylinder", .example = kCylinder.example}, [&] {
      auto& cylinder = as<Cylinder>(shape);
      v.number(length_key("radius", "of a cylinder whose axis is the body's y, as a wheel's"), cylinder.radius);
      v.number(length_key("length", "along y"), cylinder.length);
    });
  } else if (index == 3) {
    v.table({.name = "capsule", .example = kCapsule.example}, [&] {
      auto& capsule = as<Capsule>(shape);
      v.number(length_key("radius", "of tube and ends"), capsule.radius);
      v.number(length_key("length", "between the centres of the ends, along y"), capsule.length);
    });
  } else if (index == 4) {
    v.table({.name = "cone", .example = kCone.example}, [&] {
      auto& cone = as<Cone>(shape);
      v.number(length_key("radius", "of the base; the tip points along z, the origin lies half-way up"), cone.radius);
      v.number(length_key("height", "along z"), cone.height);
    });
  } else if (index == 5) {
    v.table({.name = "hull", .example = kHull.example}, [&] {
      auto& hull = as<Hull>(shape);
      v.text({.name = "file",
              .meaning =
                  "OBJ, PLY, STL or glTF, whose convex hull is the shape; a relative path starts at the scene's folder",
              .default_text = "required"},
             hull.file);
      v.number({.name = "scale", .range = above(0, kLong), .meaning = "metres for a unit of the file"}, hull.scale);
    });
  }
}

void describe_part(Visitor& v, Part& part) {
  static constexpr Branch kShapes[] = {kSphere, kBox, kCylinder, kCapsule, kCone, kHull};
  for (const std::size_t index : v.branches(kShapes, part.shape.index())) describe_convex(v, index, part.shape);
  v.vector({.name = "position",
            .unit = "m",
            .range = between(-kLong, kLong),
            .meaning = "of the part's origin in the body's axes"},
           part.position);
  v.vector({.name = "rotation_deg",
            .unit = "degrees",
            .range = between(-3600, 3600),
            .meaning = "of the part about x, then y, then z of the body"},
           part.rotation_deg);
}

void describe_shape(Visitor& v, Shape& shape) {
  static constexpr Branch kShapes[] = {
      kSphere,
      kBox,
      kCylinder,
      kCapsule,
      kCone,
      kHull,
      {"compound", {}, "compound = [{ box = { size = [2, 1, 1] }, position = [0, 0, 1] }]"}};
  static constexpr const char* kMesh[] = {"mesh"};
  v.table({.name = "shape", .required = true, .example = "shape = { sphere = { radius = 1.0 } }"}, [&] {
    v.unsupported({kMesh, "hollow bodies are not supported",
                   "expected hull = { file = \"...\" }, the mesh's convex hull, "
                   "or a compound of several"});
    for (const std::size_t index : v.branches(kShapes, shape.index())) {
      if (index < 6) describe_convex(v, index, shape);
      if (index == 6)
        v.list({.name = "compound"}, as<Compound>(shape).parts, [&](Part& part) { describe_part(v, part); });
    }
  });
}

void describe_motion(Visitor& v, BodySettings& body) {
  v.vector({.name = "rotation_deg",
            .unit = "degrees",
            .range = between(-3600, 3600),
            .meaning = "at the start, about the fixed axes x, then y, then z"},
           body.rotation_deg);
  v.vector({.name = "velocity", .unit = "m/s", .range = between(-kFast, kFast), .meaning = "at the start"},
           body.velocity);
  v.vector({.name = "angular_velocity", .unit = "rad/s", .range = between(-kFast, kFast), .meaning = "at the start"},
           body.angular_velocity);
}

void describe_limits(Visitor& v, Joint& joint) {
  v.maybe_number({.name = "lower",
                  .unit = "m",
                  .range = between(-kLong, kLong),
                  .meaning = "least travel of `second` along `axis`; of a hinge, least angle in degrees"},
                 joint.lower);
  v.maybe_number({.name = "upper", .unit = "m", .range = between(-kLong, kLong), .meaning = "largest, likewise"},
                 joint.upper);
}

void describe_motor(Visitor& v, Joint& joint) {
  v.profile(
      {.name = "motor_speed",
       .unit = "rad/s",
       .range = between(-kFast, kFast),
       .meaning = "what the motor strives for, about a hinge's `axis` or a wheel's `axle`; m/s along a slider's or "
                  "spring's `axis`"},
      joint.motor_speed);
  v.profile({.name = "motor_force",
             .unit = "N m",
             .range = between(0, kHeavy),
             .meaning = "the most the motor gives, N along a slider's or spring's `axis`; 0: no motor"},
            joint.motor_force);
  v.profile({.name = "steering_deg",
             .unit = "degrees",
             .range = between(-60, 60),
             .meaning = "angle of a wheel about `axis`"},
            joint.steering_deg);
}

}  // namespace

void describe(Visitor& v, BodySettings& body) {
  v.text({.name = "name", .meaning = "unique; names the body in results", .default_text = "`body1`, `body2`, ..."},
         body.name);
  describe_shape(v, body.shape);
  v.number({.name = "mass", .unit = "kg", .range = above(0, kHeavy), .meaning = "of the body", .required = true},
           body.mass);
  v.place({.name = "position",
           .unit = "m",
           .range = between(-kFar, kFar),
           .meaning = "of its origin; two numbers put it on the ground at x, y",
           .required = true},
          {.name = "above_ground",
           .meaning = "position's z is the height of the lowest point above the ground there",
           .default_text = "`false`; `true` with two numbers"},
          body.position, body.above_ground);
  v.text(
      {.name = "assembly",
       .meaning = "bodies of one assembly that are `above_ground` keep their places to each other: position's z counts "
                  "within it, and it is put down where its first body touches",
       .default_text = "none"},
      body.assembly);
  describe_motion(v, body);
  v.maybe_vector({.name = "center_of_mass",
                  .unit = "m",
                  .range = between(-kLong, kLong),
                  .meaning = "in the body's own axes",
                  .default_text = "of the shape, uniformly filled"},
                 body.center_of_mass);
  v.maybe_vector({.name = "inertia",
                  .unit = "kg m^2",
                  .range = above(0, kHeavy * kHeavy),
                  .meaning = "about the body's own axes through its centre of mass",
                  .default_text = "of the shape, uniformly filled"},
                 body.inertia);
  v.number({.name = "restitution", .range = between(0, 1), .meaning = "multiplied by the material's"},
           body.restitution);
  v.number({.name = "friction", .range = between(0, 100), .meaning = "Coulomb's, with soil and with other bodies"},
           body.friction);
}

void describe(Visitor& v, Joint& joint) {
  v.text({.name = "name", .meaning = "names the joint for programs", .default_text = "none"}, joint.name);
  v.choice(
      {.name = "type",
       .meaning = "what the bodies may still do: turn about `axis`; move along it; nothing; move along it against a "
                  "spring; a wheel's suspension, which also spins about `axle`",
       .required = true},
      kJointTypes, joint.type);
  v.text({.name = "first",
          .meaning = "name of a body that holds the other; left out: the terrain",
          .default_text = "the terrain"},
         joint.first);
  v.text({.name = "second", .meaning = "name of the body that is held", .required = true}, joint.second);
  v.vector({.name = "anchor",
            .unit = "m",
            .range = between(-kLong, kLong),
            .meaning = "from the position of `second`, in its axes"},
           joint.anchor);
  v.vector(
      {.name = "axis", .range = between(-kLong, kLong), .meaning = "of turning or travel, in the axes of `second`"},
      joint.axis);
  v.vector({.name = "axle", .range = between(-kLong, kLong), .meaning = "of a wheel's spin, likewise, across `axis`"},
           joint.axle);
  v.number(
      {.name = "stiffness", .unit = "N/m", .range = between(0, kHeavy), .meaning = "of a spring's or wheel's travel"},
      joint.stiffness);
  v.number({.name = "damping", .unit = "N s/m", .range = between(0, kHeavy), .meaning = "likewise"}, joint.damping);
  v.number({.name = "preload",
            .unit = "N",
            .range = between(-kHeavy, kHeavy),
            .meaning = "force of the spring at the start, along `axis` on `first`"},
           joint.preload);
  describe_limits(v, joint);
  describe_motor(v, joint);
  v.flag({.name = "collide", .meaning = "whether the two bodies still collide with each other"}, joint.collide);
}

}  // namespace divot::scene
