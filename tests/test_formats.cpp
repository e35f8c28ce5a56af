// Every format of the registry is read back; the thread that writes; what remains when a disk is full.
#include <cpl_conv.h>
#include <cpl_string.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "core/gdal.h"
#include "divot/output.h"
#include "output/formats.h"
#include "output/raster_file.h"
#include "output/writer.h"
#include "support.h"
#include "terrain/terrain.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using test::make_world;
using test::run_to;

class Formats : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("divot_formats_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A ball that has just fallen onto mud, beside a bomb that has gone off.
World struck_world(std::vector<std::string> formats = {}) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 61,
                                        .rows = 51,
                                        .spacing = 0.2,
                                        .height = [](double x, double y) { return 0.05 * x - 0.02 * y + 3; }},
                   .material = "mud"};
  scene.bodies = {{.name = "ball", .shape = Sphere{0.5}, .mass = 800, .position = {3, 0, 0.3}, .above_ground = true}};
  scene.bombs = {{.time = 0.05, .position = {-2, 0, 0}, .above_ground = true, .yield = 2e-5}};
  scene.output.formats = std::move(formats);
  return make_world(scene);
}

output::Frame frame_of(const World& world) { return output::take_frame(world, nullptr, true); }

template <class T>
std::vector<T> array_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::vector<T> out(count);
  EXPECT_LE(at + count * sizeof(T), bytes.size());
  if (at + count * sizeof(T) <= bytes.size()) std::memcpy(out.data(), bytes.data() + at, count * sizeof(T));
  return out;
}

// --- the table of formats ---

