#pragma once

#include <osgViewer/Viewer>
#include <string>

/// Runs `viewer` for three seconds of its time without a display and writes the last picture, PNG. Returns an exit
/// status.
int take_shot(osgViewer::Viewer& viewer, const std::string& path);
