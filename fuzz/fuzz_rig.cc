// Any text as a rig: read or refused, and what was read passes the validator.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/rig_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto rig = laterna::read_rig(text, "input", "/nonexistent/folder");
  if (!rig) {
    if (rig.error().diagnostics.empty()) std::abort();  // every refusal says why
    return 0;
  }
  if (!laterna::validate(rig->scene).empty()) std::abort();  // a rig's own checks are at least as strict
  return 0;
}