TEST_F(Formats, PageListsTheRegistry) {
  const std::string page = slurp(std::string(test::source_dir()) + "/docs/scene-format.md");
  for (const output::Format& format : output::formats()) {
    const std::string row =
        "| `" + std::string(format.name) + "` | `frame_000000." + format.name + "` | " + format.meaning + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST_F(Formats, EveryOneWritesFramesAndTheEnd) {
  std::vector<std::string> names;
  for (const char* name : output::format_names()) names.emplace_back(name);
  World world = struck_world(names);
  auto recorder = Recorder::create(folder_.string());
  ASSERT_TRUE(recorder);
  for (int k = 0; k < 3; ++k) {
    recorder->add_bodies(world);
    ASSERT_TRUE(recorder->write_frame(world));
    run_to(world, 0.1 * (k + 1));
  }
  ASSERT_TRUE(recorder->finish(world, {}));
  for (const std::string& name : names)
    for (const char* stem : {"frame_000000.", "frame_000001.", "frame_000002.", "terrain_final."})
      EXPECT_GT(fs::file_size(folder_ / (stem + name)), 100u) << stem << name;
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

// --- meshes ---

TEST_F(Formats, ObjReadsBackToTheBit) {
  World world = struck_world();
  run_to(world, 0.2);
  const output::Frame frame = frame_of(world);
  ASSERT_TRUE(output::format("obj").write(path("a.obj"), frame));
  std::istringstream in(slurp(path("a.obj")));
  std::size_t vertex = 0, corner = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3d p;
      words >> p.x >> p.y >> p.z;
      ASSERT_LT(vertex, frame.positions.size());
      EXPECT_EQ(p, to_double(frame.positions[vertex]) + frame.origin);
      ++vertex;
    } else if (kind == "f") {
      for (std::uint32_t v = 0; words >> v; ++corner) EXPECT_EQ(v, (*frame.triangles)[corner] + 1);
    }
  }
  EXPECT_EQ(vertex, frame.positions.size());
  EXPECT_EQ(corner, frame.triangles->size());
}

TEST_F(Formats, GlbHoldsWhatItsJsonSays) {
  World world = struck_world();
  run_to(world, 0.2);
  const output::Frame frame = frame_of(world);
  ASSERT_TRUE(output::format("glb").write(path("a.glb"), frame));
  const std::string bytes = slurp(path("a.glb"));
  const auto head = array_at<std::uint32_t>(bytes, 0, 5);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(head[2], bytes.size());
  EXPECT_EQ(head[3] % 4, 0u);
  const auto json = nlohmann::json::parse(bytes.substr(20, head[3]));
  const std::size_t begin = 20 + head[3] + 8;
  EXPECT_EQ(json["buffers"][0]["byteLength"], bytes.size() - begin);
  const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  const auto at = [&](int accessor) {
    return begin + json["bufferViews"][json["accessors"][accessor]["bufferView"].get<int>()]["byteOffset"].get<int>();
  };
  const std::size_t count = frame.positions.size();
  EXPECT_EQ(array_at<float>(bytes, at(attributes["_SINKAGE"]), count), frame.sinkage);
  EXPECT_EQ(array_at<Vec3>(bytes, at(attributes["POSITION"]), count), frame.positions);
  EXPECT_EQ(array_at<std::uint32_t>(bytes, at(4), frame.triangles->size()), *frame.triangles);
  for (const Vec3& n : array_at<Vec3>(bytes, at(attributes["NORMAL"]), count)) EXPECT_NEAR(length(n), 1, 1e-5);
  float low = 1e9f;
  for (const Vec3& p : frame.positions) low = std::min(low, p.z);
  EXPECT_EQ(json["accessors"][0]["min"][2].get<float>(), low);
}

// --- ParaView ---

struct VtpArray {
  std::string type;
  std::size_t at = 0, bytes = 0;
};

std::map<std::string, VtpArray> vtp_arrays(const std::string& bytes) {
  std::map<std::string, VtpArray> arrays;
  const std::size_t begin = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31;
  static const std::regex kArray("type=\"(\\w+)\" Name=\"(\\w+)\" [^>]*format=\"appended\" offset=\"(\\d+)\"");
  const std::string header = bytes.substr(0, begin);
  for (auto it = std::sregex_iterator(header.begin(), header.end(), kArray); it != std::sregex_iterator(); ++it) {
    VtpArray array{(*it)[1], begin + std::stoul((*it)[3]) + 8, 0};
    array.bytes = array_at<std::uint64_t>(bytes, array.at - 8, 1)[0];
    arrays[(*it)[2]] = array;
  }
  return arrays;
}

TEST_F(Formats, VtpHoldsItsFields) {
  World world = struck_world();
  run_to(world, 0.3);
  const output::Frame frame = frame_of(world);
  ASSERT_TRUE(output::format("vtp").write(path("a.vtp"), frame));
  const std::string bytes = slurp(path("a.vtp"));
  const auto arrays = vtp_arrays(bytes);
  const std::size_t count = frame.positions.size();
  std::size_t end = 0;
  for (const auto& [name, array] : arrays) end = std::max(end, array.at + array.bytes);
  EXPECT_EQ(bytes.substr(end), "\n</AppendedData>\n</VTKFile>\n");
  EXPECT_EQ(arrays.at("offsets").bytes, frame.triangles->size() / 3 * 8);
  EXPECT_EQ(array_at<float>(bytes, arrays.at("sinkage").at, count), frame.sinkage);
  const auto points = array_at<Vec3d>(bytes, arrays.at("Points").at, count);
  const auto awake = array_at<std::uint8_t>(bytes, arrays.at("awake").at, count);
  const auto velocity = array_at<Vec3>(bytes, arrays.at("velocity").at, count);
  const auto pressure = array_at<float>(bytes, arrays.at("pressure").at, count);
  EXPECT_EQ(points[77], to_double(frame.positions[77]) + frame.origin);
  EXPECT_EQ(std::count(awake.begin(), awake.end(), 1), static_cast<std::ptrdiff_t>(test::awake(world)));
  EXPECT_GT(test::awake(world), 10u);
  for (std::uint32_t v = 0; v < count; ++v) {
    EXPECT_EQ(pressure[v], awake[v] ? world.pressure(v) : 0);
    if (!awake[v]) {
      EXPECT_EQ(velocity[v], Vec3{});
    }
  }
  EXPECT_GT(*std::max_element(pressure.begin(), pressure.end()), 1000);  // 800 kg on a patch of decimetres
}

TEST_F(Formats, PvdListsTheFramesWithTheirTimes) {
  World world = struck_world({"vtp"});
  auto recorder = Recorder::create(folder_.string());
  ASSERT_TRUE(recorder);
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(recorder->write_frame(world));
    run_to(world, 0.25);
  }
  ASSERT_TRUE(recorder->finish(world, {}));
  const std::string text = slurp(path("frames.pvd"));
  EXPECT_NE(text.find("<DataSet timestep=\"0\" part=\"0\" file=\"frame_000000.vtp\"/>"), std::string::npos) << text;
  EXPECT_NE(text.find("<DataSet timestep=\"0.25\" part=\"0\" file=\"frame_000001.vtp\"/>"), std::string::npos) << text;
}

// --- rasters ---

TEST_F(Formats, ChangeIsHeightLessThatAtTheStart) {
  World world = struck_world();
  const RasterView before = *world.raster();
  run_to(world, 0.5);
  const RasterView after = *world.raster();
  float deepest = 0;
  for (std::size_t k = 0; k < after.heights.size(); ++k) {
    EXPECT_EQ(before.change[k], 0);
    EXPECT_NEAR(after.change[k], after.heights[k] - before.heights[k], 1e-5);
    EXPECT_NEAR(after.sinkage[k], -after.change[k], 0.15) << "but for soil that moved sideways along the slope";
    deepest = std::max(deepest, -after.change[k]);
  }
  EXPECT_GT(deepest, 0.05);
}

