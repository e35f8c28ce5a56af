// Meshes in every format that is read, whole and broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "meshfile/mesh_file.h"
#include "output/formats.h"
#include "support.h"
#include "terrain/terrain.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using meshfile::TriangleMesh;

class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("divot_meshfile_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string error(const std::string& name, const std::string& bytes) const {
    const auto mesh = meshfile::read_mesh(write(name, bytes));
    if (mesh) return "read";
    std::string text = mesh.error().front().text();
    return text.substr(folder_.string().size() + 1);
  }
  fs::path folder_;
};

const std::vector<Vec3d> kSquare = {{0, 0, 1}, {2, 0, 1.5}, {2, 2, 1}, {0, 2, 0.5}};
const std::vector<std::uint32_t> kTwo = {0, 1, 2, 0, 2, 3};

template <class T>
std::string raw(std::initializer_list<T> values) {
  return std::string(reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T));
}

std::string swapped(std::string bytes) {
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

// --- OBJ ---

TEST_F(MeshFile, ObjInAllItsSpellings) {
  const std::string vertices = "# a square\nv 0 0 1\nv 2 0 1.5\r\nv 2 2 1 1.0\nv 0 2 5e-1\nvn 0 0 1\nvt 0 0\n";
  for (const char* faces : {"f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n", "f 1/1 2/1 3/1 4/1\n", "f 1//1 2//1 3//1 4//1\n",
                            "f -4 -3 -2 -1\n", "o part\ng x\nusemtl y\ns off\nf 1/1/1 2/1/1 3/1/1 4/1/1"}) {
    const auto mesh = meshfile::read_mesh(write("a.obj", vertices + faces));
    ASSERT_TRUE(mesh) << faces << mesh.error().front().text();
    EXPECT_EQ(mesh->vertices, kSquare) << faces;
    EXPECT_EQ(mesh->triangles, kTwo) << faces;
  }
}

TEST_F(MeshFile, ObjErrorsNameTheLine) {
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 0\n"), "a.obj:2: a vertex is not three numbers; expected v X Y Z");
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"),
            "a.obj:3: a face has the corner \"9\"; expected the number of a vertex above, 1 to 2");
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), "a.obj:3: a face has 2 corners; expected at least 3");
  EXPECT_EQ(error("a.obj", "v 0 0 nan\n"), "a.obj: vertex 0 is not finite; expected numbers");
}

// --- PLY ---

TEST_F(MeshFile, PlyAsTextAndBothBinaries) {
  const std::string head =
      "comment by hand\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty double y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto expect = [&](const std::string& bytes) {
    const auto mesh = meshfile::read_mesh(write("a.ply", bytes));
    ASSERT_TRUE(mesh) << mesh.error().front().text();
    EXPECT_EQ(mesh->vertices, kSquare);
    EXPECT_EQ(mesh->triangles, kTwo);
  };
  expect("ply\nformat ascii 1.0\n" + head + "0 9 0 1\n2 9 0 1.5\n2 9 2 1\n0 9 2 .5\n4 0 1 2 3\n");
  for (const bool big : {false, true}) {
    const auto put = [&](const std::string& bytes) { return big ? swapped(bytes) : bytes; };
    std::string body;
    for (const Vec3d& p : kSquare)
      body += put(raw<float>({static_cast<float>(p.x)})) + '\x09' + put(raw<double>({p.y})) +
              put(raw<float>({static_cast<float>(p.z)}));
    body += '\x04';
    for (const int k : {0, 1, 2, 3}) body += put(raw<int>({k}));
    expect(std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + head + body);
  }
}

TEST_F(MeshFile, PlyErrors) {
  EXPECT_EQ(error("a.ply", "plx\n"), "a.ply:1: does not begin with \"ply\"; expected a PLY file");
  EXPECT_EQ(
      error("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000000\nproperty float x\nend_header\n1\n"),
      "a.ply:6: vertex 1 of 4000000000000 is cut short or wrong; expected its numbers, and faces of vertices above "
      "them");
  EXPECT_EQ(error("a.ply", "ply\nformat zip 1.0\n"),
            "a.ply:2: the format is \"zip\"; expected ascii, binary_little_endian or binary_big_endian");
}

// --- STL ---

