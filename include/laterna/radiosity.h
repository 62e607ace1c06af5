// How diffuse interreflection is worked out.
#pragma once

namespace laterna {

/// Interreflection by radiosity, for light maps.
struct RadiositySettings {
  /// Rays that look around from each luxel, in [16, 65536]. What noise is left falls as about 1 / rays^¾.
  int rays = 256;
  /// How often light is reflected at most, in [0, 1000]: 1 is light that was reflected once, 0 is no interreflection.
  int bounces = 100;
  /// Bounces end when one of them adds less than this fraction of what all before it brought, in [0, 1].
  float tolerance = 1e-3F;
};

}  // namespace laterna
