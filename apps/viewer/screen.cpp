#include "viewer/screen.h"

#include <osgViewer/GraphicsWindow>

#include "viewer/failure.h"

namespace divot::viewer {
namespace {

// Whether OpenSceneGraph may tell on the terminal what it thinks: ours to say is better said.
class Silence {
 public:
  Silence() : before_(osg::getNotifyLevel()) { osg::setNotifyLevel(osg::ALWAYS); }
  ~Silence() { osg::setNotifyLevel(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  osg::NotifySeverity before_;
};

}  // namespace

Result<osg::ref_ptr<osgViewer::Viewer>> open_screen(int width, int height, int samples, const std::string& title) {
  const Silence quiet;
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  traits->setUndefinedScreenDetailsToDefaultScreen();
  traits->width = width;
  traits->height = height;
  traits->windowName = title;
  traits->windowDecoration = true;
  traits->doubleBuffer = true;
  traits->depth = 24;
  traits->sampleBuffers = samples > 0 ? 1 : 0;
  traits->samples = static_cast<unsigned>(samples);
  osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
  if (!context && samples > 0) return open_screen(width, height, 0, title);
  if (!context) {
    return failure("the display opens no window with OpenGL", "a display with GLX and 24 bits of depth", "display");
  }

  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
  viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer->setKeyEventSetsDone(0);
  viewer->setLightingMode(osg::View::NO_LIGHT);
  osg::Camera* view = viewer->getCamera();
  view->setGraphicsContext(context);
  view->setViewport(0, 0, width, height);
  view->setDrawBuffer(GL_BACK);
  view->setReadBuffer(GL_BACK);
  viewer->realize();
  if (!viewer->isRealized()) {
    return failure("the display opens no window with OpenGL", "a display with GLX and 24 bits of depth", "display");
  }
  return viewer;
}

}  // namespace divot::viewer
