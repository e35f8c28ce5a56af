// What OpenSceneGraph applications use: triangles taken from their graph, and a world put into it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osgUtil/UpdateVisitor>
#include <osgViewer/Viewer>

#include "divot_osg/collect_triangles.h"
#include "divot_osg/world_node.h"
#include "viewer/offscreen_context.h"
#include "viewer/pixel_reader.h"
#include "viewer/upload_meter.h"

// Asked by the leak checker of sanitized builds: Mesa 22.3 keeps 1 MB of each context that it destroys, whatever was
// drawn.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so"; }

namespace divot::viewer {
namespace {

// A strip or a soup of one quad of 2 x 1 m whose corner is at x, y.
osg::ref_ptr<osg::Geode> quad(float x, float y, GLenum mode = GL_TRIANGLE_STRIP) {
  osg::ref_ptr<osg::Vec3Array> p = new osg::Vec3Array;
  const osg::Vec3 a(x, y, 0), b(x + 2, y, 0), c(x, y + 1, 0), d(x + 2, y + 1, 0);
  if (mode == GL_TRIANGLE_STRIP) {
    for (const osg::Vec3& corner : {a, b, c, d}) p->push_back(corner);
  } else {
    for (const osg::Vec3& corner : {a, b, c, b, d, c}) p->push_back(corner);
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(p);
  geometry->addPrimitiveSet(new osg::DrawArrays(mode, 0, static_cast<int>(p->size())));
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(geometry);
  return geode;
}

double area_seen(const MeshTerrain& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3d a = mesh.vertices[mesh.triangles[i]];
    sum += cross(mesh.vertices[mesh.triangles[i + 1]] - a, mesh.vertices[mesh.triangles[i + 2]] - a).z / 2;
  }
  return sum;
}

TEST(CollectTriangles, JoinsNeighboursAcrossDrawables) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(quad(0, 0));
  group->addChild(quad(2, 0, GL_TRIANGLES));
  const auto mesh = collect_triangles(*group);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_EQ(mesh->vertices.size(), 6u);
  EXPECT_DOUBLE_EQ(area_seen(*mesh), 4);
}

TEST(CollectTriangles, AppliesTransformsAlsoMirrors) {
  osg::ref_ptr<osg::MatrixTransform> outer = new osg::MatrixTransform(osg::Matrixd::translate(700000, 4000000, 100));
  osg::ref_ptr<osg::MatrixTransform> inner = new osg::MatrixTransform(osg::Matrixd::scale(-3, 3, 1));
  outer->addChild(inner);
  inner->addChild(quad(0, 0));
  const auto mesh = collect_triangles(*outer);
  ASSERT_TRUE(mesh);
  EXPECT_DOUBLE_EQ(area_seen(*mesh), 18) << "still facing up";
  for (const Vec3d& p : mesh->vertices) {
    EXPECT_EQ(p.z, 100);
    EXPECT_TRUE(p.x == 700000 || p.x == 700000 - 6) << p.x;
    EXPECT_TRUE(p.y == 4000000 || p.y == 4000003) << p.y;
  }
}

TEST(CollectTriangles, JoinsWithinTheToleranceOnly) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(quad(0, 0));
  group->addChild(quad(2.004f, 0));
  EXPECT_EQ(collect_triangles(*group)->vertices.size(), 8u);
  EXPECT_EQ(collect_triangles(*group, 0.001)->vertices.size(), 8u);
  EXPECT_EQ(collect_triangles(*group, 0.01)->vertices.size(), 6u);
}

TEST(CollectTriangles, WeldsAsSearchingAllOfThemDoes) {
  osg::ref_ptr<osg::Vec3Array> p = new osg::Vec3Array;
  std::srand(5);
  const auto random = [] { return static_cast<float>(std::rand() % 4000) / 1000; };
  for (int k = 0; k < 900; ++k) p->push_back(osg::Vec3(random(), random(), random()));
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(p);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 900));
  constexpr double kTolerance = 0.3;
  std::vector<osg::Vec3d> kept;
  for (const osg::Vec3d corner : *p) {
    bool near = false;
    for (const osg::Vec3d& other : kept) near = near || (other - corner).length() <= kTolerance;
    if (!near) kept.push_back(corner);
  }
  const auto mesh = collect_triangles(*geometry, kTolerance);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->vertices.size(), kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(mesh->vertices[k].x, kept[k].x());
}

TEST(CollectTriangles, DropsWhatHasNoAreaAndWhatIsOff) {
  osg::ref_ptr<osg::Switch> group = new osg::Switch;
  group->addChild(quad(0, 0), false);
  osg::ref_ptr<osg::Node> flat = quad(5, 0);
  osg::ref_ptr<osg::MatrixTransform> line = new osg::MatrixTransform(osg::Matrixd::scale(1, 0, 0));
  line->addChild(flat);
  group->addChild(line);
  group->setName("field");
  const auto mesh = collect_triangles(*group);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().front().text(),
            "the sub-graph \"field\" has no triangles; expected geometry that is switched on");
  EXPECT_FALSE(collect_triangles(*group, -1));
  EXPECT_FALSE(collect_triangles(*group, std::nan("")));
}

