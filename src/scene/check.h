#pragma once

#include <optional>

#include "scene/visitor.h"

namespace divot::scene {

/// What is wrong with a value at `path`; nothing when it is in the key's range.
std::optional<Error> out_of_range(const std::string& path, const Key& key, double value);
std::optional<Error> out_of_range(const std::string& path, const Key& key, std::int64_t value);
std::optional<Error> out_of_range(const std::string& path, const Key& key, const Vec3d& value);

std::optional<Error> profile_error(const std::string& path, const Key& key, const Profile& profile);

/// The key of an UpdatePolicy's steps.
inline constexpr Key kEvery = {.name = "every", .unit = "steps", .range = {.low = 1, .high = 1e9}};

/// What contradicts what in a scene whose keys are each in range.
Errors contradictions(const Scene& scene);

/// The same of one body, and of one joint between bodies of `scene`.
Errors contradictions(const BodySettings& body, const std::string& path);
Errors contradictions(const Joint& joint, const Scene& scene, const std::string& path);

/// The same of one material. `path` is the material's, empty for the names of the struct's own fields.
Errors contradictions(const Material& material, const std::string& path);

}  // namespace divot::scene
