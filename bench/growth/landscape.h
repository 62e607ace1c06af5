// The scene of the growth tables, built in code: hills that fill the picture, lit by slide projectors all round. Each
// of its numbers can grow by itself: the others keep the pixels, the lights per pixel and the depth complexity as they
// are.
#pragma once

#include "laterna/render.h"

namespace laterna::growth {

struct Landscape {
  int triangles = 300'000;
  int lights = 1;       ///< each lights all of the hills and casts shadows
  int map_size = 1024;  ///< of each light's shadow map
};

Scene make_scene(const Landscape& landscape);
View make_view(double aspect);

}  // namespace laterna::growth
