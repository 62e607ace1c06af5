#include "laterna/result.h"

namespace laterna {

std::string to_string(const Diagnostic& diagnostic) {
  std::string text;
  for (const std::string& part : {diagnostic.file, diagnostic.place}) {
    if (!part.empty()) text += part + ": ";
  }
  return text + diagnostic.message;
}

std::string to_string(const Error& error) {
  std::string text;
  for (const Diagnostic& diagnostic : error.diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(diagnostic);
  }
  return text;
}

}  // namespace laterna
