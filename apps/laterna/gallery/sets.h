// Scenes that several figures are drawn from.
#pragma once

#include "sitting.h"

namespace laterna::app {

/// A glazed teapot on a tiled floor, before the camera, without lights.
Shot teapot_set();
/// Solids on a tiled floor, of which some stand in each other's light, without lights: ring, ball on a plinth, urn, teapot.
Shot solids_set();
/// What they are lit by: "sun" from the left.
Light& add_morning_sun(Scene& scene);
/// "left" and "right", two lamps of different colours that reach all of solids_set().
void add_two_lamps(Scene& scene);

/// What walkers walk on.
enum class Ground { plane, hills };
/// One of those that walk, on the ground: models of a game where Debian's assimp-testmodels are installed (game_models.h),
/// else mannequins in coats of many colours. `number`: each looks different, as far as there are different ones.
void add_walker(Scene& scene, const std::string& name, int number, glm::vec3 foot, float turn);
/// Four of them, without lights. They walk behind each other as seen from add_morning_sun().
Shot parade_set(Ground ground);

/// A fence and a ball on a floor, lit by "sun" from behind the fence.
Shot fence_set();

}  // namespace laterna::app
