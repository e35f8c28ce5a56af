#include "divot/version.h"

namespace divot {

const char* version() { return DIVOT_VERSION; }

}  // namespace divot
