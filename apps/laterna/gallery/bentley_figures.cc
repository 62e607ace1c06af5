// Bentley, Two shadow rendering algorithms, 1995 (document 004).
#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "laterna/bake.h"
#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

void draw_floating(Sitting& sitting) {
  Shot shot = teapot_set();
  add_morning_sun(shot.scene);
  sitting.picture("No shadow: does it stand, or float?", shot.with(ShadowTechnique::none));
  sitting.picture("With its shadow it stands on the tiles.", shot.with(ShadowTechnique::ground));
  // Nearer to the eye and smaller by the same factor, everything but its shadow stays where it was in the picture.
  scale_about(shot.scene.meshes.back().primitives.front(), glm::vec3(shot.camera.from), 0.72F);
  sitting.picture(
      "Another teapot, smaller and nearer to the eye: without a shadow it could not be told from the first.",
      shot.with(ShadowTechnique::ground));
}

/// Solids whose shadows meet the floor only.
Shot ring_and_urn() {
  Shot shot = teapot_set();
  add_object(shot.scene, "ring", ring({-0.75F, 0.33F, -0.55F}, {0.5F, 0.1F, 1}, 0.26F, 0.07F),
             add_material(shot.scene, "clay", {0.62F, 0.24F, 0.12F}));
  shot.camera = {{0.6, 2.0, 3.1}, {-0.1, 0.15, -0.25}};
  return shot;
}

void draw_ground(Sitting& sitting) {
  Shot two = ring_and_urn();
  add_sun(two.scene, "warm", {{-3, 4, 2.2}, {0, 0, 0}}, {0.62F, 0.48F, 0.36F});
  add_sun(two.scene, "cool", {{3.4, 3.6, 1.2}, {0, 0, 0}}, {0.30F, 0.40F, 0.52F});
  sitting.picture("Two lights at infinity: every shadow is an affine image of its caster.",
                  two.with(ShadowTechnique::ground));
  Shot local = ring_and_urn();
  add_lamp(local.scene, "lamp", {{-0.9, 1.7, 0.9}, {-0.2, 0, -0.3}}, Angle::degrees(65),
           {0.95F, 0.90F, 0.80F});
  sitting.picture("A local light: shadows spread, and grow with the distance from it.",
                  local.with(ShadowTechnique::ground));
}

