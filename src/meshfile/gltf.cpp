#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "meshfile/mesh_file.h"
#include "meshfile/text.h"

namespace divot::meshfile {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<double, 16>;  // column by column, as glTF has them

constexpr int kFloat = 5126, kByte = 5121, kShort = 5123, kUint = 5125;  // component types, glTF 2.0 section 3.6.2
constexpr int kTriangles = 4, kStrip = 5, kFan = 6;                      // modes of a primitive
constexpr std::size_t kMostVertices = 100'000'000;  // a small file may name one accessor very often

// What is wrong with the file, in the words of an Error; thrown and caught in this file alone, like what nlohmann::json
// throws where a member is missing or of another type.
struct Wrong {
  std::string problem, expected;
};

Matrix identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
}

Vec3d applied(const Matrix& m, const Vec3d& p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

// A node's own transform: a matrix, or translation, rotation (x, y, z, w) and scale.
Matrix transform_of(const Json& node) {
  if (node.contains("matrix")) return node.at("matrix").get<Matrix>();
  const auto t = node.value("translation", std::array<double, 3>{0, 0, 0});
  const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
  const auto [x, y, z, w] = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
  return {s[0] * (1 - 2 * (y * y + z * z)),
          s[0] * 2 * (x * y + z * w),
          s[0] * 2 * (x * z - y * w),
          0,
          s[1] * 2 * (x * y - z * w),
          s[1] * (1 - 2 * (x * x + z * z)),
          s[1] * 2 * (y * z + x * w),
          0,
          s[2] * 2 * (x * z + y * w),
          s[2] * 2 * (y * z - x * w),
          s[2] * (1 - 2 * (x * x + y * y)),
          0,
          t[0],
          t[1],
          t[2],
          1};
}

std::string decoded(std::string_view base64) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t value = kLetters.find(c);
    if (value == kLetters.npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if ((count += 6) < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> count & 0xff);
  }
  return out;
}

