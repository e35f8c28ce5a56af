#include "viewer/heap.h"

#include <malloc.h>

namespace divot::viewer {
namespace {

constexpr int kMostKept = 256 << 20, kLargestPiece = 32 << 20;  // bytes

}  // namespace

void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, kMostKept);
  mallopt(M_MMAP_THRESHOLD, kLargestPiece);
}

}  // namespace divot::viewer
