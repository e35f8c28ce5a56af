#pragma once

namespace divot {

/// Version of the library, as `0.1.0`.
const char* version();

}  // namespace divot
