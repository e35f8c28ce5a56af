#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "scene/keys.h"
#include "scene/nearest.h"
#include "scene/overrides.h"

namespace divot::scene {
namespace {

/// The path of a key with this name anywhere in the scene file, for keys written below the wrong header.
std::string elsewhere(std::string_view name) {
  for (const KeyInfo& key : scene_keys()) {
    const auto dot = key.path.rfind('.');
    if (dot != std::string::npos ? std::string_view(key.path).substr(dot + 1) == name : key.path == name) {
      return key.path;
    }
  }
  return {};
}

std::string table_expectation(const Key& key) {
  return key.example != nullptr ? fmt::format("expected {}", key.example) : "expected a table";
}

}  // namespace

Reader::Reader(const toml::table& document, std::string file) : file_(std::move(file)) {
  frames_.push_back({&document, {}, {}});
}

std::vector<std::size_t> Reader::branches(std::span<const Branch> all, std::size_t current) {
  Frame& frame = frames_.back();
  if (frame.table == nullptr) return {current};
  std::vector<std::size_t> present;
  std::vector<std::string> names, examples;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (peek(all[i].name) != nullptr) present.push_back(i);
    names.emplace_back(all[i].name);
    examples.emplace_back(all[i].example);
  }
  // What belongs to no branch that is there would otherwise be unknown.
  for (std::size_t i = 0; i < all.size(); ++i) {
    frame.known.push_back({all[i].name, {}});
    if (std::find(present.begin(), present.end(), i) != present.end()) continue;
    for (const char* companion : all[i].companions) {
      frame.known.push_back({companion, {}});
      if (const toml::node* node = peek(companion); node != nullptr && !present.empty()) {
        error_at(node, path_to(companion), fmt::format("means something only beside {}", all[i].name),
                 fmt::format("expected it left out with {}", names[present[0]]));
      }
    }
  }
  if (present.empty() && !frame.excused) {
    error_at(frame.table, path(), fmt::format("holds neither {}", fmt::join(names, " nor ")),
             fmt::format("expected {}", fmt::join(examples, " or ")));
  }
  if (present.size() > 1) {
    // An override that came on top of the file is the one to blame.
    const toml::node* where = frame.table;
    names.clear();
    for (const std::size_t i : present) {
      names.emplace_back(all[i].name);
      if (overridden(peek(all[i].name)->source())) where = peek(all[i].name);
    }
    error_at(where, path(), fmt::format("holds {} at once", fmt::join(names, " and ")), "expected one of them");
  }
  return present;
}

std::size_t Reader::list_size(const Key& key, std::size_t) {
  const std::string expected = fmt::format("expected tables headed [[{}]]", key.name);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return 0;
  if (const toml::array* array = node->as_array()) return array->size();
  error_at(node, path_to(key.name), described(*node), expected);
  return 0;
}

void Reader::unsupported(const Unsupported& keys) {
  Frame& frame = frames_.back();
  for (const char* name : keys.names) {
    const toml::node* node = peek(name);
    if (node == nullptr) continue;
    frame.known.push_back({name, {}});
    frame.excused = true;
    error_at(node, path_to(name), keys.problem, keys.expected);
  }
}

void Reader::enter_table(const Key& key, const std::string& path) {
  const toml::node* node = find(key, table_expectation(key));
  const toml::table* table = node == nullptr ? nullptr : node->as_table();
  if (node != nullptr && table == nullptr) error_at(node, path, described(*node), table_expectation(key));
  frames_.push_back({table, {}, {}});
  push(path);
}

void Reader::enter_item(const Key& key, std::size_t index, const std::string& path) {
  const toml::array* array = peek(key.name)->as_array();
  const toml::node& item = (*array)[index];
  places_[path] = item.source();
  if (!item.is_table()) error_at(&item, path, described(item), "expected a table");
  frames_.push_back({item.as_table(), {}, {}});
  push(path);
}

void Reader::leave_table() {
  close_frame();
  pop();
}

const toml::node* Reader::peek(std::string_view name) const {
  const toml::table* table = frames_.back().table;
  return table == nullptr ? nullptr : table->get(name);
}

const toml::node* Reader::find(const Key& key, std::string expected) {
  Frame& frame = frames_.back();
  frame.known.push_back({key.name, key.field != nullptr ? key.field : ""});
  const toml::node* node = peek(key.name);
  if (node != nullptr) places_[path_to(key.name)] = node->source();
  if (node == nullptr && frame.table != nullptr && key.required) {
    frame.missing.push_back({key.name, std::move(expected)});
  }
  return node;
}

