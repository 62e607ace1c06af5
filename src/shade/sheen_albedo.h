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

}  // namespace laterna::shade
