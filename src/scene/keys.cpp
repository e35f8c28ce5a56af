#include "scene/keys.h"

#include <fmt/format.h>

#include "scene/describe.h"
#include "scene/includes.h"

namespace divot::scene {
namespace {

std::string vector_text(const Vec3d& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

std::string words(Names names) {
  std::string out;
  for (const char* name : names) out += fmt::format("{}`\"{}\"`", out.empty() ? "" : ", ", name);
  return out;
}

/// Writes down every key with the default that a new Scene has.
class Lister : public Visitor {
 public:
  std::vector<KeyInfo> keys;

  void number(const Key& key, double& value) override { add(key, "number", number_text(value, 6)); }
  void integer(const Key& key, std::int64_t& value) override { add(key, "integer", fmt::format("{}", value)); }
  void flag(const Key& key, bool& value) override { add(key, "true or false", value ? "true" : "false"); }
  void text(const Key& key, std::string& value) override { add(key, "text", '"' + value + '"'); }
  void vector(const Key& key, Vec3d& value) override { add(key, "3 numbers", vector_text(value)); }
  void place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) override {
    add(position, "2 or 3 numbers", vector_text(value));
    flag(above_ground, above);
  }
  void maybe_number(const Key& key, std::optional<double>&) override { add(key, "number", "none"); }
  void maybe_vector(const Key& key, std::optional<Vec3d>&) override { add(key, "3 numbers", "none"); }
  void profile(const Key& key, Profile& value) override {
    add(key, "number or list of [time, number]", number_text(value.points[0].second));
  }
  void option(const Key& key, Names names, std::size_t& index) override {
    add(key, "text", fmt::format("\"{}\"", names[index]));
    keys.back().range = words(names);
  }
  void options(const Key& key, Names names, std::vector<std::string>&) override {
    add(key, "list of text", "[]");
    keys.back().range = "of " + words(names);
  }
  void legend(const Key& key, std::vector<LegendEntry>&) override { add(key, "table of text", ""); }
  void policy(const Key& key, UpdatePolicy&) override {
    add(key, "text or table", "\"adaptive\"");
    keys.back().range = "`\"adaptive\"`, `\"every_step\"`, `{ every = 10 }` (steps, an integer >= 1)";
  }
  void base(const Key& key, Material&, std::span<const Material>) override { add(key, "text", ""); }

  std::vector<std::size_t> branches(std::span<const Branch> all, std::size_t) override {
    std::vector<std::size_t> out(all.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
    return out;
  }
  std::size_t list_size(const Key&, std::size_t) override { return 1; }
  std::vector<std::string> material_names(std::span<const Material>) override { return {"NAME"}; }

 protected:
  std::string item_text(std::size_t) const override { return {}; }

 private:
  void add(const Key& key, const std::string& type, const std::string& default_value) {
    KeyInfo info{path_to(key.name), type, key.range.text(), '`' + default_value + '`', key.meaning};
    if (key.unit[0] != '\0') info.type += fmt::format(", {}", key.unit);
    if (key.default_text != nullptr) info.default_value = key.default_text;
    if (key.required) info.default_value = "required";
    keys.push_back(std::move(info));
  }
};

}  // namespace

std::vector<KeyInfo> scene_keys() {
  Lister lister;
  Scene defaults;
  describe(lister, defaults);
  std::vector<Include> includes;
  describe(lister, includes);
  return std::move(lister.keys);
}

}  // namespace divot::scene
