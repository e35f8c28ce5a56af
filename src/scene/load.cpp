#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/check.h"
#include "scene/describe.h"
#include "scene/overrides.h"
#include "scene/reader.h"

namespace divot {
namespace {

/// Gives bodies without a name the first of body1, body2, ... from their own number on that is free.
void name_bodies(std::vector<BodySettings>& bodies) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const BodySettings& body) { return body.name == name; });
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t number = i + 1; bodies[i].name.empty(); ++number) {
      const std::string name = fmt::format("body{}", number);
      if (!taken(name)) bodies[i].name = name;
    }
  }
}

}  // namespace

Result<Scene> parse_scene(std::string_view text, const std::string& file, const std::vector<Override>& overrides) {
  auto document = scene::parse_toml(text, file);
  if (!document) return tl::unexpected(document.error());
  Errors override_errors;
  for (const Override& override : overrides) {
    if (auto error = scene::apply_override(*document, override)) override_errors.push_back(std::move(*error));
  }

  Scene scene;
  const std::filesystem::path path(file);
  scene.name = path.stem().string();
  scene.folder = path.parent_path().string();
  scene::Reader reader(*document, file);
  scene::describe(reader, scene);
  reader.finish();
  name_bodies(scene.bodies);
  reader.add_located(check(scene));

  Errors errors = reader.take_errors();
  errors.insert(errors.end(), override_errors.begin(), override_errors.end());
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return scene;
}

Result<Scene> load_scene(const std::string& path, const std::vector<Override>& overrides) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return fail({path, 0, {}, "is a folder", "expected a scene file"});
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad()) {
    return fail({path, 0, {}, fmt::format("cannot be read: {}", std::strerror(errno)), "expected a scene file"});
  }
  return parse_scene(text.str(), path, overrides);
}

}  // namespace divot