class Reader {
 public:
  Reader(const std::string& path, Json json, std::string_view binary) : json_(std::move(json)), binary_(binary) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    for (const Json& buffer : json_.value("buffers", Json::array())) buffers_.push_back(load(folder, buffer));
  }

  TriangleMesh mesh() {
    const Json& nodes = member("nodes");
    if (json_.contains("scenes")) {
      const Json& scene = at(json_.at("scenes"), json_.value("scene", 0));
      for (const Json& root : scene.value("nodes", Json::array())) add_node(nodes, root.get<std::size_t>(), identity());
    } else {
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (seen_.empty() || !seen_[k]) add_node(nodes, k, identity());
    }
    return std::move(mesh_);
  }

 private:
  std::string load(const std::filesystem::path& folder, const Json& buffer) {
    if (!buffer.contains("uri")) return std::string(binary_);
    const std::string uri = buffer.at("uri");
    if (!uri.starts_with("data:")) {
      auto bytes = read_bytes((folder / uri).string());
      if (!bytes) throw Wrong{fmt::format("its buffer \"{}\" {}", uri, bytes.error().front().problem), {}};
      return std::move(*bytes);
    }
    const std::size_t comma = uri.find(";base64,");
    if (comma == uri.npos) throw Wrong{"a buffer is not in base64", "expected data:...;base64,"};
    return decoded(std::string_view(uri).substr(comma + 8));
  }
  const Json& member(const char* name) const {
    if (!json_.contains(name)) throw Wrong{fmt::format("has no {}", name), "expected glTF 2.0 with a mesh"};
    return json_[name];
  }
  static const Json& at(const Json& list, std::size_t index) {
    if (index >= list.size())
      throw Wrong{fmt::format("refers to element {} of {}", index, list.size()), "expected one that is there"};
    return list[index];
  }

  // Calls `use(bytes)` for each element of an accessor.
  template <class F>
  void each(std::size_t index, int components, std::size_t component_size, F use) const {
    const Json& accessor = at(member("accessors"), index);
    if (accessor.contains("sparse")) throw Wrong{"an accessor is sparse", "expected plain ones"};
    const Json& view = at(member("bufferViews"), accessor.value("bufferView", ~std::size_t{0}));
    const std::string& buffer = buffers_.at(view.at("buffer").get<std::size_t>());
    const std::size_t size = components * component_size, count = accessor.at("count");
    const std::size_t stride = view.value("byteStride", size);
    const std::size_t begin = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    const std::size_t room = begin < buffer.size() ? buffer.size() - begin : 0;
    if (count > 0 && (stride == 0 || room < size || (room - size) / stride < count - 1))
      throw Wrong{fmt::format("accessor {} reaches beyond its buffer", index), "expected a whole file"};
    for (std::size_t k = 0; k < count; ++k) use(buffer.data() + begin + k * stride);
  }

  std::vector<std::uint32_t> indices(const Json& primitive, std::size_t vertices) const {
    std::vector<std::uint32_t> out;
    if (!primitive.contains("indices")) {
      for (std::uint32_t v = 0; v < vertices; ++v) out.push_back(v);
      return out;
    }
    const std::size_t accessor = primitive.at("indices");
    const int type = at(member("accessors"), accessor).at("componentType");
    const std::size_t size = type == kByte ? 1 : type == kShort ? 2 : 4;
    if (type != kByte && type != kShort && type != kUint)
      throw Wrong{"indices are no integers", "expected glTF's types"};
    each(accessor, 1, size, [&](const char* bytes) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes, size);
      if (value >= vertices) throw Wrong{fmt::format("index {} of {} vertices", value, vertices), "expected one below"};
      out.push_back(value);
    });
    return out;
  }

  void add_primitive(const Json& primitive, const Matrix& to_world, const Vec3d& origin) {
    const int mode = primitive.value("mode", kTriangles);
    if (mode != kTriangles && mode != kStrip && mode != kFan) return;  // points and lines are no surface
    const std::size_t accessor = primitive.at("attributes").at("POSITION");
    if (at(member("accessors"), accessor).at("componentType") != kFloat) throw Wrong{"positions are no floats", {}};
    const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
    each(accessor, 3, sizeof(float), [&](const char* bytes) {
      std::array<float, 3> p;
      std::memcpy(p.data(), bytes, sizeof p);
      const Vec3d q = applied(to_world, {p[0], p[1], p[2]});
      mesh_.vertices.push_back(Vec3d{q.x, -q.z, q.y} + origin);  // y up to z up
      if (mesh_.vertices.size() > kMostVertices) throw Wrong{"has more than 10^8 vertices", "expected fewer"};
    });
    const std::vector<std::uint32_t> index = indices(primitive, mesh_.vertices.size() - base);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const std::size_t k : {a, b, c}) mesh_.triangles.push_back(base + index[k]);
    };
    for (std::size_t k = 2; k < index.size(); k += mode == kTriangles ? 3 : 1) {
      if (mode == kFan)
        add(0, k - 1, k);
      else if (mode == kStrip && k % 2 == 1)
        add(k - 1, k - 2, k);
      else
        add(k - 2, k - 1, k);
    }
  }

  void add_node(const Json& nodes, std::size_t index, const Matrix& parent, int depth = 0) {
    constexpr int kDeepest = 256;
    if (depth > kDeepest)
      throw Wrong{"nodes lie too deep inside each other", fmt::format("expected at most {} levels", kDeepest)};
    const Json& node = at(nodes, index);
    seen_.resize(nodes.size());
    if (seen_[index]) throw Wrong{fmt::format("node {} lies below two others or itself", index), "expected a tree"};
    seen_[index] = true;
    const Matrix to_world = product(parent, transform_of(node));
    // Terrain that was written here says what floats have no digits for.
    Vec3d origin;
    if (node.contains("extras") && node.at("extras").is_object() && node.at("extras").contains("origin")) {
      const auto at_origin = node.at("extras").at("origin").get<std::array<double, 3>>();
      origin = {at_origin[0], at_origin[1], at_origin[2]};
    }
    if (node.contains("mesh"))
      for (const Json& primitive : at(member("meshes"), node.at("mesh")).at("primitives"))
        add_primitive(primitive, to_world, origin);
    for (const Json& child : node.value("children", Json::array()))
      add_node(nodes, child.get<std::size_t>(), to_world, depth + 1);
  }

  Json json_;
  std::string_view binary_;
  std::vector<std::string> buffers_;
  std::vector<bool> seen_;  // [node]
  TriangleMesh mesh_;
};

std::uint32_t word(std::string_view bytes, std::size_t at) {
  if (at + 4 > bytes.size()) throw Wrong{"is cut short", "expected a whole file"};
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// A .glb: twelve bytes, then chunks, each with its length and kind; the first is JSON, the second the buffer.
TriangleMesh read_chunks(const std::string& path, std::string_view bytes) {
  const std::size_t text = word(bytes, 12);
  if (text > bytes.size() - 20) throw Wrong{"is cut short", "expected a whole file"};
  const std::size_t next = 20 + text;
  const std::string_view binary =
      next + 8 <= bytes.size() ? bytes.substr(next + 8, word(bytes, next)) : std::string_view{};
  return Reader(path, Json::parse(bytes.substr(20, text)), binary).mesh();
}

}  // namespace

Result<TriangleMesh> read_gltf(const std::string& path, std::string_view bytes) try {
  TriangleMesh mesh =
      bytes.starts_with("glTF") ? read_chunks(path, bytes) : Reader(path, Json::parse(bytes), {}).mesh();
  if (mesh.triangles.empty()) throw Wrong{"has no triangles", "expected a mesh in its scene"};
  join_equal_vertices(mesh);
  return mesh;
} catch (const Wrong& wrong) {
  return refuse(path, 0, wrong.problem, wrong.expected);
} catch (const std::exception& error) {  // of nlohmann::json, and std::vector::at
  return refuse(path, 0, fmt::format("is no glTF 2.0 that can be read ({})", error.what()), {});
}

}  // namespace divot::meshfile