void draw_planes(Sitting& sitting) {
  Shot shot = solids_set();
  add_object(shot.scene, "wall", rectangle({0, 1.5F, -1.3F}, {1, 0, 0}, {0, 1, 0}, {8, 3}, 1),
             add_material(shot.scene, "whitewash", glm::vec3(0.8F)));
  const int boards =
      add_material(shot.scene, "ramp", glm::vec3(1), add_picture(shot.scene, "ramp", paint_boards(256)));
  add_object(shot.scene, "ramp",
             rectangle({0.55F, 0.3F, 0.45F}, {0.8F, 0.6F, 0}, {0, 0, -1}, {1.0F, 1.1F}, 1), boards);
  add_sun(shot.scene, "sun", {{-3.0, 2.4, 2.4}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  sitting.picture("The floor alone, which is found without being named.", shot.with(ShadowTechnique::ground));
  const ShadowPlane floor{{0, 1, 0}, 0};
  const ShadowPlane wall{{0, 0, 1}, -1.3};
  const ShadowPlane ramp{{-0.6, 0.8, 0}, -0.09};
  shot.scene.lights.front().shadow.planes = {floor, wall, ramp};
  sitting.picture("Floor, wall and ramp: one matrix for each.", shot.with(ShadowTechnique::ground));
  sitting.picture("Traced rays.", shot.with(ShadowTechnique::raytraced));
}

/// A mast that is higher than the lamp beside it.
Shot mast_and_lamp() {
  Shot shot = teapot_set();
  const int paint = add_material(shot.scene, "paint", {0.62F, 0.24F, 0.12F});
  add_object(shot.scene, "mast", box({-0.75F, 0, -0.65F}, {-0.69F, 1.5F, -0.59F}), paint);
  add_object(shot.scene, "yard", box({-1.15F, 1.1F, -0.645F}, {-0.29F, 1.14F, -0.595F}), paint);
  Light& lamp = add_lamp(shot.scene, "lamp", {{-0.45, 0.8, 0.35}, {-0.45, 0, 0.35}}, Angle::degrees(89),
                         {0.95F, 0.90F, 0.80F});
  lamp.inner_cone = Angle::degrees(88);
  shot.camera = {{0.9, 2.1, 3.4}, {-0.2, 0.35, -0.2}};
  return shot;
}

void draw_above_the_lamp(Sitting& sitting) {
  const Shot shot = mast_and_lamp();
  sitting.picture("The ground transformation: no ghost.", shot.with(ShadowTechnique::ground));
  sitting.picture("Traced rays.", shot.with(ShadowTechnique::raytraced));
}

void draw_anything(Sitting& sitting) {
  Shot shot = solids_set();
  add_morning_sun(shot.scene);
  sitting.picture("Ground shadows: nothing falls on the plinth, the ring or the teapot.",
                  shot.with(ShadowTechnique::ground));
  sitting.picture("Shadow z-buffer: shadows on everything, of everything.", shot.with(ShadowTechnique::map));
}

void draw_light_views(Sitting& sitting) {
  Shot shot = solids_set();
  add_two_lamps(shot.scene);
  for (const char* light : {"left", "right"}) {
    const std::string name = light;
    sitting.light_view("The scene as the " + name + " lamp sees it: its own shadows it cannot see.", shot,
                       name);
    sitting.depth_map("All that is kept of that view: depth. Near is light, far is dark.", shot, name);
  }
  sitting.picture("The scene from the eye, each point looked up in both.", shot);
}

/// A ring and a teapot with textures, close enough to see them shadow themselves.
Shot textured_ring() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.22F);
  add_floor(scene);
  const int boards =
      add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(256)));
  const int coat = add_material(scene, "coat", glm::vec3(1), add_picture(scene, "coat", paint_coat(256)));
  add_object(scene, "ring", ring({-0.4F, 0.61F, 0}, {0.4F, 0.05F, 0.95F}, 0.45F, 0.16F), boards);
  add_object(scene, "teapot", teapot({0.75F, 0, -0.25F}), coat);
  add_sun(scene, "sun", {{-3.4, 2.5, 2.2}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  shot.camera = {{0.75, 1.75, 2.6}, {0.16, 0.36, -0.05}};
  return shot;
}

void draw_textured(Sitting& sitting) {
  const Shot shot = textured_ring();
  sitting.picture("No shadows: light passes through everything.", shot.with(ShadowTechnique::none));
  sitting.picture("Textured surfaces shadow the floor, each other and themselves.", shot);
}

void draw_fudge(Sitting& sitting) {
  Shot shot = textured_ring();
  ShadowSettings& shadow = shot.scene.lights.front().shadow;
  shadow.resolution = 256;
  shadow.filter = ShadowFilter::nearest;
  shadow.constant_bias = 0.0;
  shadow.slope_bias = 0.0;
  sitting.picture("Fudge factor 0: surfaces shadow themselves, in stripes.", shot);
  shadow.constant_bias = 0.05;
  sitting.picture("5 cm: most of the stripes are gone.", shot);
  shadow.constant_bias = 0.25;
  sitting.picture("25 cm: so are shadows near what throws them.", shot);
  shadow.constant_bias.reset();
  shadow.slope_bias.reset();
  sitting.picture("The same map, its fudge factor found from each surface's slope and texel.", shot);
}

/// Light maps of all that lamps throw and surfaces reflect, instead of lamps and ambient light.
void draw_radiosity(Sitting& sitting, Shot shot) {
  shot.scene.ambient = glm::vec3(0);
  BakeSettings settings;
  settings.density = std::max(2.0, 16 * sitting.scale());
  settings.interreflection = RadiositySettings{.rays = 64};
  std::optional<BakedScene> baked = sitting.accept(bake_light(std::move(shot.scene), settings));
  if (!baked) return;
  shot.scene = std::move(baked->scene);
  sitting.picture("Radiosity: no ambient light, but what surfaces reflect onto each other.",
                  shot.with(ShadowTechnique::none));
}

void draw_families(Sitting& sitting) {
  Shot shot = solids_set();
  add_two_lamps(shot.scene);
  sitting.picture("Shadow polygons on the ground.", shot.with(ShadowTechnique::ground));
  sitting.picture("Shadow z-buffer.", shot.with(ShadowTechnique::map));
  sitting.picture("Rays from points to the lights.", shot.with(ShadowTechnique::raytraced));
  sitting.picture("Shadow volumes.", shot.with(ShadowTechnique::volume));
  sitting.picture("Projected silhouettes, the technique of Chen and Tung, for comparison.",
                  shot.with(ShadowTechnique::silhouette));
  draw_radiosity(sitting, std::move(shot));
}

constexpr Figure kFigures[] = {
    {"floating", "An object that floats, and one that is grounded",
     "Bentley, \"Object rendered with no shadow, appears to float above plane\"",
     "A shadow says where a thing is. Without one, two teapots of different sizes at different places give "
     "the same "
     "picture; their shadows tell them apart.",
     "",
     "laterna render teapot.glb --shadows none -o floating.png\nlaterna render teapot.glb --shadows ground "
     "-o grounded.png",
     draw_floating},
    {"ground-lights", "The ground transformation: two lights at infinity, and a local one",
     "Bentley, \"Shadows using 'ground transformation'\", cases 1 and 2",
     "One matrix per light carries every triangle to the plane. Where two shadows meet, each light is "
     "missing once: the "
     "overlap is darker, and no pixel is darkened twice by one light.",
     "Only the plane is shadowed: see the figures after it.",
     "laterna render scene.glb --rig lights.json --shadows ground -o ground.png", draw_ground},
    {"ground-planes", "Several grounds", "Bentley, \"z = 0 plane\", for any plane and several at once",
     "The matrix takes any plane, so a wall and a ramp are grounds too, if they are named. Shadows end "
     "where their "
     "receiver ends.",
     "What stands behind a receiver is not hidden by it: floor and wall are dark also where ramp or plinth "
     "have caught the "
     "light before.",
     "\"shadow\": {\"technique\": \"ground\", \"planes\": [{\"normal\": [0, 1, 0], \"distance\": 0}, "
     "{\"normal\": [0, 0, 1], \"distance\": -1.3}]}",
     draw_planes},
    {"above-the-lamp", "Corners above a local light", "Bentley, case 2: a local light",
     "The mast's top and its yard are higher than the lamp: the matrix alone would throw them, mirrored, on "
     "the floor on "
     "the other side of the lamp. Laterna keeps the sign of the fourth coordinate, and such corners throw "
     "nothing.",
     "Only the floor is shadowed: of what the teapot and the mast throw on themselves, the rays show more.",
     "laterna render scene.glb --rig lamp.json --shadows ground -o ground.png", draw_above_the_lamp},
    {"not-only-the-ground", "The z-buffer algorithm shadows not only the ground",
     "Bentley, \"The Z-buffer algorithm produces shadows not only on z = 0 plane\"",
     "The same scene and sun both ways. On the floor the two agree.",
     "Ground polygons cannot shadow objects, and throw shadows on the floor even under what has already "
     "caught them: "
     "Bentley says so, and it is true here.",
     "laterna render scene.glb --shadows ground -o ground.png\nlaterna render scene.glb --shadows map -o "
     "map.png",
     draw_anything},
    {"light-views", "What the lights see", "Bentley, \"Object as viewed from light #1\" and \"#2\"",
     "The scene is drawn once from each lamp, for its depths alone; whatever a lamp does not see is in its "
     "shadow.",
     "One map for each light: memory grows with their number.",
     "laterna render scene.glb --rig lamps.json --from-light left -o from-left.png\n"
     "laterna depthmap scene.glb --rig lamps.json --light left -o depth-left.png",
     draw_light_views},
    {"textured", "Textures, and surfaces that shadow themselves",
     "Bentley, \"Shadowing of texture mapped objects\" and \"Visible surfaces shadowing themselves\"",
     "The hole of the ring, the teapot's handle and spout throw shadows on the surfaces they belong to, and "
     "the pattern "
     "shows through.",
     "", "laterna render scene.glb -o textured.png", draw_textured},
    {"fudge-factor", "The fudge factor", "Bentley, on points \"shadowing themselves\"",
     "A map of 256 texels read at the nearest one, with growing distances that points may lie behind what "
     "the map holds.",
     "No constant serves every slope: what removes the last stripe has already detached shadows from their "
     "casters. "
     "Laterna's default needs none: it predicts each texel's depth on the receiver's own plane.",
     "\"shadow\": {\"resolution\": 256, \"filter\": \"nearest\", \"constant_bias\": 0.05, \"slope_bias\": 0}",
     draw_fudge},
    {"families", "The families of shadow algorithms", "Bentley, the list of methods",
     "Bentley's methods on one scene with two lamps. Radiosity alone follows light from surface to surface: "
     "where the others add the same ambient light everywhere, undersides are lit by the tiles below them, "
     "and "
     "creases are dark.",
     "Ground polygons reach only the floor, and silhouettes know no depth within an object, so nothing "
     "shadows itself; "
     "the next three agree but for pixels at edges. Radiosity knows matt surfaces only, and shadows are as "
     "sharp as luxels are small.",
     "laterna render scene.glb --rig lamps.json --shadows map -o map.png\n"
     "and so on with ground, raytraced, volume and silhouette\n"
     "laterna bake scene.glb --rig lamps.json --bounces 100 -o baked.glb\n"
     "laterna render baked.glb -o radiosity.png",
     draw_families},
};

}  // namespace

Chapter bentley_chapter() {
  return {"Bentley: Two Shadow Rendering Algorithms, 1995",
          "Ground polygons against the shadow z-buffer, and a list of the other ways.", kFigures};
}

}  // namespace laterna::app
