#pragma once

#include <cassert>

// A broken promise of our own. Input is never checked with it: that is what Result is for.
#define DIVOT_ASSERT(condition) assert(condition)
