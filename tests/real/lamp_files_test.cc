// The lamp files under ../shared/scenes: all are read, and hold the light that their makers say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "reference/lamp_lights.h"

namespace laterna {
namespace {

const std::filesystem::path kLamps = std::filesystem::path(LATERNA_SHARED_DIR) / "scenes" / "ies";

std::map<std::string, LightDistribution> all_lamps() {
  std::map<std::string, LightDistribution> lamps;
  for (const auto& entry : std::filesystem::directory_iterator(kLamps)) {
    if (entry.path().extension() != ".ies" && entry.path().extension() != ".ldt") continue;
    Result<LightDistribution> lamp = read_lamp_file(entry.path());
    if (!lamp) {
      ADD_FAILURE() << to_string(lamp.error());
      continue;
    }
    EXPECT_EQ(find_fault(*lamp), "");
    lamps.emplace(entry.path().filename(), std::move(*lamp));
  }
  EXPECT_GE(lamps.size(), 11U);
  return lamps;
}

TEST(LampFiles, FluxIsWhatAnIndependentIntegrationFinds) {
  if (!std::filesystem::exists(kLamps)) GTEST_SKIP() << kLamps << " is not there";
  for (const auto& [name, lamp] : all_lamps()) {
    const double flux = luminous_flux(lamp);
    EXPECT_GT(flux, 10) << name;
    EXPECT_NEAR(reference::flux_by_directions(lamp, 300000), flux, 0.002 * flux) << name;
  }
}

TEST(LampFiles, KernelsFindTheFilesOwnInterpolation) {
  if (!std::filesystem::exists(kLamps)) GTEST_SKIP() << kLamps << " is not there";
  const std::vector<glm::dvec3> directions = reference::spread_directions(100000);
  for (const auto& [name, lamp] : all_lamps()) {
    const double peak = summarise(lamp).peak_cd;
    const std::vector<float> candela = reference::shaded_candela(lamp, directions, best_instruction_set());
    double worst = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
      worst = std::max(worst, std::abs(candela[i] - candela_toward(lamp, directions[i])));
    EXPECT_LT(worst, 2e-5 * peak) << name;
  }
}

}  // namespace
}  // namespace laterna
