#pragma once

#include <map>
#include <optional>

#include "scene/toml.h"
#include "scene/visitor.h"

namespace divot::scene {

/// Fills a scene from a TOML document and collects what is wrong with it, each problem with its line.
class Reader : public Visitor {
 public:
  /// `document` must outlive the reader. `file`: what it was parsed as; nodes that come from elsewhere are overrides.
  Reader(const toml::table& document, std::string file);

  /// Reports the unknown keys of the document's top level. Call it once, after describe().
  void finish() { close_frame(); }

  /// Adds errors that were found by path, at the lines of what they are about. What only follows from an error that is
  /// already there is left out.
  void add_located(const Errors& errors);

  /// Everything found, in the order of the file, then of the overrides. Empties the reader.
  Errors take_errors();

  void number(const Key& key, double& value) override;
  void integer(const Key& key, std::int64_t& value) override;
  void flag(const Key& key, bool& value) override;
  void text(const Key& key, std::string& value) override;
  void vector(const Key& key, Vec3d& value) override;
  void place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) override;
  void maybe_number(const Key& key, std::optional<double>& value) override;
  void maybe_vector(const Key& key, std::optional<Vec3d>& value) override;
  void profile(const Key& key, Profile& value) override;
  void option(const Key& key, Names names, std::size_t& index) override;
  void options(const Key& key, Names names, std::vector<std::string>& values) override;
  void legend(const Key& key, std::vector<LegendEntry>& entries) override;
  void policy(const Key& key, UpdatePolicy& value) override;
  void base(const Key& key, Material& material, std::span<const Material> earlier) override;
  std::vector<std::size_t> branches(std::span<const Branch> all, std::size_t current) override;
  std::size_t list_size(const Key& key, std::size_t count) override;
  std::vector<std::string> material_names(std::span<const Material> current) override;
  void unsupported(const Unsupported& keys) override;

 protected:
  void enter_table(const Key& key, const std::string& path) override;
  void enter_item(const Key& key, std::size_t index, const std::string& path) override;
  void leave_table() override;

 private:
  struct Known {
    std::string name, field;
  };
  struct Missing {
    std::string name, expected;
  };
  /// A table being read. Null where the document does not hold it, or holds something else there.
  struct Frame {
    const toml::table* table;
    std::vector<Known> known;      ///< every key asked for
    std::vector<Missing> missing;  ///< required ones that are not there
    bool excused = false;          ///< an unsupported key stands where a required one should
  };

  /// The key's node in the current table, or null. `expected` is for the error of a required one that is missing.
  const toml::node* find(const Key& key, std::string expected);
  const toml::node* peek(std::string_view name) const;
  bool read_components(const Key& key, const toml::array& array, Vec3d& value);
  void close_frame();
  void report_unknown(Frame& frame, std::string_view name, const toml::node& value);

  void error_at(const toml::node* node, const std::string& key, std::string problem, std::string expected);
  /// Adds `error`, if there is one, at the node; true when there was none and the value can be used.
  bool accept(const toml::node& node, std::optional<Error> error);
  void add(const toml::source_region& where, Error error);
  bool overridden(const toml::source_region& where) const;
  /// The longest part of `path` that the document holds; empty when it holds none.
  std::string innermost(std::string path) const;
  toml::source_region place_of(const std::string& path) const;

  std::string file_;
  std::vector<Frame> frames_;
  std::map<std::string, toml::source_region> places_;  ///< where each path was found
  std::vector<std::string> circular_;                  ///< materials whose base leads back to them
  Errors errors_, override_errors_;
};

}  // namespace divot::scene
