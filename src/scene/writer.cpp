#include "scene/writer.h"

namespace divot::scene {

void Writer::place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) {
  vector(position, value);
  put(above_ground, above);
}

void Writer::profile(const Key& key, Profile& value) {
  if (value.points.size() == 1) return put(key, value.points[0].second);
  toml::array points;
  for (const auto& [time, at] : value.points) points.push_back(toml::array{time, at});
  put(key, std::move(points));
}

void Writer::options(const Key& key, Names, std::vector<std::string>& values) {
  toml::array list;
  for (const std::string& value : values) list.push_back(value);
  put(key, std::move(list));
}

void Writer::legend(const Key& key, std::vector<LegendEntry>& entries) {
  toml::table table;
  for (const LegendEntry& entry : entries) table.insert_or_assign(entry.text(), entry.material);
  put(key, std::move(table));
}

void Writer::policy(const Key& key, UpdatePolicy& value) {
  if (value.kind == UpdatePolicy::Kind::every) return put(key, toml::table{{"every", value.steps}});
  put(key, value.kind == UpdatePolicy::Kind::adaptive ? "adaptive" : "every_step");
}

std::size_t Writer::list_size(const Key& key, std::size_t count) {
  if (count > 0) put(key, toml::array{});
  return count;
}

void Writer::enter_table(const Key& key, const std::string& path) {
  put(key, toml::table{});
  tables_.push_back((*tables_.back())[key.name].as_table());
  push(path);
}

void Writer::enter_item(const Key& key, std::size_t, const std::string& path) {
  toml::array& list = *(*tables_.back())[key.name].as_array();
  list.push_back(toml::table{});
  tables_.push_back(list.back().as_table());
  push(path);
}

void Writer::leave_table() {
  tables_.pop_back();
  pop();
}

}  // namespace divot::scene
