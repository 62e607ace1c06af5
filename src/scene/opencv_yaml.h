// OpenCV's YAML, as its FileStorage writes it, into JSON that has every value on the same line: what reads the JSON names the
// YAML's lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/fault_list.h"

namespace laterna {

/// Block and flow mappings and sequences, plain and quoted scalars, comments, tags (left out) and document marks. No anchors,
/// no block scalars, no tabs for indentation: reported, with their line.
std::optional<std::string> json_from_opencv_yaml(std::string_view yaml, FaultList& faults);

}  // namespace laterna
