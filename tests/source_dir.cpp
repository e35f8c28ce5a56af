#include "source_dir.h"

namespace divot::test {

const char* source_dir() { return DIVOT_SOURCE_DIR; }

}  // namespace divot::test
