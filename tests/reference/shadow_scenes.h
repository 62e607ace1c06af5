// Generated scenes in which shadows are measured against rays.
#pragma once

#include "reference/shapes.h"

namespace laterna::reference {

Light sun(const std::string& name);
Light spot(const std::string& name, double outer_cone_deg);
/// A scene with the view it is looked at from. The light is named "light".
struct ShadowScene {
  Scene scene;
  View camera;
};

/// A sphere half a metre over a floor, in the sun.
ShadowScene sphere_over_plane(double aspect);
/// A torus leaning over a box on a floor, under a spotlight.
ShadowScene torus_and_box(double aspect);
/// A grove: many thin poles with alpha-cut leaves on a floor, in a low sun.
ShadowScene poles_and_leaves(double aspect);
/// A wall under a ledge of a finely cut round profile, in a sun that grazes the wall and sees strips of the profile
/// thinner than a texel.
ShadowScene moulded_ledge(double aspect);

/// The squared sheet with round holes of which leaves are made: alpha 1 inside a disc, 0 outside, with a soft rim.
int add_leaf_picture(Scene& scene, int side);

}  // namespace laterna::reference
