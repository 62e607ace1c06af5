#include "measure/mask_errors.h"

#include <algorithm>
#include <cmath>

#include "measure/contact_gaps.h"
#include "measure/edge_distances.h"
#include "measure/shadow_boundaries.h"

namespace laterna::measure {
namespace {

// Each may take a hundred rays.
constexpr std::size_t kMostProbed = 50000;

ShadowVerdict verdict_of(bool is_truly_lit, bool is_lit) {
  if (is_truly_lit) return is_lit ? ShadowVerdict::lit : ShadowVerdict::false_dark;
  return is_lit ? ShadowVerdict::false_lit : ShadowVerdict::dark;
}

// Turns false shadow that lies far from every true boundary into acne: first by the picture, then by rays.
void find_acne(const LitPixels& pixels, const ShadowBoundaries& boundaries, const TaskPool& pool,
               std::vector<ShadowVerdict>& verdicts) {
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] == ShadowVerdict::false_dark && boundaries.distance_from(i, kFarTexels) > kFarTexels)
      far.push_back(i);
  }
  const std::size_t stride = (far.size() + kMostProbed - 1) / kMostProbed;
  if (stride == 0) return;
  pool.for_each((far.size() + stride - 1) / stride, [&](std::size_t probe, int) {
    const std::size_t first = probe * stride;
    if (has_shadow_beside(pixels, far[first], kFarTexels)) return;
    for (std::size_t i = first; i < std::min(first + stride, far.size()); ++i)
      verdicts[far[i]] = ShadowVerdict::acne;
  });
}

}  // namespace

ShadowAccuracy find_mask_errors(const LitPixels& pixels, const Mask& truth, const Mask& mask, int subpixels,
                                const TaskPool& pool) {
  ShadowAccuracy errors;
  errors.verdicts.assign(pixels.size(), ShadowVerdict::not_counted);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!pixels.is_counted(i)) continue;
    ++errors.pixels;
    errors.verdicts[i] = verdict_of(is_lit(truth[i]), is_lit(mask[i]));
    errors.mean_error += std::abs(static_cast<double>(mask[i]) - static_cast<double>(truth[i]));
  }
  if (errors.pixels == 0) return errors;
  const ShadowBoundaries boundaries(pixels, truth);
  find_acne(pixels, boundaries, pool, errors.verdicts);
  const auto share = [&](ShadowVerdict verdict) {
    const auto count = std::count(errors.verdicts.begin(), errors.verdicts.end(), verdict);
    return static_cast<double>(count) / static_cast<double>(errors.pixels);
  };
  errors.false_lit = share(ShadowVerdict::false_lit);
  errors.acne = share(ShadowVerdict::acne);
  errors.false_dark = share(ShadowVerdict::false_dark) + errors.acne;
  errors.mean_error /= static_cast<double>(errors.pixels);
  if (errors.false_lit > 0) errors.gap_texels = largest_contact_gap(pixels, truth, mask);
  const EdgeDistances edges = find_edge_distances(pixels, truth, mask, subpixels);
  errors.edge_pixels = edges.edges;
  errors.edge_px_median = edges.median;
  errors.edge_px_p99 = edges.p99;
  errors.edge_px_mean = edges.mean;
  return errors;
}

}  // namespace laterna::measure
