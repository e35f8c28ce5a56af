// Any bytes as a scene file: read and then consistent, or refused with a reason.
#include "divot/scene.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto scene = divot::parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  if (scene ? !divot::check(*scene).empty() : scene.error().empty()) std::abort();
  return 0;
}