void Reader::close_frame() {
  Frame& frame = frames_.back();
  if (frame.table != nullptr) {
    for (const auto& entry : *frame.table) {
      const auto same = [&](const Known& known) { return known.name == entry.first.str(); };
      if (std::none_of(frame.known.begin(), frame.known.end(), same)) {
        report_unknown(frame, entry.first.str(), entry.second);
      }
    }
    // A missing key of the whole file has no line to point at.
    const toml::node* where = frames_.size() > 1 ? frame.table : nullptr;
    for (const Missing& key : frame.missing) {
      if (!frame.excused) error_at(where, path_to(key.name), "is missing", key.expected);
    }
  }
  frames_.pop_back();
}

void Reader::report_unknown(Frame& frame, std::string_view name, const toml::node& value) {
  std::vector<std::string> names;
  for (const Known& known : frame.known) names.push_back(known.name);
  std::string best = nearest(name, names);
  // Not a slip of the fingers: maybe the struct's name for the key, or a key that belongs below another header.
  constexpr int kSlips = 2;
  if (best.empty() || edit_distance(name, best) > kSlips) {
    if (const std::string path = elsewhere(name); !path.empty()) best = path;
  }
  for (const Known& known : frame.known) {
    if (known.field == name) best = known.name;
  }
  // What was meant is there, only misspelt.
  std::erase_if(frame.missing, [&](const Missing& key) { return key.name == best; });
  error_at(&value, path_to(std::string(name)), "unknown key",
           best.empty() ? "expected no keys here" : fmt::format("the nearest known key is {}", best));
}

// --- Errors ---

void Reader::error_at(const toml::node* node, const std::string& key, std::string problem, std::string expected) {
  add(node == nullptr ? toml::source_region{} : node->source(), {{}, 0, key, std::move(problem), std::move(expected)});
}

bool Reader::accept(const toml::node& node, std::optional<Error> error) {
  if (!error) return true;
  add(node.source(), std::move(*error));
  return false;
}

void Reader::add(const toml::source_region& where, Error error) {
  const bool from_override = overridden(where);
  error.file = where.path ? *where.path : file_;
  error.line = from_override ? 0 : static_cast<int>(where.begin.line);
  (from_override ? override_errors_ : errors_).push_back(std::move(error));
}

bool Reader::overridden(const toml::source_region& where) const {
  return where.path != nullptr && where.path->rfind(kOverrideSource, 0) == 0;
}

std::string Reader::innermost(std::string path) const {
  while (!path.empty() && places_.count(path) == 0) {
    const auto cut = path.find_last_of(".[");
    path.resize(cut == std::string::npos ? 0 : cut);
  }
  return path;
}

toml::source_region Reader::place_of(const std::string& path) const {
  if (path.empty()) return {};
  // What is wrong with a whole table began with the override inside it, if there is one.
  for (auto inside = places_.lower_bound(path + "."); inside != places_.end(); ++inside) {
    if (inside->first.rfind(path + ".", 0) != 0) break;
    if (overridden(inside->second)) return inside->second;
  }
  return places_.at(path);
}

void Reader::add_located(const Errors& errors) {
  for (const Error& error : errors) {
    const std::string place = innermost(error.key);
    // Only a consequence: of something wrong inside the value, or of a value that could not be read.
    const auto cause = [&](const Error& other) {
      if (!place.empty() && other.key == place) return true;
      if (other.key.rfind(error.key, 0) != 0) return false;
      return other.key.size() == error.key.size() || std::strchr(".[", other.key[error.key.size()]) != nullptr;
    };
    if (std::any_of(errors_.begin(), errors_.end(), cause)) continue;
    if (std::any_of(override_errors_.begin(), override_errors_.end(), cause)) continue;
    add(place_of(place), error);
  }
}

Errors Reader::take_errors() {
  // The file itself first, then those it includes.
  const auto place = [this](const Error& e) { return std::tuple(e.file != file_, std::string_view(e.file), e.line); };
  std::stable_sort(errors_.begin(), errors_.end(), [&](const Error& a, const Error& b) { return place(a) < place(b); });
  errors_.insert(errors_.end(), override_errors_.begin(), override_errors_.end());
  override_errors_.clear();
  return std::move(errors_);
}

}  // namespace divot::scene
