#include "meshfile/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <tuple>

#include "divot/ids.h"
#include "meshfile/text.h"

namespace divot::meshfile {
namespace {

using Read = Result<TriangleMesh> (*)(const std::string&, std::string_view);
struct Kind {
  const char* ending;
  Read read;
};
constexpr Kind kKinds[] = {
    {".obj", read_obj}, {".ply", read_ply}, {".stl", read_stl}, {".gltf", read_gltf}, {".glb", read_gltf}};

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

// What every format promises; one place checks it.
Result<void> check(const std::string& path, const TriangleMesh& mesh) {
  if (mesh.vertices.size() >= kNone) return refuse(path, 0, "has more vertices than can be numbered", "expected fewer");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v]))
      return refuse(path, 0, fmt::format("vertex {} is not finite", v), "expected numbers");
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    if (mesh.triangles[k] >= mesh.vertices.size())
      return refuse(path, 0, fmt::format("triangle {} has a vertex {} that is not there", k / 3, mesh.triangles[k]),
                    fmt::format("expected vertices below {}", mesh.vertices.size()));
  return {};
}

}  // namespace

bool is_gltf(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

Result<std::string> read_bytes(const std::string& path) {
  std::error_code ignored;
  errno = std::filesystem::is_directory(path, ignored) ? EISDIR : 0;
  std::ifstream in;
  if (errno == 0) in.open(path, std::ios::binary);
  if (errno != 0 || !in) return refuse(path, 0, std::string("cannot be read: ") + std::strerror(errno), {});
  return std::string(std::istreambuf_iterator<char>(in), {});
}

Result<TriangleMesh> read_mesh(const std::string& path) {
  const std::string ending = ending_of(path);
  const auto* kind = std::ranges::find_if(kKinds, [&](const Kind& k) { return ending == k.ending; });
  if (kind == std::end(kKinds))
    return refuse(path, 0, fmt::format("a mesh cannot end in \"{}\"", ending),
                  "expected .obj, .ply, .stl, .gltf or .glb");
  const auto bytes = read_bytes(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto mesh = kind->read(path, *bytes);
  if (!mesh) return mesh;
  if (const auto ok = check(path, *mesh); !ok) return tl::unexpected(ok.error());
  return mesh;
}

void join_equal_vertices(TriangleMesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const Vec3d& p = mesh.vertices[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  // Equal ones follow each other, the first in the file in front.
  std::ranges::sort(order,
                    [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];

  std::vector<std::uint32_t> place(order.size());
  std::vector<Vec3d> kept;
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) place[v] = static_cast<std::uint32_t>(kept.size()), kept.push_back(mesh.vertices[v]);
    place[v] = place[first[v]];
  }
  std::vector<std::uint32_t> triangles;
  for (std::size_t k = 0; k + 2 < mesh.triangles.size(); k += 3) {
    const std::uint32_t a = place[mesh.triangles[k]], b = place[mesh.triangles[k + 1]],
                        c = place[mesh.triangles[k + 2]];
    if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
  }
  mesh = {std::move(kept), std::move(triangles)};
}

}  // namespace divot::meshfile
