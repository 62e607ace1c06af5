#include "frame/lamp_table.h"

#include <algorithm>

namespace laterna::frame {
namespace {

constexpr double kMostBins = 4096;
// Rounding may put an angle into the bin beside its own.
constexpr double kBinSlack = 0.01;

}  // namespace

LampAxis::LampAxis(const std::vector<double>& angles_deg) {
  const std::size_t cells = angles_deg.size() - 1;
  double least_width = angles_deg.back() - angles_deg.front();
  for (std::size_t i = 0; i < cells; ++i) {
    const double width = angles_deg[i + 1] - angles_deg[i];
    least_width = std::min(least_width, width);
    inverse_width.push_back(static_cast<float>(1 / width));
  }
  for (const double angle : angles_deg) angle_deg.push_back(static_cast<float>(angle));
  const double range = angles_deg.back() - angles_deg.front();
  const auto bins = static_cast<std::size_t>(std::clamp(range / least_width, 1.0, kMostBins));
  const double bin_width = range / static_cast<double>(bins);
  bins_per_degree = static_cast<float>(1 / bin_width);
  const auto cell_at = [&](double angle) {
    const auto above = std::upper_bound(angles_deg.begin(), angles_deg.end(), angle) - angles_deg.begin();
    return static_cast<std::int32_t>(
        std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(cells) - 1));
  };
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const auto at = static_cast<double>(bin);
    const std::int32_t first = cell_at(angles_deg.front() + (at - kBinSlack) * bin_width);
    const std::int32_t last = cell_at(angles_deg.front() + (at + 1 + kBinSlack) * bin_width);
    cell_of_bin.push_back(first);
    steps = std::max(steps, last - first);
  }
}

LampTable::LampTable(const LightDistribution& distribution)
    : type(distribution.type),
      vertical(distribution.vertical_deg),
      horizontal(distribution.horizontal_deg),
      peak_candela(*std::max_element(distribution.candela.begin(), distribution.candela.end())),
      lumens(luminous_flux(distribution)) {
  share.reserve(distribution.candela.size());
  for (const double candela : distribution.candela) {
    share.push_back(peak_candela > 0 ? static_cast<float>(candela / peak_candela) : 0.0F);
  }
}

}  // namespace laterna::frame
