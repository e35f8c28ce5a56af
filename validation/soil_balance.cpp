// In every scene, what the ground lost is what was compacted and what was deposited.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

namespace fs = std::filesystem;

constexpr double kLimit = 0.01;

Experiment balance(const fs::path& scene) {
  return {{{fmt::format("soil_balance/{}", scene.stem().string()), "soil is not lost",
            "|displaced - compacted - deposited| over displaced", "1", kLimit, 0, Bound::at_most}},
          [=]() -> Result<Outcome> {
            const auto loaded = load_scene(scene.string());
            if (!loaded) return tl::unexpected(loaded.error());
            const auto world = run(*loaded, loaded->duration);
            if (!world) return tl::unexpected(world.error());
            return Outcome{{world->soil_volume().relative_error()}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> soil_balance(const Places& places) {
  std::vector<fs::path> scenes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(places.scenes, error))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  if (error) return fail({.file = places.scenes, .problem = error.message(), .expected = "a folder of scene files"});
  std::sort(scenes.begin(), scenes.end());
  std::vector<Experiment> experiments;
  for (const fs::path& scene : scenes) experiments.push_back(balance(scene));
  return experiments;
}

}  // namespace divot::validation
