#include "scene/setting_names.h"

#include <array>

namespace laterna {
namespace {

// Where glTF 2.0 or its extensions have a word for a thing, it is theirs; the rest is in their style. No name on the right
// may stand on the left too: spelling is done once or twice and must come to the same.
constexpr std::array kPairs = std::to_array<SettingNames::Pair>({
    // Frustums.
    {"yfov_deg", "yfov"},
    {"hfov_deg", "xfov"},
    {"throw_ratio", "throwRatio"},
    {"focal_length_mm", "focalLength"},
    {"sensor_mm", "sensorSize"},
    {"aspect", "aspectRatio"},
    {"aspect_from_slide", "aspectFromSlide"},
    {"aspect_from_picture", "aspectFromPicture"},
    {"near", "znear"},
    {"far", "zfar"},
    {"lens_shift", "lensShift"},
    // Lights.
    {"color_temperature", "colorTemperature"},
    {"lux", "intensity"},
    {"candela", "intensity"},
    {"scale", "intensity"},
    {"lumens", "luminousFlux"},
    {"inner_cone_deg", "innerConeAngle"},
    {"outer_cone_deg", "outerConeAngle"},
    {"half_width", "halfWidth"},
    {"half_height", "halfHeight"},
    {"angular_diameter_deg", "angularDiameter"},
    {"inverse_square", "inverseSquare"},
    {"gltf_windowed", "gltfWindowed"},
    // Projectors.
    {"slide", "texture"},
    {"intensity_map", "intensityMap"},
    {"flat_field", "flatField"},
    {"uniform_candela", "uniformCandela"},
    {"black_level", "blackLevel"},
    {"aperture_radius", "apertureRadius"},
    {"focus", "focusDistance"},
    {"fps", "framesPerSecond"},
    {"at_end", "atEnd"},
    {"reverse_subtract", "reverseSubtract"},
    {"ping_pong", "pingPong"},
    // Shadows.
    {"percentage_closer", "percentageCloser"},
    {"averaged_depths", "averagedDepths"},
    {"constant_bias", "constantBias"},
    {"slope_bias", "slopeBias"},
    {"caster_faces", "casterFaces"},
    {"back_only", "backOnly"},
    {"soft_edge", "softEdge"},
    {"bleeding_reduction", "bleedingReduction"},
    {"smooth_kernel", "smoothKernel"},
    {"eight_neighbours", "eightNeighbours"},
    {"split_lambda", "splitLambda"},
    {"cascade_distance", "cascadeDistance"},
    {"light_space_perspective", "lightSpacePerspective"},
    {"dual_paraboloid", "dualParaboloid"},
    // Reliefs.
    {"self_shadow", "selfShadow"},
    {"cut_edges", "cutEdges"},
    // Mirrors.
    {"phase_deg", "phase"},
    {"attenuation_color", "attenuationColor"},
    {"attenuation_distance", "attenuationDistance"},
    // Nodes.
    {"casts_shadow", "castsShadow"},
    {"receives_shadow", "receivesShadow"},
});

}  // namespace

const SettingNames kGltfNames{kPairs, true};

}  // namespace laterna
