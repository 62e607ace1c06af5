// Films out: the part of the plug-in that writes.
#pragma once

#include "image/video_interface.h"

namespace laterna_ffmpeg {

/// Fills in the calls that write films.
void add_output(LaternaVideoPlugin& plugin);

}  // namespace laterna_ffmpeg
