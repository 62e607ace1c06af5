// A line on the terminal that tells how far a long job is.
#pragma once

#include <functional>
#include <string>

#include "laterna/render.h"

namespace laterna::app {

/// Does nothing unless stderr is a terminal and the job lasts.
Progress progress_line(std::string what);
/// The same of a job of several stages: `what` is asked for the name each time.
Progress progress_line(std::function<std::string()> what);

}  // namespace laterna::app
