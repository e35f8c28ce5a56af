#include "bench/peers_surface.h"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <algorithm>
#include <random>

#include "bench/peers.h"
#include "geometry/bvh.h"
#include "terrain/grid.h"

namespace divot::bench {
namespace {

constexpr int kSide = 708;  // vertices: a million triangles
constexpr std::size_t kBalls = 20'000;

Result<SurfaceTask> make_task() {
  std::mt19937 random(1);
  const auto number = [&](float low, float high) {
    return low + (high - low) * (static_cast<float>(random() % 65536) / 65536);
  };
  auto surface = terrain::load_grid({.columns = kSide, .rows = kSide, .spacing = 1}, 1'000'000);
  if (!surface) return tl::unexpected(surface.error());
  SurfaceTask task;
  const auto triangles = surface->mesh.triangles();
  task.triangles.assign(triangles.begin(), triangles.end());
  task.before = surface->position;
  for (Vec3& p : task.before) p.z = number(-0.2f, 0.2f);
  // What moves lies together, as a crater does.
  task.after = task.before;
  const float reach = 0.1f * kSide / 1.7725f;  // a disc of a hundredth of the area
  std::vector<bool> moved(task.after.size());
  for (std::size_t v = 0; v < task.after.size(); ++v) {
    Vec3& p = task.after[v];
    moved[v] = p.x * p.x + p.y * p.y < reach * reach;
    if (moved[v]) p.z -= 0.5f;
  }
  for (std::uint32_t f = 0; f < task.triangles.size() / 3; ++f)
    if (moved[task.triangles[3 * f]] || moved[task.triangles[3 * f + 1]] || moved[task.triangles[3 * f + 2]])
      task.dirty.push_back(f);
  const float half = 0.49f * kSide;
  for (std::size_t k = 0; k < kBalls; ++k)
    task.balls.push_back({number(-half, half), number(-half, half), number(-0.2f, 0.2f)});
  return task;
}

void compare_divot(const SurfaceTask& task, std::vector<PeerTime>& times, std::vector<PeerTime>& queries) {
  geometry::Bvh bvh;
  const std::size_t faces = task.triangles.size() / 3;
  const auto corners = geometry::corners_in(task.triangles);
  bvh.build(static_cast<std::uint32_t>(faces), corners, task.before, 0.05f, geometry::Bvh::Order::as_numbered, Jobs(1));
  bool there = false;
  const double partial = cpu_ns([&] {
    there = !there;
    const auto& positions = there ? task.after : task.before;
    for (const std::uint32_t face : task.dirty)
      for (const std::uint32_t v : corners(face)) bvh.touch(face, positions[v]);
    bvh.refit(corners, positions);
  });
  times.push_back({"refit", "divot", partial / static_cast<double>(faces), faces, "triangles, of which 1 % moved", {}});
  std::vector<std::uint32_t> found;
  const double asked = cpu_ns([&] {
    for (const Vec3& ball : task.balls) found.clear(), bvh.query_sphere(ball, task.radius, found);
  });
  queries.push_back(
      {"ball queries", "divot", asked / static_cast<double>(task.balls.size()), task.balls.size(), "balls", {}});
}

struct Count : btTriangleCallback {
  std::size_t triangles = 0;
  void processTriangle(btVector3*, int, int) override { ++triangles; }
};

void compare_bullet(const SurfaceTask& task, std::vector<PeerTime>& times, std::vector<PeerTime>& queries) {
  std::vector<Vec3> positions = task.before;
  std::vector<int> indices(task.triangles.begin(), task.triangles.end());
  btIndexedMesh mesh;
  mesh.m_numTriangles = static_cast<int>(indices.size() / 3);
  mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
  mesh.m_triangleIndexStride = 3 * sizeof(int);
  mesh.m_numVertices = static_cast<int>(positions.size());
  mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(positions.data());
  mesh.m_vertexStride = sizeof(Vec3);
  mesh.m_vertexType = PHY_FLOAT;
  btTriangleIndexVertexArray array;
  array.addIndexedMesh(mesh, PHY_INTEGER);
  btBvhTriangleMeshShape shape(&array, true);
  const auto faces = static_cast<std::size_t>(mesh.m_numTriangles);
  btVector3 low, high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  low.setZ(low.z() - 1);
  bool there = false;
  const double whole = cpu_ns([&] {
    there = !there;
    positions = there ? task.after : task.before;
    shape.refitTree(low, high);
  });
  times.push_back({"refit", "Bullet, whole", whole / static_cast<double>(faces), faces, "triangles", {}});
  positions = task.before;
  shape.refitTree(low, high);
  Count count;
  const double asked = cpu_ns([&] {
    const btVector3 reach(task.radius, task.radius, task.radius);
    for (const Vec3& ball : task.balls) {
      const btVector3 centre(ball.x, ball.y, ball.z);
      shape.processAllTriangles(&count, centre - reach, centre + reach);
    }
  });
  queries.push_back(
      {"ball queries", "Bullet", asked / static_cast<double>(task.balls.size()), task.balls.size(), "balls", {}});
}

}  // namespace

Result<void> compare_surfaces(std::vector<PeerTime>& times) {
  const auto task = make_task();
  if (!task) return tl::unexpected(task.error());
  std::vector<PeerTime> queries;
  compare_divot(*task, times, queries);
#ifdef DIVOT_HAS_EMBREE
  std::vector<PeerTime> embree;
  compare_embree(*task, embree);
  for (PeerTime& t : embree) (t.task == "refit" ? times : queries).push_back(std::move(t));
#else
  times.push_back({.task = "refit", .who = "Embree", .missing = "built without it (Debian: libembree-dev)"});
  queries.push_back({.task = "ball queries", .who = "Embree", .missing = "built without it (Debian: libembree-dev)"});
#endif
  compare_bullet(*task, times, queries);
  times.insert(times.end(), queries.begin(), queries.end());
  return {};
}

}  // namespace divot::bench
