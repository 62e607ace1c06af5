// Whether two scenes hold the same, member by member.
#pragma once

#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna::reference {

/// The members that differ in any bit, but for the sign of zeros outside matrices: "lights[1].color", …. Pictures are compared by their pixels,
/// films by their files and timing, lamps by their angles and candela; names of files and warnings do not count.
std::vector<std::string> differences(const Scene& a, const Scene& b);

}  // namespace laterna::reference
