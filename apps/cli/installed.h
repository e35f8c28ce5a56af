#pragma once

#include <string>

namespace divot::cli {

/// Where scene files and measured data are: `asked`, else beside the program where it is installed, else in the source
/// tree it was built from.
std::string scenes_folder(const std::string& asked);
std::string data_folder(const std::string& asked);

}  // namespace divot::cli
