#include "output/csv.h"

#include <fmt/format.h>

#include <iterator>

#include "core/assert.h"

namespace divot::output {
namespace {

// A name with a comma, a quote or a line break stands in quotes, its own quotes doubled [RFC 4180].
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

Result<BodiesCsv> BodiesCsv::create(const std::string& path, std::string_view text) {
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(text);
  file->mark();
  return BodiesCsv(std::move(*file));
}

void BodiesCsv::append(double time, std::span<const BodyView> bodies) {
  fmt::memory_buffer rows;
  for (const BodyView& b : bodies) {
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", time, quoted(b.name),
                   b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y, b.velocity.z, b.orientation.x,
                   b.orientation.y, b.orientation.z, b.orientation.w, b.sinkage);
  }
  file_.write(rows.data(), rows.size());
  file_.mark();
}

Result<void> write_surface_csv(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage) {
  DIVOT_ASSERT(sinkage.size() == surface.positions.size() && surface.materials.size() == surface.positions.size());
  constexpr std::size_t kFull = 1 << 20;
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write("x,y,z,sinkage,material\n");
  fmt::memory_buffer rows;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const Vec3d p = to_double(surface.positions[v]) + surface.origin;
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{}\n", p.x, p.y, p.z, sinkage[v], surface.materials[v]);
    if (rows.size() < kFull) continue;
    file->write(rows.data(), rows.size());
    rows.clear();
  }
  file->write(rows.data(), rows.size());
  return file->commit();
}

}  // namespace divot::output
