// Models of a game (MD2), as document 001 shows its shadows on: those of Debian's assimp-testmodels.
#pragma once

#include <string>

#include "laterna/scene.h"

namespace laterna::app {

struct RunningPose {
  glm::vec3 foot{0};  ///< on the ground, metres
  float turn = 0;     ///< radians about the vertical
  double time = 0;    ///< seconds of its running
};

/// Adds a model 1.75 m tall: 0 and 1 are different ones. False, and nothing is added, where they are not installed.
bool add_game_model(Scene& scene, const std::string& name, int model, const RunningPose& pose);

}  // namespace laterna::app
