// Light that was worked out beforehand: light maps, and the way of Quake.
#pragma once

namespace laterna::app {

class Sitting;

/// Textures alone, light maps alone, and their product, as Quake showed them; beside it the same by light maps of floats.
void draw_quake(Sitting& sitting);
/// A scene with its lights, the same baked, and where they differ.
void draw_baked(Sitting& sitting);

}  // namespace laterna::app