TEST_F(Formats, Png16IsTerrainAgain) {
  World world = struck_world();
  run_to(world, 0.5);
  RasterView raster = *world.raster();
  raster.holes[5] = 1;
  OGRSpatialReference utm;
  ASSERT_EQ(utm.SetFromUserInput("EPSG:32633"), OGRERR_NONE);
  char* wkt = nullptr;
  ASSERT_EQ(utm.exportToWkt(&wkt), OGRERR_NONE);
  raster.crs = wkt;
  CPLFree(wkt);
  ASSERT_TRUE(output::write_png16(path("h.png"), raster));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);

  Scene scene;
  scene.terrain.shape = DemTerrain{.path = path("h.png"), .crs = {}};
  const auto again = terrain::load_terrain(scene);
  ASSERT_TRUE(again) << again.error().front().text();
  EXPECT_NE(again->raster->crs.find("UTM zone 33N"), std::string::npos);
  EXPECT_EQ(again->raster->x0, raster.x0);
  const auto [low, high] = std::minmax_element(raster.heights.begin(), raster.heights.end());
  const float half_step = 0.51f * (*high - *low) / 65534;
  for (std::uint32_t row = 0; row < raster.rows; ++row) {
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const std::size_t pixel = row * raster.columns + column;
      const std::uint32_t v = again->raster->layout.vertex(column, raster.rows - 1 - row);
      if (raster.holes[pixel]) {
        EXPECT_EQ(again->mesh.outgoing(v), kNone);
      } else {
        EXPECT_NEAR(again->position[v].z + again->origin.z, raster.heights[pixel], half_step + 1e-6);
      }
    }
  }
}

// --- what a world tells of itself for files ---

TEST_F(Formats, PressureBearsTheBall) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 41, .rows = 41, .spacing = 0.1}, .material = "mud"};
  scene.bodies = {{.name = "ball", .shape = Sphere{0.6}, .mass = 500, .position = {0, 0, 0}, .above_ground = true}};
  World world = make_world(scene);
  run_to(world, 1.5);
  double push = 0;
  for (std::uint32_t v = 0; v < world.surface().positions.size(); ++v) push += 0.01 * world.pressure(v);
  EXPECT_NEAR(push, 500 * 9.81, 0.25 * 500 * 9.81);
}

TEST_F(Formats, EnergyFallsWithTheBall) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 21, .rows = 21, .spacing = 0.2}, .material = "mud"};
  scene.bodies = {{.name = "ball", .shape = Sphere{0.5}, .mass = 100, .position = {0, 0, 5}}};
  World world = make_world(scene);
  const Energy start = world.energy();
  EXPECT_NEAR(start.bodies_potential, 100 * 9.81 * 5, 1e-9);
  EXPECT_EQ(start.bodies_kinetic, 0);
  run_to(world, 0.5);  // still in the air
  const Energy falling = world.energy();
  EXPECT_NEAR(falling.bodies_kinetic + falling.bodies_potential, start.bodies_potential, 0.03 * 100 * 9.81 * 5);
  EXPECT_EQ(falling.ground_kinetic, 0);
  run_to(world, 3);
  EXPECT_LT(world.energy().bodies_kinetic + world.energy().bodies_potential, 0.15 * start.bodies_potential);
}

// --- the page of a report ---

std::string inflated(const std::string& bytes) {
  std::size_t size = 0;
  void* const plain = CPLZLibInflate(bytes.data(), bytes.size(), nullptr, 0, &size);
  std::string out(static_cast<const char*>(plain), plain == nullptr ? 0 : size);
  CPLFree(plain);
  return out;
}

std::string between(const std::string& text, const std::string& open) {
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find("</script>", begin) - begin);
}

