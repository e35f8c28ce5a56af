#include "output/json.h"

#include <cmath>

#include "output/atomic_file.h"

namespace divot::output {
namespace {

using Json = nlohmann::ordered_json;

// Place of the first number that is not finite, as `bodies.0.velocity.2`; empty when all are.
std::string find_not_finite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>()) ? "" : ".";
  if (!json.is_structured()) return {};
  for (const auto& [key, value] : json.items()) {
    const std::string place = find_not_finite(value);
    if (!place.empty()) return place == "." ? "." + key : "." + key + place;
  }
  return {};
}

}  // namespace

Result<void> write_json(const std::string& path, const Json& json) {
  if (const std::string place = find_not_finite(json); !place.empty()) {
    Error error;
    error.file = path;
    error.key = place.substr(1);
    error.problem = "the number is not finite";
    return fail(std::move(error));
  }
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  // A name that is not UTF-8 must not cost the run its summary.
  file->write(json.dump(2, ' ', false, Json::error_handler_t::replace));
  file->write("\n");
  return file->commit();
}

}  // namespace divot::output
