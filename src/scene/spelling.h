// Words in messages: names quoted safely, and the word that was probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace laterna {

/// "name" with its quotes; control characters become '?', and what is long is cut at a character's end.
std::string in_quotes(std::string_view name);

/// The same for a path, which is never cut: it is what the user must look at.
std::string path_in_quotes(std::string_view path);

/// The known word nearest to `word`, or an empty view when none is near enough to be a slip of the hand.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// " (did you mean "lux"?)" or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace laterna
