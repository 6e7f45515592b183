// Runs TetGen's library on a .node file: prints its own time of the Delaunay triangulation. A separate
// program, because memory must be ready after the file is read.
#include <tetgen.h>

#include <iostream>
#include <string>

#include "ready_memory.h"

int main(int count, char** arguments) {
  tetgenio in, out;
  std::string base = count == 2 ? arguments[1] : "";
  if (const std::size_t dot = base.rfind(".node"); dot != std::string::npos) base.resize(dot);
  if (base.empty() || !in.load_node(base.data())) {
    std::cerr << "usage: tetgen_delaunay FILE.node\n";
    return 2;
  }
  ready_memory(kReadyMemory);
  std::string options = "NEF";
  tetrahedralize(options.data(), &in, &out);
  return 0;
}
