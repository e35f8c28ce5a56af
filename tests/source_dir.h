#pragma once

namespace divot::test {

/// Root of the source tree. A function and no macro of every compile command, so that compiler caches serve all clones.
const char* source_dir();

}  // namespace divot::test
