// Any bytes as a lamp file of either format: read or refused, and what was read is sound.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "laterna/lamps.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* name : {"fuzz.ies", "fuzz.ldt"}) {
    const auto lamp = laterna::read_lamp(std::as_bytes(std::span(data, size)), name, "/nonexistent/folder");
    if (!lamp) {
      if (lamp.error().diagnostics.empty()) std::abort();  // every refusal says why
      continue;
    }
    if (!laterna::find_fault(*lamp).empty()) std::abort();
    const laterna::LampSummary summary = laterna::summarise(*lamp);
    if (!std::isfinite(summary.flux_lm) || !(summary.peak_cd > 0)) std::abort();
  }
  return 0;
}
