// How much light cloth's fibres scatter in all, so that what lies beneath gets the rest.
#pragma once

#include <array>

#include "base/task_pool.h"

namespace laterna::shade {

/// E(n·v, roughness): the integral of the sheen lobe of colour 1 under light of 1 from everywhere (KHR_materials_sheen,
/// "albedo scaling"; Estevez & Kulla 2017, Production friendly microfacet sheen BRDF, section 4). At most 1.
struct SheenAlbedo {
  static constexpr int kSide = 32;
  /// By n·v across and roughness down, both from 0 to 1, the first and last entry at the ends.
  std::array<float, kSide * kSide> share{};
};
SheenAlbedo make_sheen_albedo(const TaskPool& pool);

/// The lobe itself, divided by its colour: D V of Estevez & Kulla 2017, equations 2 and 3, with the least α of shading.
/// Cosines in (0, 1].
double sheen_lobe(double n_l, double n_v, double n_h, double roughness);
/// One entry of the table; `count` directions.
double integrate_sheen(double n_v, double roughness, int count);

}  // namespace laterna::shade
