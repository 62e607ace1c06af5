// Nodes by their name, as rigs mean them.
#pragma once

#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// For each node, whether it has that name; where none has, whether its mesh does.
std::vector<bool> nodes_called(const Scene& scene, const std::string& name);

/// For each node, whether it or one above it has that name; where no node has, whether its mesh does.
std::vector<bool> select_nodes(const Scene& scene, const std::string& name);

/// What to say where there is none.
std::string no_such_node(const Scene& scene, const std::string& name);

}  // namespace laterna
