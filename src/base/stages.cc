#include "laterna/stages.h"

#include <numeric>

namespace laterna {
namespace {

constexpr std::array<std::string_view, kStageCount> kNames = {
    "cull", "transform", "set-up", "clip", "bin", "raster", "surface", "shadow", "light", "encode"};

}  // namespace

std::string_view name_of(Stage stage) { return kNames[static_cast<std::size_t>(stage)]; }

StageTimes& StageTimes::operator+=(const StageTimes& other) {
  for (std::size_t i = 0; i < kStageCount; ++i) ms[i] += other.ms[i];
  return *this;
}

double StageTimes::total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }

StageTimes StageTimes::share_out(double total_ms) const {
  const double whole = total();
  StageTimes shares;
  for (std::size_t i = 0; whole > 0 && i < kStageCount; ++i) shares.ms[i] = total_ms * (ms[i] / whole);
  return shares;
}

}  // namespace laterna
