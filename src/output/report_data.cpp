#include "output/report_data.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace divot::output {
namespace {

// Arrays one after the other; each starts at a multiple of four bytes.
class Bytes {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    const std::size_t at = bytes_.size(), size = values.size() * sizeof(T);
    bytes_.resize(at + (size + 3) / 4 * 4);
    if (size > 0) std::memcpy(bytes_.data() + at, values.data(), size);
  }
  std::string deflated() const {
    constexpr int kLevel = 6;
    std::size_t size = 0;
    void* const packed = CPLZLibDeflate(bytes_.data(), bytes_.size(), kLevel, nullptr, 0, &size);
    std::string out(static_cast<const char*>(packed), packed == nullptr ? 0 : size);
    CPLFree(packed);
    return out;
  }

 private:
  std::string bytes_;
};

ShownGround whole_surface(const World& world) {
  const SurfaceView surface = world.surface();
  ShownGround out{.start = {surface.positions.begin(), surface.positions.end()},
                  .offset = std::vector<Vec3>(surface.positions.size()),
                  .triangles = {surface.triangles.begin(), surface.triangles.end()},
                  .materials = {surface.materials.begin(), surface.materials.end()}};
  for (std::uint32_t v = 0; v < out.start.size(); ++v) {
    out.offset[v].z = -world.sinkage(v);
    out.start[v].z -= out.offset[v].z;
  }
  return out;
}

// Every so manieth node of the raster, and triangles where no corner is a hole.
ShownGround coarse_grid(const RasterView& raster, const Vec3d& origin, std::uint32_t stride) {
  const std::uint32_t columns = (raster.columns - 1) / stride + 1, rows = (raster.rows - 1) / stride + 1;
  ShownGround out;
  out.stride = stride;
  std::vector<std::uint8_t> holes;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::size_t k = static_cast<std::size_t>(row) * stride * raster.columns + column * stride;
      const Vec3d p{raster.x0 + column * stride * raster.dx, raster.y0 - row * stride * raster.dy,
                    raster.heights[k] - raster.change[k]};
      out.start.push_back(to_float(p - origin));
      out.offset.push_back({0, 0, raster.change[k]});
      holes.push_back(raster.holes[k]);
    }
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!holes[a] && !holes[b] && !holes[c]) out.triangles.insert(out.triangles.end(), {a, b, c});
  };
  for (std::uint32_t row = 0; row + 1 < rows; ++row)
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + columns;  // rows run south
      face(a, b, b + 1), face(a, b + 1, a + 1);
    }
  out.materials.assign(out.start.size(), 0);
  return out;
}

}  // namespace

ShownGround shown_ground(const World& world, std::size_t most_vertices) {
  const std::size_t count = world.surface().positions.size();
  if (count <= most_vertices) return whole_surface(world);
  const std::optional<RasterView> raster = world.raster();
  if (!raster) return whole_surface(world);
  const double share = static_cast<double>(raster->heights.size()) / static_cast<double>(most_vertices);
  return coarse_grid(*raster, world.surface().origin,
                     static_cast<std::uint32_t>(std::max(1.0, std::ceil(std::sqrt(share)))));
}

std::string packed_mesh(const ShownGround& ground) {
  Bytes bytes;
  bytes.add(ground.start), bytes.add(ground.triangles), bytes.add(ground.materials);
  return bytes.deflated();
}

PackedFrame packed_frame(const ShownGround& ground) {
  constexpr float kMost = std::numeric_limits<std::int16_t>::max();
  float largest = 0;
  for (const Vec3& d : ground.offset) largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  PackedFrame frame;
  if (largest > 0) frame.step = static_cast<double>(largest) / kMost;
  const auto step = static_cast<float>(frame.step);
  std::vector<std::uint32_t> vertices;
  std::vector<std::int16_t> offset;
  for (std::uint32_t v = 0; v < ground.offset.size(); ++v) {
    const Vec3 d = ground.offset[v];
    const std::array<float, 3> in_steps{std::round(d.x / step), std::round(d.y / step), std::round(d.z / step)};
    if (in_steps == std::array<float, 3>{}) continue;
    vertices.push_back(v);
    for (const float s : in_steps) offset.push_back(static_cast<std::int16_t>(std::clamp(s, -kMost, kMost)));
  }
  frame.moved = vertices.size();
  Bytes bytes;
  bytes.add(vertices), bytes.add(offset);
  frame.bytes = bytes.deflated();
  return frame;
}

std::string base64(const std::string& bytes) {
  // GDAL's encoder takes an int: pieces of a multiple of three bytes join without a seam.
  constexpr std::size_t kPiece = 3u << 20;
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const std::size_t size = std::min(kPiece, bytes.size() - at);
    char* const text = CPLBase64Encode(static_cast<int>(size), reinterpret_cast<const GByte*>(bytes.data()) + at);
    out += text;
    CPLFree(text);
  }
  return out;
}

}  // namespace divot::output
