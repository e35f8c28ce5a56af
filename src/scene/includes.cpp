#include "scene/includes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "scene/bounds.h"

namespace divot::scene {
namespace {

namespace fs = std::filesystem;

// What a file must hold to be of use to another.
constexpr const char* kLists[] = {"bodies", "joints", "bombs"};
constexpr const char* kMaterials = "materials";

bool mergeable(std::string_view key) {
  return key == kMaterials ||
         std::any_of(std::begin(kLists), std::end(kLists), [&](const char* k) { return key == k; });
}

double number_of(const toml::node& node) {
  if (const auto* i = node.as_integer()) return static_cast<double>(i->get());
  const auto* f = node.as_floating_point();
  return f != nullptr ? f->get() : 0;
}

/// An array of two or three numbers, or null: what is wrong with it the reader will say.
toml::array* numbers(toml::table& table, const char* key) {
  toml::array* list = table.get_as<toml::array>(key);
  if (list == nullptr || (list->size() != 2 && list->size() != 3)) return nullptr;
  for (const toml::node& node : *list)
    if (!node.is_number()) return nullptr;
  return list;
}

// Turned about z by the include's heading, then moved by `shift`.
void place(toml::table& table, const char* key, double heading, const Vec3d& shift) {
  toml::array* list = numbers(table, key);
  if (list == nullptr) return;
  const double c = std::cos(heading), s = std::sin(heading);
  const double x = number_of((*list)[0]), y = number_of((*list)[1]);
  const double z = list->size() == 3 ? number_of((*list)[2]) : 0;
  const double moved[3] = {c * x - s * y + shift.x, s * x + c * y + shift.y, z + shift.z};
  for (std::size_t i = 0; i < list->size(); ++i)
    list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(i), moved[i]);
}

void prefix(toml::table& table, const char* key, const std::string& name) {
  if (name.empty()) return;
  if (auto* text = table.get_as<std::string>(key); text != nullptr && !text->get().empty())
    text->get() = name + "/" + text->get();
}

// Files of hulls count from the folder of the file that names them.
void rebase_hulls(toml::table& shape, const fs::path& folder) {
  if (toml::table* hull = shape.get_as<toml::table>("hull"))
    if (auto* file = hull->get_as<std::string>("file"); file != nullptr && fs::path(file->get()).is_relative())
      file->get() = (folder / file->get()).string();
  if (toml::array* parts = shape.get_as<toml::array>("compound"))
    for (toml::node& part : *parts)
      if (toml::table* table = part.as_table()) rebase_hulls(*table, folder);
}

void place_body(toml::table& body, const Include& include, const fs::path& folder, std::size_t index) {
  const double heading = include.heading_deg * std::numbers::pi / 180;
  const Vec3d shift{include.position.x, include.position.y, include.on_ground ? 0 : include.position.z};
  place(body, "position", heading, shift);
  place(body, "velocity", heading, {});
  place(body, "angular_velocity", heading, {});
  if (heading != 0) {
    if (toml::array* turn = numbers(body, "rotation_deg"); turn != nullptr && turn->size() == 3)
      turn->replace(turn->cbegin() + 2, number_of((*turn)[2]) + include.heading_deg);
    else if (!body.contains("rotation_deg"))
      body.insert("rotation_deg", toml::array{0.0, 0.0, include.heading_deg});
  }
  if (body.contains("assembly"))
    prefix(body, "assembly", include.name);
  else if (include.on_ground)
    body.insert("assembly", include.name.empty() ? fmt::format("{}#{}", include.file, index) : include.name);
  if (include.on_ground) body.insert_or_assign("above_ground", true);
  prefix(body, "name", include.name);
  if (toml::table* shape = body.get_as<toml::table>("shape")) rebase_hulls(*shape, folder);
}

void place_bomb(toml::table& bomb, const Include& include) {
  const double heading = include.heading_deg * std::numbers::pi / 180;
  place(bomb, "position", heading,
        {include.position.x, include.position.y, include.on_ground ? 0 : include.position.z});
  if (include.on_ground) bomb.insert_or_assign("above_ground", true);
}

// Moves the elements of a list, and so keeps where they come from.
void append(toml::table& to, const char* key, toml::node& from) {
  toml::array* source = from.as_array();
  if (source == nullptr || source->empty()) return;
  if (!to.contains(key)) {
    to.insert(key, std::move(*source));
  } else if (toml::array* list = to.get_as<toml::array>(key)) {
    for (toml::node& item : *source) item.visit([&](auto& value) { list->push_back(std::move(value)); });
  }
}

// Materials of the including file win.
void merge_materials(toml::table& to, toml::node& from) {
  toml::table* source = from.as_table();
  if (source == nullptr) return;
  if (!to.contains(kMaterials)) {
    to.insert(kMaterials, std::move(*source));
  } else if (toml::table* table = to.get_as<toml::table>(kMaterials)) {
    for (auto&& [key, value] : *source)
      if (!table->contains(key)) value.visit([&, &key = key](auto& node) { table->insert(key, std::move(node)); });
  }
}

Error at(const toml::node& node, const std::string& file, std::string key, std::string problem, std::string expected) {
  const toml::source_region& where = node.source();
  return {where.path ? *where.path : file, static_cast<int>(where.begin.line), std::move(key), std::move(problem),
          std::move(expected)};
}

Errors merge(toml::table& document, toml::table& part, const Include& include, const std::string& path,
             std::size_t index) {
  Errors errors;
  for (auto&& [key, value] : part) {
    if (mergeable(key.str())) continue;
    errors.push_back(at(value, path, std::string(key.str()), "means nothing in a file that another includes",
                        "expected bodies, joints, bombs, materials or include"));
  }
  const fs::path folder = fs::path(include.file).parent_path();
  const auto each = [&](const char* key, auto work) {
    if (toml::array* list = part.get_as<toml::array>(key))
      for (toml::node& item : *list)
        if (toml::table* table = item.as_table()) work(*table);
  };
  each("bodies", [&](toml::table& body) { place_body(body, include, folder, index); });
  each("bombs", [&](toml::table& bomb) { place_bomb(bomb, include); });
  each("joints", [&](toml::table& joint) {
    for (const char* key : {"name", "first", "second"}) prefix(joint, key, include.name);
  });
  for (const char* key : kLists)
    if (toml::node* list = part.get(key)) append(document, key, *list);
  if (toml::node* materials = part.get(kMaterials)) merge_materials(document, *materials);
  return errors;
}

// include = ["a.toml"] is short for include = [{ file = "a.toml" }].
void spell_out(toml::table& document) {
  toml::array* list = document.get_as<toml::array>("include");
  if (list == nullptr) return;
  for (std::size_t i = 0; i < list->size(); ++i) {
    auto* text = (*list)[i].as_string();
    if (text == nullptr) continue;
    toml::table table;
    table.insert("file", std::move(*text));
    list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(i), std::move(table));
  }
}

}  // namespace

