// Scenes to files: glTF 2.0, with what glTF has no words for in extensions that other programs pass over.
// docs/LATERNA_projector.md, docs/LATERNA_lighting.md
#pragma once

#include <filesystem>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

struct SceneWriteOptions {
  /// .gltf: geometry, pictures and lamps inside the file too, as a .glb has them. Otherwise they lie beside it: "stage.bin",
  /// "stage.lake.png", "stage.lamp1.ies"; pictures that are in its folder already, or below, stay where they are.
  bool embeds = false;
};

/// Writes the scene as glTF 2.0, by the ending of `file`: .glb or .gltf. load_scene() reads the same scene from it: geometry,
/// matrices and settings bit for bit, pictures in the bytes of their own files where these are PNG or JPEG. A projector is a
/// spot with LATERNA_projector, measured lamps are LM-63 files by EXT_lights_ies; films are named, relative to `file`, and
/// stay where they are. Clips go along, numbers of their keys in single precision (docs/animation.md). Each file is written beside its target and renamed into place, the scene last. The bytes depend on
/// nothing but the scene and the files' names.
///
/// Gives what could not be carried, or not exactly: a light's own function of attenuation, photographs, pictures that no PNG
/// can hold. Nodes come back parents first, each followed by what is below it, and what no node refers to is left out.
/// Errors: bad_usage for another ending or a scene that validate() refuses, bad_input for a picture that cannot be read,
/// cannot_write.
Result<std::vector<Diagnostic>> write_scene(const Scene& scene, const std::filesystem::path& file,
                                            const SceneWriteOptions& options = {});

/// Whether write_scene() could write such a file, to ask before a long load: errors are write_scene()'s.
Result<void> check_scene_output(const std::filesystem::path& file);

}  // namespace laterna