TEST(CollectTriangles, TakesWhatIsNoGeometryToo) {
  osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
  field->allocate(12, 9);
  osg::ref_ptr<osg::ShapeDrawable> shape = new osg::ShapeDrawable(field);
  const auto mesh = collect_triangles(*shape);
  ASSERT_TRUE(mesh);
  EXPECT_NEAR(area_seen(*mesh), 11 * 8, 1e-9);
}

// Ground of 30 x 30 m far from the origin, with a ball that rolls on it.
Scene ball_scene() {
  Scene scene;
  osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(5000, 2000, 300));
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 30; ++column) {
      osg::ref_ptr<osg::MatrixTransform> cell =
          new osg::MatrixTransform(osg::Matrixd::scale(0.5, 0.5, 1) * osg::Matrixd::translate(column, row * 0.5, 0));
      cell->addChild(quad(0, 0));
      place->addChild(cell);
    }
  scene.terrain = {.shape = collect_triangles(*place, 1e-6).value(), .material = "mud"};
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{1},
                   .mass = 4000,
                   .position = {5008, 2015, 0},
                   .above_ground = true,
                   .velocity = {6, 0, 0}}};
  return scene;
}

osg::ref_ptr<WorldNode> make_node(const WorldNodeOptions& options = {}) {
  auto node = WorldNode::create(ball_scene(), nullptr, options);
  if (!node) ADD_FAILURE() << node.error().front().text();
  return *node;
}

// An update traversal at a time, as viewers do it.
void update(osg::Node& root, double time, unsigned frame) {
  osgUtil::UpdateVisitor visitor;
  osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
  stamp->setSimulationTime(time);
  stamp->setFrameNumber(frame);
  visitor.setFrameStamp(stamp);
  visitor.setTraversalNumber(frame);
  root.accept(visitor);
}

TEST(WorldNode, StepsWithTheFrameStamp) {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  osg::ref_ptr<WorldNode> node = make_node({.most_steps = 30});
  root->addChild(node);
  update(*root, 100, 1);
  EXPECT_EQ(node->world().steps(), 0u) << "when it is seen first, no time has passed yet";
  update(*root, 100.2501, 2);
  EXPECT_EQ(node->world().steps(), 15u);
  update(*root, 100.2501, 3);
  update(*root, 99, 4);
  EXPECT_EQ(node->world().steps(), 15u) << "time that stands still or goes back";
  update(*root, 99.5001, 5);
  EXPECT_EQ(node->world().steps(), 45u);
}

TEST(WorldNode, DropsWhatItCannotCatchUpWith) {
  osg::ref_ptr<WorldNode> node = make_node({.most_steps = 3});
  EXPECT_EQ(node->advance(10.008), 3);
  EXPECT_EQ(node->advance(0), 0);
  EXPECT_EQ(node->advance(0.6 / 60), 1) << "half a step was left over";
}

TEST(WorldNode, StandsWhereTheTerrainIs) {
  const osg::BoundingSphere bound = make_node()->getBound();
  EXPECT_NEAR(bound.center().x(), 5015, 1);
  EXPECT_NEAR(bound.center().y(), 2015, 1);
  EXPECT_NEAR(bound.center().z(), 300, 3);
  EXPECT_NEAR(bound.radius(), 21.2, 3);
}

TEST(WorldNode, AModelFollowsItsBody) {
  osg::ref_ptr<WorldNode> node = make_node();
  osg::MatrixTransform& place = node->body_node({0});
  EXPECT_EQ(&place, &node->body_node({0}));
  const double before = place.getMatrix().getTrans().x();
  node->advance(0.05);
  EXPECT_GT(place.getMatrix().getTrans().x(), before + 0.1);
  EXPECT_EQ(place.getMatrix().getTrans().x(), node->world().bodies()[0].position.x);
}

TEST(WorldNode, SendsOnlyWhatChanged) {
  osg::ref_ptr<WorldNode> node = make_node();
  const std::uint64_t first = node->uploaded_bytes();
  EXPECT_GT(first, 0u);
  node->refresh();
  EXPECT_EQ(node->uploaded_bytes(), first);
  node->advance(0.06);
  EXPECT_GT(node->uploaded_bytes(), first);
}

TEST(WorldNode, PassesErrorsOn) {
  Scene scene = ball_scene();
  scene.terrain.material = "cheese";
  const auto node = WorldNode::create(scene);
  ASSERT_FALSE(node);
  EXPECT_EQ(node.error().front().key, "terrain.material");
}