void describe(Visitor& v, std::vector<Include>& includes) {
  v.list({.name = "include"}, includes, [&](Include& include) {
    v.text(
        {.name = "file",
         .meaning = "scene file whose bodies, joints, bombs and materials join this one's; a relative path starts at "
                    "the folder of the file that includes it",
         .required = true},
        include.file);
    v.text({.name = "name",
            .meaning = "put before its bodies' and joints' names, as `truck/chassis`",
            .default_text = "none"},
           include.name);
    v.place({.name = "position",
             .unit = "m",
             .range = between(-kFar, kFar),
             .meaning = "where its origin comes to lie; two numbers put it on the ground as one assembly"},
            {.name = "on_ground",
             .meaning = "its bodies stand on the ground at x, y",
             .default_text = "`false`; `true` with two numbers"},
            include.position, include.on_ground);
    v.number({.name = "heading_deg",
              .unit = "degrees",
              .range = between(-3600, 3600),
              .meaning = "it is turned by this about z, counter-clockwise from above"},
             include.heading_deg);
  });
}

Result<std::string> read_scene_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return fail({path, 0, {}, "is a folder", "expected a scene file"});
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad())
    return fail({path, 0, {}, fmt::format("cannot be read: {}", std::strerror(errno)), "expected a scene file"});
  return text.str();
}

Errors expand_includes(toml::table& document, const std::string& file, std::vector<std::string> chain) {
  if (!document.contains("include")) return {};
  std::error_code ignored;
  chain.push_back(fs::weakly_canonical(file, ignored).string());
  spell_out(document);
  std::vector<Include> includes;
  Errors errors;
  {
    Reader reader(document, file);
    describe(reader, includes);
    errors = reader.take_errors();
  }
  if (errors.empty()) {
    const fs::path folder = fs::path(file).parent_path();
    for (std::size_t i = 0; i < includes.size(); ++i) {
      const toml::node& node = *document["include"][i]["file"].node();
      const std::string key = fmt::format("include[{}].file", i);
      const std::string path =
          fs::path(includes[i].file).is_absolute() ? includes[i].file : (folder / includes[i].file).string();
      if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(path, ignored).string()) != chain.end()) {
        errors.push_back(
            at(node, file, key, fmt::format("\"{}\" includes itself", includes[i].file), "expected no circle"));
        continue;
      }
      const auto text = read_scene_file(path);
      if (!text) {
        errors.push_back(at(node, file, key, fmt::format("\"{}\" {}", includes[i].file, text.error().front().problem),
                            "expected a scene file"));
        continue;
      }
      auto part = parse_toml(*text, path);
      if (!part) {
        errors.push_back(part.error().front());
        continue;
      }
      const auto append_errors = [&](Errors more) { errors.insert(errors.end(), more.begin(), more.end()); };
      append_errors(expand_includes(*part, path, chain));
      append_errors(merge(document, *part, includes[i], path, i));
    }
  }
  document.erase("include");
  return errors;
}

}  // namespace divot::scene