TEST_F(Formats, ReportHoldsTheRun) {
  World world = struck_world();
  Report report("# text & <b>more</b> </script>");
  const std::vector<Vec3> start(world.surface().positions.begin(), world.surface().positions.end());
  for (int k = 0; k < 5; ++k) {
    report.add(world);
    run_to(world, 0.1 * (k + 1));
  }
  const auto written = report.write(path("report.html"), world, {.wall_s = 1});
  if (!written) {
    // Only a build without three.js may write none.
    ASSERT_NE(written.error().front().text().find("three.js"), std::string::npos) << written.error().front().text();
    GTEST_SKIP() << written.error().front().text();
  }
  const std::string page = slurp(path("report.html"));
  EXPECT_EQ(page.find("{{style}}"), std::string::npos);
  const auto facts = nlohmann::json::parse(between(page, "<script id=\"data\" type=\"application/json\">"));
  EXPECT_EQ(facts["scene_text"], "# text & <b>more</b> </script>");
  ASSERT_EQ(facts["frames"].size(), 6u) << "five times and the end";
  EXPECT_EQ(facts["frames"][0]["moved"], 0);
  EXPECT_GT(facts["frames"][5]["moved"], 20);
  ASSERT_EQ(facts["craters"].size(), 1u);
  EXPECT_EQ(facts["craters"][0]["lines"][1]["end"].size(), 201u);
  EXPECT_EQ(facts["bodies"][0]["name"], "ball");

  std::string blob = between(page, "<script id=\"blob\" type=\"text/plain\">");
  blob.resize(static_cast<std::size_t>(CPLBase64DecodeInPlace(reinterpret_cast<GByte*>(blob.data()))));
  const auto part = [&](const nlohmann::json& of) {
    return inflated(blob.substr(of["at"].get<std::size_t>(), of["bytes"].get<std::size_t>()));
  };
  EXPECT_EQ(array_at<Vec3>(part(facts["meshes"][0]), 0, start.size()), start);
  // What moved lies where the world has it, to half a step.
  const auto& last = facts["frames"][5];
  const std::string moved = part(last);
  const auto count = last["moved"].get<std::size_t>();
  const auto vertex = array_at<std::uint32_t>(moved, 0, count);
  const auto offset = array_at<std::int16_t>(moved, 4 * count, 3 * count);
  const double step = last["step"];
  for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(step * offset[3 * k + 2], -world.sinkage(vertex[k]), 0.51 * step);
}

// --- the thread that writes ---

TEST_F(Formats, WriterNeitherWaitsNorReorders) {
  output::Writer writer(1000);
  std::vector<int> done;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 5; ++k)
    writer.push(100, [&done, k]() -> Result<void> {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      done.push_back(k);
      return {};
    });
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(200));  // five tasks take 300
  EXPECT_TRUE(writer.drain());
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST_F(Formats, WriterHoldsNoMoreThanItMay) {
  std::atomic<int> waiting = 0, most = 0;
  output::Writer writer(250);
  for (int k = 0; k < 12; ++k) {
    writer.push(100, [&]() -> Result<void> {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      --waiting;
      return {};
    });
    most = std::max(most.load(), ++waiting);
  }
  writer.push(10'000, []() -> Result<void> { return {}; });  // larger than all of it, yet taken
  EXPECT_TRUE(writer.drain());
  EXPECT_LE(most, 3);
}

TEST_F(Formats, WriterStopsAtTheFirstFailure) {
  output::Writer writer(1000);
  int ran = 0;
  writer.push(1, [&]() -> Result<void> { return ++ran, Result<void>{}; });
  writer.push(1, [&]() -> Result<void> { return ++ran, fail({.problem = "first"}); });
  writer.push(1, []() -> Result<void> { throw std::runtime_error("never run"); });
  const auto result = writer.drain();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().front().problem, "first");
  EXPECT_EQ(ran, 2);
  output::Writer other(1000);
  other.push(1, []() -> Result<void> { throw std::runtime_error("no memory"); });
  EXPECT_NE(other.drain().error().front().text().find("no memory"), std::string::npos);
}

// /dev/full takes no byte, like a full disk; a link stands in for the part of one frame.
TEST_F(Formats, FullDiskKeepsEverythingBeforeIt) {
  ASSERT_TRUE(fs::exists("/dev/full"));
  World world = struck_world({"ply"});
  Result<void> written;
  {
    auto recorder = Recorder::create(folder_.string());
    ASSERT_TRUE(recorder);
    fs::create_symlink("/dev/full", folder_ / "frame_000002.ply.part");
    for (int k = 0; k < 200 && written; ++k) {
      recorder->add_bodies(world);
      written = recorder->write_frame(world);
      world.step();
    }
    ASSERT_FALSE(written);
    EXPECT_FALSE(recorder->finish(world, {}));
  }
  ASSERT_EQ(written.error().size(), 1u);
  EXPECT_EQ(written.error().front().file, path("frame_000002.ply"));
  EXPECT_NE(written.error().front().text().find("No space left"), std::string::npos);
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder_)) files.insert(entry.path().filename().string());
  EXPECT_EQ(files, (std::set<std::string>{"bodies.csv", "frame_000000.ply", "frame_000001.ply"}));
  const std::string rows = slurp(path("bodies.csv"));
  EXPECT_GE(std::count(rows.begin(), rows.end(), '\n'), 3);
  EXPECT_EQ(rows.back(), '\n');
}

}  // namespace
}  // namespace divot
