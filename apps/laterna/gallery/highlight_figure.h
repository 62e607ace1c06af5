// The three places where a highlight may be worked out.
#pragma once

namespace laterna::app {

class Sitting;

/// Highlights per vertex, per pixel, and looked up in a specular map, on one coarse ball.
void draw_highlights(Sitting& sitting);

}  // namespace laterna::app
