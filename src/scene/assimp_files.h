// The files that Assimp reads, watched over: parsers that no longer get anywhere are stopped, devices and pipes are not
// opened, and what became of material libraries is remembered.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <set>
#include <string>

namespace laterna {

struct MaterialLibraries {
  std::set<std::string> missing;
  bool any_was_read = false;
};

class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  explicit AssimpFiles(MaterialLibraries& libraries) : libraries_(libraries) {}

  /// Null when there is no such file. Reading throws std::runtime_error once it goes round in circles.
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  MaterialLibraries& libraries_;
};

}  // namespace laterna