// An application with a world in it: its own lights, a camera from above.
class Application {
 public:
  explicit Application(const osg::ref_ptr<WorldNode>& node) {
    auto made = OffscreenContext::create(kSize, kSize, 0);
    EXPECT_TRUE(made) << made.error().front().text();
    context_ = std::make_unique<OffscreenContext>(std::move(*made));
    viewer_->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_->setUpViewerAsEmbeddedInWindow(0, 0, kSize, kSize);
    viewer_->setLightingMode(osg::View::SKY_LIGHT);
    viewer_->setSceneData(node);
    osg::Camera* camera = viewer_->getCamera();
    camera->setDrawBuffer(GL_BACK);
    camera->setReadBuffer(GL_BACK);
    camera->setClearColor({0, 0, 1, 1});
    camera->setViewport(0, 0, kSize, kSize);
    camera->setProjectionMatrixAsPerspective(30, 1, 1, 1000);
    camera->setViewMatrixAsLookAt({5015, 1980, 340}, {5015, 2015, 300}, {0, 0, 1});
    camera->setFinalDrawCallback(reader_);
  }
  ~Application() {
    if (context_->make_current()) viewer_ = nullptr;
  }

  Image picture(double time) {
    viewer_->frame(time);
    return reader_->image();
  }

  static constexpr int kSize = 200;

 private:
  std::unique_ptr<OffscreenContext> context_;
  osg::ref_ptr<PixelReader> reader_ = new PixelReader;
  osg::ref_ptr<osgViewer::Viewer> viewer_ = new osgViewer::Viewer;
};

// Mean of a channel in a square around the middle, 0 to 255.
double mean(const Image& image, std::size_t channel, int half) {
  double sum = 0;
  for (int row = image.height / 2 - half; row < image.height / 2 + half; ++row)
    for (int column = image.width / 2 - half; column < image.width / 2 + half; ++column)
      sum += image.rgb[3 * static_cast<std::size_t>(row * image.width + column) + channel];
  return sum / (4.0 * half * half);
}

int changed_pixels(const Image& a, const Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) count += std::abs(a.rgb[i] - b.rgb[i]) > 8;
  return count;
}

class WorldNodeLook : public ::testing::TestWithParam<NodeLook> {};

TEST_P(WorldNodeLook, GroundIsSeenInTheApplicationsSky) {
  Application application(make_node({.look = GetParam(), .most_steps = 10}));
  const Image first = application.picture(0);
  EXPECT_EQ(std::vector<std::uint8_t>(first.rgb.begin(), first.rgb.begin() + 3), (std::vector<std::uint8_t>{0, 0, 255}))
      << "the corner is the application's";
  EXPECT_GT(mean(first, 0, 30), 40) << "ground is neither black nor blue";
  EXPECT_LT(mean(first, 2, 30), 200);
  Image last = first;
  for (int frame = 1; frame <= 15; ++frame) last = application.picture(frame * 0.1);
  EXPECT_GT(changed_pixels(first, last), 100) << "the ball went on and left a rut";
}

INSTANTIATE_TEST_SUITE_P(Looks, WorldNodeLook, ::testing::Values(NodeLook::application, NodeLook::divot),
                         [](const auto& look) { return look.param == NodeLook::divot ? "Divot" : "Application"; });

TEST(WorldNode, TurnedSoilHasItsColour) {
  Scene scene = ball_scene();
  scene.materials = {*find_preset(scene.terrain.material)};
  scene.materials.front().color.clear();
  osg::ref_ptr<WorldNode> green =
      WorldNode::create(scene, nullptr, {.soil = {0, 1, 0, 1}, .turned = {1, 0, 0, 1}, .body = {0, 0, 1, 1}}).value();
  Application application(green);
  const auto reddish = [](const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += image.rgb[i] > image.rgb[i + 1] + 20;
    return count;
  };
  EXPECT_EQ(reddish(application.picture(0)), 0);
  Image last;
  for (int frame = 1; frame <= 15; ++frame) last = application.picture(frame * 0.05);
  EXPECT_GT(reddish(last), 50);
}

TEST(UploadMeter, SendsLessThanEverything) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 301, .rows = 301, .spacing = 0.2}, .material = "mud"};
  scene.bodies = {{.shape = Sphere{0.6}, .mass = 500, .above_ground = true, .velocity = {3, 0, 0}}};
  World world = World::create(scene).value();
  auto meter = UploadMeter::create(world, 64, 64);
  ASSERT_TRUE(meter) << meter.error().front().text();
  EXPECT_EQ(meter->show(world, world.take_dirty()).bytes, 0u);
  for (int k = 0; k < 20; ++k) world.step();
  const PictureCost changed = meter->show(world, world.take_dirty()), everything = meter->show(world, {{0, 301 * 301}});
  EXPECT_GT(changed.bytes, 0u);
  EXPECT_LT(changed.bytes, everything.bytes / 2);
  EXPECT_GT(everything.bytes, 301u * 301 * 2 * sizeof(Vec3));
  EXPECT_GT(everything.draw_ms, 0);
}

}  // namespace
}  // namespace divot::viewer
