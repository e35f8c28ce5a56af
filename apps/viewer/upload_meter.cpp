#include "viewer/upload_meter.h"

#include <chrono>
#include <osgViewer/Viewer>

#include "viewer/offscreen_context.h"
#include "viewer/scene_graph.h"

namespace divot::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

struct UploadMeter::Impl {
  explicit Impl(OffscreenContext&& gl) : context(std::move(gl)), scene(Sun{}, Look{.quality = Quality::fast}) {}
  // What lives on the graphics card can only be given back while the context is current.
  ~Impl() {
    if (context.make_current()) viewer = nullptr;
  }

  void frame_world(World& world, int width, int height);

  OffscreenContext context;
  SceneGraph scene;
  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
};

void UploadMeter::Impl::frame_world(World& world, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const Vec3d origin = world.surface().origin;
  const Framing framing = frame(world.surface(), world.bodies(), world.bombs(), aspect);
  scene.set_view(origin, framing.region, framing.camera);
  viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer->setUpViewerAsEmbeddedInWindow(0, 0, width, height);
  viewer->setLightingMode(osg::View::NO_LIGHT);
  viewer->setSceneData(&scene.root());
  const Vec3d eye = framing.camera.eye - origin, target = framing.camera.target - origin;
  osg::Camera* camera = viewer->getCamera();
  camera->setDrawBuffer(GL_BACK);
  camera->setViewport(0, 0, width, height);
  camera->setProjectionMatrixAsPerspective(framing.camera.fov_deg, aspect, 1, 1000);
  camera->setViewMatrixAsLookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {0, 0, 1});
}

UploadMeter::UploadMeter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
UploadMeter::UploadMeter(UploadMeter&&) noexcept = default;
UploadMeter& UploadMeter::operator=(UploadMeter&&) noexcept = default;
UploadMeter::~UploadMeter() = default;

Result<UploadMeter> UploadMeter::create(World& world, int width, int height) {
  return OffscreenContext::create(width, height, samples_of(Quality::fast)).map([&](OffscreenContext&& context) {
    UploadMeter meter(std::make_unique<Impl>(std::move(context)));
    meter.impl_->frame_world(world, width, height);
    meter.show(world, {});
    return meter;
  });
}

PictureCost UploadMeter::show(World& world, std::vector<DirtyRange> dirty) {
  Snapshot snapshot = take_snapshot(world);
  snapshot.dirty = std::move(dirty);
  PictureCost cost;
  const std::uint64_t before = impl_->scene.terrain().uploaded_bytes();
  const auto start = Clock::now();
  impl_->scene.update(snapshot);
  cost.update_ms = ms_since(start);
  cost.bytes = impl_->scene.terrain().uploaded_bytes() - before;

  const auto drawn = Clock::now();
  impl_->viewer->frame();
  glFinish();
  cost.draw_ms = ms_since(drawn);
  return cost;
}

}  // namespace divot::viewer
