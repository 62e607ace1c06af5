// Requests that make no sense.
#pragma once

#include <string>
#include <utility>

#include "laterna/result.h"

namespace laterna {

/// A Failure::bad_usage without a file or place.
inline tl::unexpected<Error> refuse(std::string message) {
  return tl::unexpected(Error(Failure::bad_usage, Diagnostic{{}, {}, std::move(message)}));
}

}  // namespace laterna
