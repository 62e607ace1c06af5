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

// Lumens that makers state: of the luminaire, or of its lamps times its light output ratio, as their own integration
// found them; that of projector.ldt is 2 % off.
TEST(LampFiles, FluxIsWhatMakersState) {
  if (!std::filesystem::exists(kLamps)) GTEST_SKIP() << kLamps << " is not there";
  struct Claim {
    const char* file;
    double lumens, tolerance;
  };
  const std::map<std::string, LightDistribution> lamps = all_lamps();
  for (const Claim& claim :
       {Claim{"bega_84659K4_asym_37x37.ies", 9600, 0.001}, Claim{"bega_50899_24planes.ies", 1221, 0.005},
        Claim{"bega_51010_symmetric.ies", 940, 0.005}, Claim{"road_luminaire.ldt", 33200 * 0.8442, 0.005},
        Claim{"floor_uplight.ldt", 20000 * 0.7233, 0.006}, Claim{"projector.ldt", 6500 * 0.7771, 0.025}}) {
    ASSERT_TRUE(lamps.contains(claim.file)) << claim.file;
    EXPECT_NEAR(luminous_flux(lamps.at(claim.file)), claim.lumens, claim.tolerance * claim.lumens)
        << claim.file;
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