TEST_F(MeshFile, StlJoinsItsCorners) {
  std::string text = "solid s\n", binary(80, ' ');
  binary += raw<std::uint32_t>({2});
  for (std::size_t k = 0; k < 6; ++k) {
    const Vec3d p = kSquare[kTwo[k]];
    if (k % 3 == 0) text += "facet normal 0 0 1\nouter loop\n", binary += std::string(12, '\0');
    text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    binary += raw<float>({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    if (k % 3 == 2) text += "endloop\nendfacet\n", binary += std::string(2, '\0');
  }
  for (const std::string& bytes : {text, binary}) {
    const auto mesh = meshfile::read_mesh(write("a.STL", bytes));
    ASSERT_TRUE(mesh) << mesh.error().front().text();
    EXPECT_EQ(mesh->vertices, kSquare);
    EXPECT_EQ(mesh->triangles, kTwo);
  }
  EXPECT_EQ(error("a.stl", binary.substr(0, 150)),
            "a.stl: 150 bytes hold no STL of 2 triangles; expected a whole file");
}

// --- glTF ---

TEST_F(MeshFile, GltfAppliesItsNodesAndStandsUp) {
  // One triangle, y up, scaled by 2 and moved by 1 along y, which is up.
  const std::string buffer = raw<float>({0, 0, 0, 1, 0, 0, 0, 0, -1}) + raw<std::uint16_t>({0, 1, 2, 0});
  write("a.bin", buffer);
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"translation":[0,1,0],"children":[1]},{"scale":[2,2,2],"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "buffers":[{"uri":"a.bin","byteLength":44}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                   {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  const auto mesh = meshfile::read_mesh(write("a.gltf", json));
  ASSERT_TRUE(mesh) << mesh.error().front().text();
  EXPECT_EQ(mesh->vertices, (std::vector<Vec3d>{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_NE(error("b.gltf", "{\"nodes\":[]"), "read");
  EXPECT_EQ(error("b.gltf", R"({"nodes":[{"children":[0]}]})"),
            "b.gltf: node 0 lies below two others or itself; expected a tree");
  std::string far = json;
  far.replace(far.find("\"count\":3"), 9, "\"count\":9");
  EXPECT_EQ(error("b.gltf", far), "b.gltf: accessor 0 reaches beyond its buffer; expected a whole file");
}

// --- there and back ---

TEST_F(MeshFile, WhatIsWrittenIsTerrainAgain) {
  Scene scene;
  scene.terrain.shape = GridTerrain{
      .columns = 24, .rows = 17, .spacing = 0.5, .height = [](double x, double y) { return 0.2 * x * y + 40; }};
  const World world = test::make_world(scene);
  const output::Frame frame = output::take_frame(world, nullptr, false);
  for (const char* format : {"ply", "obj", "glb"}) {
    const std::string path = (folder_ / "t.").string() + format;
    ASSERT_TRUE(output::format(format).write(path, frame));
    const auto mesh = meshfile::read_mesh(path);
    ASSERT_TRUE(mesh) << mesh.error().front().text();
    ASSERT_EQ(mesh->vertices.size(), frame.positions.size()) << format;
    EXPECT_EQ(mesh->triangles, *frame.triangles) << format;
    for (std::size_t v = 0; v < frame.positions.size(); ++v)
      EXPECT_NEAR(length(mesh->vertices[v] - to_double(frame.positions[v]) - frame.origin), 0, 2e-6) << format;

    Scene again;
    again.folder = folder_.string();
    again.terrain.shape = MeshTerrain{.path = std::string("t.") + format};
    const auto surface = terrain::load_terrain(again);
    ASSERT_TRUE(surface) << surface.error().front().text();
    EXPECT_EQ(surface->mesh.face_count() * 3, frame.triangles->size());
  }
}

TEST_F(MeshFile, TerrainFromAFile) {
  write("hill.obj", "v 0 0 0\nv 0 1 -4\nv 4 2 -4\nv 4 0 0\nf 1 4 3 2\n");  // y up
  Scene scene =
      *parse_scene("[terrain]\nmesh = \"hill.obj\"\nup = \"y\"\nscale = 0.5\n", (folder_ / "s.toml").string());
  const World world = test::make_world(scene);
  EXPECT_NEAR(world.ground_height(2, 2), 1, 1e-6);
  EXPECT_NEAR(world.ground_height(1e-3, 2 - 1e-3), 0.5, 2e-3);

  const auto refused = [&](const std::string& name, const std::string& bytes) {
    write(name, bytes);
    scene.terrain.shape = MeshTerrain{.path = name};
    const auto surface = terrain::load_terrain(scene);
    return surface ? std::string("read") : surface.error().front().text().substr(folder_.string().size() + 1);
  };
  EXPECT_EQ(
      refused("wing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0.5 0.5 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n").substr(0, 9),
      "wing.obj:");
  EXPECT_NE(refused("wing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0.5 0.5 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n")
                .find("edge 0-1, from (0, 0, 0) to (1, 0, 0), belongs to 3 triangles"),
            std::string::npos);
  EXPECT_NE(refused("none.ply", "").find("does not begin"), std::string::npos);
  scene.terrain.shape = MeshTerrain{.path = "missing.obj"};
  EXPECT_NE(terrain::load_terrain(scene).error().front().text().find("No such file"), std::string::npos);
}

// --- damage ---

TEST_F(MeshFile, DamagedFilesAreReadOrRefused) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 4, .rows = 3, .spacing = 1};
  const World world = test::make_world(scene);
  const output::Frame frame = output::take_frame(world, nullptr, false);
  std::mt19937 random(7);
  for (const char* format : {"ply", "obj", "glb"}) {
    const std::string path = (folder_ / "t.").string() + format;
    ASSERT_TRUE(output::format(format).write(path, frame));
    const std::string whole = *meshfile::read_bytes(path);
    for (int round = 0; round < 400; ++round) {
      std::string bytes = whole;
      for (auto change = random() % 3 + 1; change > 0; --change) {
        const std::size_t at = random() % bytes.size();
        if (random() % 4 == 0)
          bytes.resize(at + 1);
        else
          bytes[at] = static_cast<char>(random() % 3 == 0 ? 0xff : random());
      }
      const auto mesh = meshfile::read_mesh(write(std::string("d.") + format, bytes));
      if (!mesh) {
        EXPECT_FALSE(mesh.error().front().problem.empty());
        continue;
      }
      for (const std::uint32_t v : mesh->triangles) EXPECT_LT(v, mesh->vertices.size());
    }
  }
}

}  // namespace
}  // namespace divot
