#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scene/check.h"
#include "scene/describe.h"
#include "scene/includes.h"
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
  const auto apply = [&](bool to_includes) {
    for (const Override& override : overrides) {
      if ((override.key.rfind("include", 0) == 0) != to_includes) continue;
      if (auto error = scene::apply_override(*document, override)) override_errors.push_back(std::move(*error));
    }
  };
  // What includes bring can be overridden like what the file says.
  apply(true);
  Errors errors = scene::expand_includes(*document, file);
  apply(false);

  Scene scene;
  const std::filesystem::path path(file);
  scene.name = path.stem().string();
  scene.folder = path.parent_path().string();
  scene::Reader reader(*document, file);
  scene::describe(reader, scene);
  reader.finish();
  name_bodies(scene.bodies);
  reader.add_located(check(scene));

  const Errors read = reader.take_errors();
  // Without what an include should have brought, the rest would be held against what it lacks.
  if (errors.empty()) errors = read;
  errors.insert(errors.end(), override_errors.begin(), override_errors.end());
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return scene;
}

Result<Scene> load_scene(const std::string& path, const std::vector<Override>& overrides) {
  const auto text = scene::read_scene_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_scene(*text, path, overrides);
}

}  // namespace divot
