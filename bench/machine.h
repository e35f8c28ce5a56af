#pragma once

#include <string>

namespace divot::bench {

/// What numbers were measured on: processor, cores, compiler and kind of build, on one line.
std::string machine();

}  // namespace divot::bench
