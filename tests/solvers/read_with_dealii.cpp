// Reads a mesh file with deal.II and prints what that has found, as a line of JSON: read_with_dealii FILE.
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <fstream>
#include <iostream>
#include <map>
#include <string>

int main(int, char** names) {
  using namespace dealii;
  const std::string name = names[1], ending = name.substr(name.rfind('.'));
  Triangulation<3> mesh;
  GridIn<3> reader(mesh);
  std::ifstream file(name);
  if (ending == ".msh")
    reader.read_msh(file);
  else if (ending == ".vtk")
    reader.read_vtk(file);
  else if (ending == ".inp")
    reader.read_abaqus(file);
  else
    reader.read_unv(file);
  std::map<unsigned, double> volumes, areas;
  for (const auto& cell : mesh.active_cell_iterators()) {
    volumes[cell->material_id()] += cell->measure();
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() != 0) areas[face->boundary_id()] += face->measure();
  }
  const auto print = [](const char* key, const std::map<unsigned, double>& values) {
    std::cout << ", \"" << key << "\": {";
    const char* comma = "";
    for (const auto& [id, value] : values) {
      std::cout << comma << '"' << id << "\": " << value;
      comma = ", ";
    }
    std::cout << '}';
  };
  std::cout.precision(15);
  std::cout << "{\"points\": " << mesh.n_used_vertices() << ", \"tetrahedra\": " << mesh.n_active_cells();
  print("volumes", volumes);
  print("areas", areas);
  std::cout << "}\n";
}
