// A crowd of moving models under moving lights, put together in code: each model plays a clip of its own at a time of its
// own, so that every one is posed for every frame, and every shadow map is drawn for it.
#pragma once

#include "laterna/render.h"

namespace laterna::growth {

struct Crowd {
  int models = 200;
  int lights = 8;      ///< spots that wander over the crowd; each casts shadows
  int map_size = 512;  ///< of each light's shadow map
};

/// The MD2 models of Debian's assimp-testmodels, 198 key frames each, by turns; where they are not installed, generated
/// reeds that eight joints sway. The ground they stand on, the camera's distance and the lights' height grow with the
/// crowd, so that it always fills the picture.
Result<Scene> make_crowd(const Crowd& crowd);
/// The crowd as a whole.
View look_at_crowd(const Crowd& crowd, double aspect);

}  // namespace laterna::growth
