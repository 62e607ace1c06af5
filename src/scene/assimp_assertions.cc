// Assimp checks its own assumptions in release builds too, and a broken file can break them: Debian's library would
// then end the process. It calls the function below through the dynamic linker, which finds ours first; the exception
// is caught where the import began, and the file is refused like any other that cannot be read.
#include <fmt/format.h>

#include <stdexcept>

namespace Assimp {

// The library's own name and signature.
void aiAssertViolation(const char* expression, const char* file, int line);

void aiAssertViolation(const char* expression, const char* file, int line) {
  throw std::runtime_error(fmt::format("{}:{}: {} does not hold", file, line, expression));
}

}  // namespace Assimp
