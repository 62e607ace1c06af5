// How the library reports what went wrong. No function of the library throws to its caller, exits, asserts on
// user input, or silently clamps it: it returns a Result.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace laterna {

/// One finding, tied to a place the user can open.
struct Diagnostic {
  std::string file;     ///< as the user named it; empty for scenes built in code
  std::string place;    ///< JSON path ("accessors[3].count"), "line 12", "byte 20", or empty
  std::string message;  ///< what was expected and what was found

  bool operator==(const Diagnostic&) const = default;
};

/// "file: place: message", leaving out the parts that are empty.
std::string to_string(const Diagnostic& diagnostic);

/// The class of a failure; its number is the exit code of the command line.
enum class Failure : int {
  bad_usage = 2,     ///< the request itself makes no sense
  bad_input = 3,     ///< a file or scene does not hold what it must
  cannot_write = 4,  ///< an output could not be written
  cancelled = 5,     ///< the caller's progress callback asked to stop
};

/// Why a call gave no value: one class and at least one diagnostic, in the order found.
struct Error {
  Failure failure = Failure::bad_input;
  std::vector<Diagnostic> diagnostics;

  Error() = default;
  Error(Failure what, Diagnostic diagnostic) : failure(what), diagnostics{std::move(diagnostic)} {}
  Error(Failure what, std::vector<Diagnostic> all) : failure(what), diagnostics(std::move(all)) {}
};

/// All diagnostics of an error, one per line.
std::string to_string(const Error& error);

template <class T>
using Result = tl::expected<T, Error>;

}  // namespace laterna
