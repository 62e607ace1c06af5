// The comparison that every shadow map test comes down to (rows 29, 84 and 100).
#pragma once

namespace laterna::shadow {

/// Lit unless something stored is nearer to the light than what is tested, by more than the bias. All three are
/// reversed depths, which grow toward the light: lit means stored ≤ tested + bias, that is distance ≤ stored distance
/// + bias. (Segal et al. 1992 print z_τ > z^l + ε, which with depth growing away from the light darkens lit surfaces.)
/// The kernels make the same comparison from the same text, N at a time: depth_comparison-inl.h.
bool is_lit(float stored, float tested, float bias);

}  // namespace laterna::shadow
