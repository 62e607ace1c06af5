// How much of the light that meets a surface is mirrored.
#pragma once

namespace laterna::shade {

/// Fresnel's equations for unpolarised light that comes out of air onto what has that index of refraction.
/// cosine: of the angle to the normal, 0 … 1; ior ≥ 1.
double fresnel_reflectance(double cosine, double ior);

/// Schlick 1994, An inexpensive BRDF model for physically-based rendering: what share of 1 − F₀ is mirrored beyond F₀.
double schlick_weight(double cosine);

}  // namespace laterna::shade
