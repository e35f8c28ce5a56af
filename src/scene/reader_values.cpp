#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/check.h"
#include "scene/reader.h"

namespace divot::scene {
namespace {

std::optional<double> number_in(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  if (const auto* floating = node.as_floating_point()) return floating->get();
  return std::nullopt;
}

}  // namespace

void Reader::number(const Key& key, double& value) {
  const std::string expected = expectation("a number", key);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const auto read = number_in(*node);
  if (!read) return error_at(node, path_to(key.name), described(*node), expected);
  if (accept(*node, out_of_range(path_to(key.name), key, *read))) value = *read;
}

void Reader::integer(const Key& key, std::int64_t& value) {
  const std::string expected = expectation("an integer", key);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const auto* read = node->as_integer();
  if (read == nullptr) {
    const auto* floating = node->as_floating_point();
    // With its point, so that 37.0 shows what is wrong with it.
    const bool fraction = floating != nullptr;
    return error_at(node, path_to(key.name),
                    fraction ? fmt::format("{:#} is not an integer", floating->get()) : described(*node), expected);
  }
  if (accept(*node, out_of_range(path_to(key.name), key, read->get()))) value = read->get();
}

void Reader::flag(const Key& key, bool& value) {
  const std::string expected = "expected true or false";
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const auto* read = node->as_boolean();
  if (read == nullptr) return error_at(node, path_to(key.name), described(*node), expected);
  value = read->get();
}

void Reader::text(const Key& key, std::string& value) {
  const std::string expected = "expected text in quotes";
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const auto* read = node->as_string();
  if (read == nullptr) return error_at(node, path_to(key.name), described(*node), expected);
  value = read->get();
}

bool Reader::read_components(const Key& key, const toml::array& array, Vec3d& value) {
  double components[3] = {};
  for (std::size_t i = 0; i < array.size() && i < 3; ++i) {
    const auto read = number_in(array[i]);
    const std::string path = fmt::format("{}[{}]", path_to(key.name), i);
    if (!read) return error_at(&array[i], path, described(array[i]), expectation("a number", key)), false;
    if (!accept(array[i], out_of_range(path, key, *read))) return false;
    components[i] = *read;
  }
  value = {components[0], components[1], components[2]};
  return true;
}

void Reader::vector(const Key& key, Vec3d& value) {
  const std::string expected = expectation("[x, y, z]", {.name = key.name, .unit = key.unit});
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != 3) return error_at(node, path_to(key.name), described(*node), expected);
  read_components(key, *array, value);
}

void Reader::place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) {
  const std::string expected =
      expectation("[x, y, z], or [x, y] for on the ground", {.name = position.name, .unit = position.unit});
  const toml::node* node = find(position, expected);
  flag(above_ground, above);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr || (array->size() != 2 && array->size() != 3)) {
    return error_at(node, path_to(position.name), described(*node), expected);
  }
  if (!read_components(position, *array, value) || array->size() == 3) return;
  // Two numbers: on the ground there.
  if (peek(above_ground.name) != nullptr && !above) {
    error_at(peek(above_ground.name), path_to(above_ground.name), "false with a position of two numbers",
             "expected [x, y, z], or above_ground left out");
  }
  above = true;
}

void Reader::maybe_number(const Key& key, std::optional<double>& value) {
  double read = std::numeric_limits<double>::quiet_NaN();
  number(key, read);
  if (!std::isnan(read)) value = read;
}

void Reader::maybe_vector(const Key& key, std::optional<Vec3d>& value) {
  Vec3d read{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  vector(key, read);
  if (!std::isnan(read.x)) value = read;
}

void Reader::profile(const Key& key, Profile& value) {
  const std::string expected = expectation("a number or a list of [time, number]", key);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  Profile read;
  if (const auto constant = number_in(*node)) {
    read = *constant;
  } else {
    const toml::array* list = node->as_array();
    if (list == nullptr) return error_at(node, path_to(key.name), described(*node), expected);
    read.points.clear();
    for (std::size_t i = 0; i < list->size(); ++i) {
      const toml::array* pair = (*list)[i].as_array();
      const bool whole = pair != nullptr && pair->size() == 2 && number_in((*pair)[0]) && number_in((*pair)[1]);
      if (!whole)
        return error_at(&(*list)[i], fmt::format("{}[{}]", path_to(key.name), i), described((*list)[i]),
                        "expected [time, number]");
      read.points.emplace_back(*number_in((*pair)[0]), *number_in((*pair)[1]));
    }
  }
  if (accept(*node, profile_error(path_to(key.name), key, read))) value = std::move(read);
}

void Reader::option(const Key& key, Names names, std::size_t& index) {
  const std::string expected = "expected " + one_of(names);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const auto* read = node->as_string();
  const auto at = read == nullptr ? names.end() : std::find(names.begin(), names.end(), read->get());
  if (at != names.end()) {
    index = static_cast<std::size_t>(at - names.begin());
    return;
  }
  const std::string problem = read == nullptr ? described(*node) : quoted(read->get()) + " is not known";
  error_at(node, path_to(key.name), problem, expected);
}

void Reader::options(const Key& key, Names names, std::vector<std::string>& values) {
  const std::string expected = "expected a list of " + one_of(names);
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr) return error_at(node, path_to(key.name), described(*node), expected);
  values.clear();
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& item = (*array)[i];
    const auto* read = item.as_string();
    const std::string path = fmt::format("{}[{}]", path_to(key.name), i);
    if (read == nullptr || std::find(names.begin(), names.end(), read->get()) == names.end()) {
      const std::string problem = read == nullptr ? described(item) : quoted(read->get()) + " is not known";
      error_at(&item, path, problem, "expected " + one_of(names));
    } else if (std::find(values.begin(), values.end(), read->get()) != values.end()) {
      error_at(&item, path, quoted(read->get()) + " is there twice", "expected each once");
    } else {
      values.push_back(read->get());
    }
  }
}

void Reader::policy(const Key& key, UpdatePolicy& value) {
  const std::string expected = "expected \"adaptive\", \"every_step\" or { every = 10 }";
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  if (node->is_table()) {
    enter_table(key, path_to(key.name));
    Key every = kEvery;
    every.required = true;
    value.kind = UpdatePolicy::Kind::every;
    whole(every, value.steps);
    leave_table();
  } else if (const auto* read = node->as_string(); read != nullptr && read->get() == "adaptive") {
    value = {UpdatePolicy::Kind::adaptive, 1};
  } else if (read != nullptr && read->get() == "every_step") {
    value = {UpdatePolicy::Kind::every_step, 1};
  } else {
    const std::string problem = read == nullptr ? described(*node) : quoted(read->get()) + " is not known";
    error_at(node, path_to(key.name), problem, expected);
  }
}

}  // namespace divot::scene
