// The settings that rigs and our glTF extensions share, as the extensions spell them. What is left at its default, or has no
// effect beside the others, is not written.
#pragma once

#include "laterna/scene.h"
#include "scene/gltf_document.h"
#include "scene/rig_frustum.h"

namespace laterna::gltf {

/// A member by its name in rigs.
void set(Json& object, std::string_view rig_name, Json value);
/// Likewise a word.
Json word(std::string_view rig_word);

/// The frustum, in whichever members say it to the last bit: yfov and aspectRatio, with a lensShift, or its four sides.
void set_frustum(Json& object, const Projection& projection, FrustumOf of, bool aspect_from_picture);
/// "left", "right", "bottom" and "top".
Json sides(const Projection& projection);

/// Empty where all is left to the picture.
Json shadow_json(const ShadowSettings& shadow);

}  // namespace laterna::gltf
