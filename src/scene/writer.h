#pragma once

#include <vector>

#include "scene/toml.h"
#include "scene/visitor.h"

namespace divot::scene {

/// Makes a TOML document of what is described, so that reading it gives the same values. Keys without a value are left
/// out.
class Writer : public HeldVisitor {
 public:
  toml::table document;

  void number(const Key& key, double& value) override { put(key, value); }
  void integer(const Key& key, std::int64_t& value) override { put(key, value); }
  void flag(const Key& key, bool& value) override { put(key, value); }
  void text(const Key& key, std::string& value) override {
    if (!value.empty()) put(key, value);
  }
  void vector(const Key& key, Vec3d& value) override { put(key, toml::array{value.x, value.y, value.z}); }
  void place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) override;
  void maybe_number(const Key& key, std::optional<double>& value) override {
    if (value) number(key, *value);
  }
  void maybe_vector(const Key& key, std::optional<Vec3d>& value) override {
    if (value) vector(key, *value);
  }
  void profile(const Key& key, Profile& value) override;
  void option(const Key& key, Names names, std::size_t& index) override { put(key, names[index]); }
  void options(const Key& key, Names names, std::vector<std::string>& values) override;
  void legend(const Key& key, std::vector<LegendEntry>& entries) override;
  void policy(const Key& key, UpdatePolicy& value) override;
  void base(const Key&, Material&, std::span<const Material>) override {}  // every key of the material is written

  std::size_t list_size(const Key& key, std::size_t count) override;

 protected:
  void enter_table(const Key& key, const std::string& path) override;
  void enter_item(const Key& key, std::size_t index, const std::string& path) override;
  void leave_table() override;

 private:
  template <class Value>
  void put(const Key& key, Value&& value) {
    tables_.back()->insert_or_assign(key.name, std::forward<Value>(value));
  }
  std::vector<toml::table*> tables_ = {&document};
};

}  // namespace divot::scene
