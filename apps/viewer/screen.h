#pragma once

#include <osgViewer/Viewer>
#include <string>

#include "divot/errors.h"

namespace divot::viewer {

/// A window that osgViewer draws into, on the calling thread. `samples`: of a pixel; 0: none. Fails (key `display`)
/// when the display refuses.
Result<osg::ref_ptr<osgViewer::Viewer>> open_screen(int width, int height, int samples, const std::string& title);

}  // namespace divot::viewer
