#include "output/obj.h"

#include <fmt/format.h>

#include <iterator>

#include "output/atomic_file.h"

namespace divot::output {
namespace {

constexpr std::size_t kFull = 1 << 20;

void flush(AtomicFile& file, fmt::memory_buffer& text, std::size_t least) {
  if (text.size() < least) return;
  file.write(text.data(), text.size());
  text.clear();
}

}  // namespace

Result<void> write_obj(const std::string& path, const SurfaceView& surface) {
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write("# metres, z up\n");
  fmt::memory_buffer text;
  for (const Vec3& position : surface.positions) {
    const Vec3d p = to_double(position) + surface.origin;
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x, p.y, p.z);
    flush(*file, text, kFull);
  }
  for (std::size_t k = 0; k + 2 < surface.triangles.size(); k += 3) {
    const auto corner = surface.triangles.subspan(k, 3);
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", corner[0] + 1, corner[1] + 1, corner[2] + 1);
    flush(*file, text, kFull);
  }
  flush(*file, text, 0);
  return file->commit();
}

}  // namespace divot::output
