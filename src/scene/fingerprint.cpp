#include "scene/fingerprint.h"

#include <string_view>

#include "core/hash.h"
#include "scene/describe.h"

namespace divot::scene {
namespace {

/// Adds up where each key stands and what it holds.
class Hasher : public HeldVisitor {
 public:
  core::Hash hash;

  void number(const Key& key, double& value) override { start(key), hash.add(value); }
  void integer(const Key& key, std::int64_t& value) override { start(key), add(value); }
  void flag(const Key& key, bool& value) override { start(key), add(value); }
  void text(const Key& key, std::string& value) override { start(key), add(value); }
  void vector(const Key& key, Vec3d& value) override { start(key), add(value); }
  void place(const Key& position, const Key&, Vec3d& value, bool& above) override {
    start(position), add(value), add(above);
  }
  void maybe_number(const Key& key, std::optional<double>& value) override {
    start(key), add(value.has_value());
    if (value) hash.add(*value);
  }
  void maybe_vector(const Key& key, std::optional<Vec3d>& value) override {
    start(key), add(value.has_value());
    if (value) add(*value);
  }
  void profile(const Key& key, Profile& value) override {
    start(key), add(value.points.size());
    for (const auto& [time, at] : value.points) hash.add(time), hash.add(at);
  }
  void option(const Key& key, Names, std::size_t& index) override { start(key), add(index); }
  void options(const Key& key, Names, std::vector<std::string>& values) override {
    start(key), add(values.size());
    for (const std::string& value : values) add(value);
  }
  void legend(const Key& key, std::vector<LegendEntry>& entries) override {
    start(key), add(entries.size());
    for (const LegendEntry& entry : entries) add(entry.color), add(entry.pixel), add(entry.material);
  }
  void policy(const Key& key, UpdatePolicy& value) override {
    start(key), add(static_cast<int>(value.kind)), add(value.steps);
  }
  void base(const Key&, Material&, std::span<const Material>) override {}  // what it gives is in the material's keys

  void add(std::string_view text) {
    add(text.size());
    for (const char c : text) add(static_cast<unsigned char>(c));
  }

 private:
  template <class Number>
  void add(Number value) {
    hash.add(static_cast<std::uint64_t>(value));
  }
  void add(const Vec3d& v) { hash.add(v.x), hash.add(v.y), hash.add(v.z); }
  void add(const std::string& text) { add(std::string_view(text)); }
  void start(const Key& key) { add(std::string_view(path_to(key.name))); }
};

}  // namespace

std::uint64_t fingerprint(const Scene& scene, std::span<const Material> used) {
  Hasher hasher;
  Scene copy = scene;
  copy.duration = Scene{}.duration;
  copy.output = {};
  describe(hasher, copy);
  for (Material material : used) {
    hasher.add(std::string_view(material.name));
    describe(hasher, material);
  }
  return hasher.hash.value();
}

}  // namespace divot::scene
