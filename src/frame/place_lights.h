// Lights and cameras at the places their nodes give them.
#pragma once

#include "frame/frame.h"
#include "scene/light_flux.h"

namespace laterna::frame {

/// Fills the frame's lights (enabled ones) and cameras, in node order, and the tables of its lamps.
void place_lights_and_cameras(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                              Frame& frame);

/// The projectors whose slides layers of surfaces show: indices into the scene's lights, each once, in order.
std::vector<int> decal_lights(const Scene& scene);
/// Fills Frame::decals with these, enabled or not.
void place_decals(const Scene& scene, const std::vector<glm::dmat4>& world_from_node, Frame& frame);

/// How a projector's intensity depends on the direction: an intensity map holds candela per direction by itself
/// (row 16), whatever the profile says.
BeamProfile beam_profile(const Light& light);

/// candela_from_lumens() for a picture that is thrown through a distorting lens. Distortion moves the slide's points; it changes neither
/// a flat field's illuminance nor uniform candela.
double candela_from_lumens(double lumens, const SlideLens& lens, BeamProfile profile);

/// ∫ of an intensity map over the directions of its frame, in steradians: lumens per candela at value 1. Of a coloured
/// map its Rec. 709 luminance counts.
double solid_angle_of_map(const image::MipChain& map, const Projection& projection);

}  // namespace laterna::frame
