#include "shot.h"

#include <cstdio>

#include "viewer/image.h"
#include "viewer/offscreen_context.h"
#include "viewer/pixel_reader.h"

namespace {

constexpr int kWidth = 800, kHeight = 450, kPictures = 30;
constexpr double kSeconds = 3;

int report(const divot::Errors& errors) {
  for (const divot::Error& error : errors) std::fprintf(stderr, "osg_node: %s\n", error.text().c_str());
  return 1;
}

// From the south-west, all of the scene.
void place_camera(osg::Camera& camera, const osg::BoundingSphere& bound) {
  camera.setDrawBuffer(GL_BACK);
  camera.setReadBuffer(GL_BACK);
  camera.setViewport(0, 0, kWidth, kHeight);
  camera.setProjectionMatrixAsPerspective(30, static_cast<double>(kWidth) / kHeight, 1, 1000);
  const osg::Vec3d center = bound.center();
  camera.setViewMatrixAsLookAt(center + osg::Vec3d(-0.5, -1.1, 0.7) * bound.radius(), center, {0, 0, 1});
}

}  // namespace

int take_shot(osgViewer::Viewer& viewer, const std::string& path) {
  const auto context = divot::viewer::OffscreenContext::create(kWidth, kHeight, 4);
  if (!context) return report(context.error());
  osg::ref_ptr<divot::viewer::PixelReader> reader = new divot::viewer::PixelReader;
  viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer.setUpViewerAsEmbeddedInWindow(0, 0, kWidth, kHeight);
  place_camera(*viewer.getCamera(), viewer.getSceneData()->getBound());
  viewer.getCamera()->setFinalDrawCallback(reader);
  for (int k = 0; k <= kPictures; ++k) viewer.frame(kSeconds * k / kPictures);
  const auto written = divot::viewer::write_png(reader->image(), path);
  // What lives on the graphics card has to be given back while there is a context.
  viewer.setSceneData(nullptr);
  viewer.getCamera()->setFinalDrawCallback(nullptr);
  viewer.getCamera()->releaseGLObjects();
  return written ? 0 : report(written.error());
}
