#include "output/gltf.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/assert.h"
#include "math/aabb.h"
#include "output/packer.h"

namespace divot::output {
namespace {

using Json = nlohmann::ordered_json;

// glTF 2.0, section 3.6 and 5: the numbers its types are known by.
constexpr int kFloat = 5126, kUint = 5125, kByte = 5121, kVertices = 34962, kIndices = 34963;
constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

std::vector<Vec3> normals(const SurfaceView& surface) {
  std::vector<Vec3> sum(surface.positions.size());
  for (std::size_t k = 0; k + 2 < surface.triangles.size(); k += 3) {
    const auto c = surface.triangles.subspan(k, 3);
    const Vec3 a = surface.positions[c[0]];
    const Vec3 across = cross(surface.positions[c[1]] - a, surface.positions[c[2]] - a);
    for (const std::uint32_t v : c) sum[v] += across;
  }
  for (Vec3& n : sum) {
    const float size = length(n);
    n = size > 0 ? n * (1 / size) : Vec3{0, 0, 1};
  }
  return sum;
}

// Unmoved ground is brown; sunk darkens, raised lightens it, in full at half of the largest.
std::array<std::uint8_t, 4> color(float sinkage, float largest) {
  const float share = largest > 0 ? std::clamp(2 * sinkage / largest, -1.0f, 1.0f) : 0.0f;
  constexpr float kGround[] = {150, 125, 95}, kSunk[] = {70, 45, 30}, kRaised[] = {225, 210, 180};
  std::array<std::uint8_t, 4> out{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k) {
    const float end = share > 0 ? kSunk[k] : kRaised[k];
    out[k] = static_cast<std::uint8_t>(kGround[k] + std::abs(share) * (end - kGround[k]));
  }
  return out;
}

// The buffer's parts, one after the other, each with the accessor that says what it holds.
class Layout {
 public:
  void add(std::size_t bytes, int target, Json accessor) {
    views_.push_back({{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes}, {"target", target}});
    accessor["bufferView"] = accessors_.size();
    accessors_.push_back(std::move(accessor));
    size_ += bytes;
  }
  std::size_t size() const { return size_; }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  Json views_ = Json::array(), accessors_ = Json::array();
  std::size_t size_ = 0;
};

Layout lay_out(const SurfaceView& surface) {
  const std::size_t vertices = surface.positions.size(), corners = surface.triangles.size();
  math::Aabb box;
  for (const Vec3& p : surface.positions) box.include(p);
  Layout layout;
  layout.add(vertices * 12, kVertices,
             {{"componentType", kFloat},
              {"count", vertices},
              {"type", "VEC3"},
              {"min", {box.low.x, box.low.y, box.low.z}},
              {"max", {box.high.x, box.high.y, box.high.z}}});
  layout.add(vertices * 12, kVertices, {{"componentType", kFloat}, {"count", vertices}, {"type", "VEC3"}});
  layout.add(vertices * 4, kVertices,
             {{"componentType", kByte}, {"normalized", true}, {"count", vertices}, {"type", "VEC4"}});
  layout.add(vertices * 4, kVertices, {{"componentType", kFloat}, {"count", vertices}, {"type", "SCALAR"}});
  layout.add(corners * 4, kIndices, {{"componentType", kUint}, {"count", corners}, {"type", "SCALAR"}});
  return layout;
}

std::string describe(const Layout& layout, const Vec3d& origin) {
  constexpr double kHalfTurn = 0.70710678118654752;  // z up to y up: a quarter turn round x
  const Json attributes = {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}, {"_SINKAGE", 3}};
  const Json json = {
      {"asset", {{"version", "2.0"}, {"generator", "divot"}}},
      {"scene", 0},
      {"scenes", Json::array({{{"nodes", {0}}}})},
      {"nodes", Json::array({{{"name", "terrain"},
                              {"mesh", 0},
                              {"rotation", {-kHalfTurn, 0, 0, kHalfTurn}},
                              {"extras", {{"origin", {origin.x, origin.y, origin.z}}}}}})},
      {"meshes",
       Json::array({{{"primitives", Json::array({{{"attributes", attributes}, {"indices", 4}, {"material", 0}}})}}})},
      {"materials", Json::array({{{"name", "ground"},
                                  {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}}})},
      {"buffers", Json::array({{{"byteLength", layout.size()}}})},
      {"bufferViews", layout.views()},
      {"accessors", layout.accessors()}};
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

void put_arrays(Packer& packer, const SurfaceView& surface, std::span<const float> sinkage) {
  float largest = 0;
  for (const float z : sinkage) largest = std::max(largest, std::abs(z));
  for (const Vec3& p : surface.positions) packer.put(p), packer.end_record();
  for (const Vec3& n : normals(surface)) packer.put(n), packer.end_record();
  for (const float z : sinkage) packer.put(color(z, largest)), packer.end_record();
  for (const float z : sinkage) packer.put(z), packer.end_record();
  for (const std::uint32_t v : surface.triangles) packer.put(v), packer.end_record();
}

}  // namespace

Result<void> write_glb(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage) {
  DIVOT_ASSERT(sinkage.size() == surface.positions.size());
  const Layout layout = lay_out(surface);
  constexpr std::size_t kMost = 0xffffff00u;  // its sizes are 32 bits
  if (layout.size() > kMost)
    return fail({.file = path, .problem = "glTF holds no more than 4 GB", .expected = "expected a smaller terrain"});
  const std::string json = describe(layout, surface.origin);
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  {
    Packer packer(*file);
    const auto bytes = static_cast<std::uint32_t>(layout.size()), text = static_cast<std::uint32_t>(json.size());
    for (const std::uint32_t word : {kMagic, 2u, 12 + 8 + text + 8 + bytes, text, kJsonChunk}) packer.put(word);
    for (const char letter : json) packer.put(letter);
    packer.put(bytes), packer.put(kBinaryChunk);
    put_arrays(packer, surface, sinkage);
  }
  return file->commit();
}

}  // namespace divot::output
