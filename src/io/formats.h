// The readers and writers, one pair per format, and the table that finds them by extension.
#pragma once

#include <span>

#include "io/atomic_writer.h"
#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_off(const Source& source);
[[nodiscard]] MeshData read_stl(const Source& source);
[[nodiscard]] MeshData read_obj(const Source& source);
[[nodiscard]] MeshData read_ply(const Source& source);
[[nodiscard]] MeshData read_3mf(const Source& source);
[[nodiscard]] MeshData read_amf(const Source& source);
/// glTF and its binary form, with the buffers that the file names.
[[nodiscard]] MeshData read_gltf(const Source& source);
/// The file and the files of its buffers; only the file itself if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path);
/// GOCAD's TSurf, PLine and VSet.
[[nodiscard]] MeshData read_gocad(const Source& source);
/// COLLADA.
[[nodiscard]] MeshData read_dae(const Source& source);
/// Faces of AutoCAD's DXF.
[[nodiscard]] MeshData read_dxf(const Source& source);
/// Of the GNU Triangulated Surface library.
[[nodiscard]] MeshData read_gts(const Source& source);
[[nodiscard]] MeshData read_poly(const Source& source);
[[nodiscard]] MeshData read_smesh(const Source& source);
/// A .node file: its vertices; with .face and .edge if the .ele beside it has no tetrahedra.
[[nodiscard]] MeshData read_node(const Source& source);
[[nodiscard]] MeshData read_xyz(const Source& source);
/// The .node, .ele, .face and .edge files beside the source. The source's own bytes are not used.
[[nodiscard]] MeshData read_tetgen_volume(const Source& source);
[[nodiscard]] MeshData read_medit(const Source& source);

[[nodiscard]] MeshData read_gmf(const Source& source);
/// Numbers at the vertices of a mesh that is in another file.
struct GmfSolution {
  std::size_t vertices = 0;
  std::size_t columns = 0;     ///< 1: scalars, 6: symmetric tensors
  std::vector<double> values;  ///< of all columns, vertex by vertex
};
/// The single scalar or symmetric tensor per vertex in a .solb file.
[[nodiscard]] GmfSolution read_gmf_solution(const Source& source);
/// Gmsh's .msh, Fluent's, or one of CalculiX.
[[nodiscard]] MeshData read_msh(const Source& source);
[[nodiscard]] MeshData read_msh_surface(const Source& source);
[[nodiscard]] MeshData read_vtk(const Source& source);
/// Also reads NAME_surface.vtu if the file says that it exists.
[[nodiscard]] MeshData read_vtu(const Source& source);
/// Numbers at the points of a grid; the components of each point are adjacent.
struct PointArray {
  std::size_t components = 1;
  std::vector<double> values;
};
/// The same; `array` gets the first of these point arrays that exists. Throws FileError if there is none.
[[nodiscard]] MeshData read_vtu(const Source& source, std::span<const char* const> names, PointArray& array);

void write_medit(AtomicWriter& out, const Volume& volume);
void write_msh(AtomicWriter& out, const Volume& volume, const WriteOptions& options);
[[nodiscard]] std::vector<Remark> not_in_msh(const Volume& volume, const WriteOptions& options);
/// .inp of Abaqus and CalculiX, or UCD, which begins with a number.
[[nodiscard]] MeshData read_inp(const Source& source);
/// The file and the files it includes; only the file itself if they cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> inp_files(const std::filesystem::path& path);
[[nodiscard]] MeshData read_avs(const Source& source);
/// Whether the first word after comments is a number: no keyword of an .inp file is.
[[nodiscard]] bool is_avs(std::string_view bytes);
void write_inp(AtomicWriter& out, const Volume& volume, const WriteOptions& options);
[[nodiscard]] std::vector<Remark> not_in_inp(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_unv(const Source& source);
void write_unv(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_unv(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_su2(const Source& source);
void write_su2(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_su2(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_mfem(const Source& source);
void write_mfem(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_mfem(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_vol(const Source& source);
void write_vol(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_vol(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_bdf(const Source& source);
/// Throws std::invalid_argument if there are more nodes or elements than eight digits can number.
void write_bdf(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_bdf(const Volume& volume, const WriteOptions& options);
/// A number in at most 16 characters, as precise as they allow.
[[nodiscard]] std::string nastran_real(double value);
/// The double of this number; infinite if rounding up leaves the range.
[[nodiscard]] double nastran_rounded(double value);
/// Writes .node, .ele, .face and .edge beside `path`.
void write_tetgen(const std::filesystem::path& path, const Volume& volume, Watch* watch = nullptr);
void write_gmf(AtomicWriter& out, const Volume& volume);
void write_vtk(AtomicWriter& out, const Volume& volume);
/// Writes NAME.vtu, and the boundary of the tetrahedra to NAME_surface.vtu beside it if that is possible.
void write_vtu(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
               Watch& watch);
/// Writes both files, and NAME.vtm, which names them as blocks.
void write_vtm(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
               Watch& watch);
/// Also reads the .h5 files that the file names, and NAME_surface.xdmf if the file says that it exists.
[[nodiscard]] MeshData read_xdmf(const Source& source);
/// Writes NAME.xdmf and NAME_surface.xdmf, each with its arrays in an .h5 file of the same name.
void write_xdmf(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                Watch& watch);
[[nodiscard]] std::vector<Remark> not_in_xdmf(const Volume& volume, const WriteOptions& options);
[[nodiscard]] MeshData read_med(const Source& source);
void write_med(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_med(const Volume& volume, const WriteOptions& options);
/// CGNS in HDF5.
[[nodiscard]] MeshData read_cgns(const Source& source);
void write_cgns(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_cgns(const Volume& volume, const WriteOptions& options);
/// Ansys Fluent's .msh and .cas. Read as a surface, the cells may be any polyhedra.
[[nodiscard]] MeshData read_fluent(const Source& source);
[[nodiscard]] MeshData read_fluent_surface(const Source& source);
/// Throws std::invalid_argument if a face has more than two tetrahedra.
void write_fluent(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                  Watch& watch);
[[nodiscard]] std::vector<Remark> not_in_fluent(const Volume& volume, const WriteOptions& options);
/// LS-DYNA's keyword files.
[[nodiscard]] MeshData read_dyna(const Source& source);
/// The file and the files it includes; only the file itself if they cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> dyna_files(const std::filesystem::path& path);
/// Throws std::invalid_argument if there are more nodes or elements than eight digits can number.
void write_dyna(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_dyna(const Volume& volume, const WriteOptions& options);
/// Ansys MAPDL's archives.
[[nodiscard]] MeshData read_cdb(const Source& source);
/// Throws std::invalid_argument if there are more nodes or elements than eight digits can number.
void write_cdb(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_cdb(const Volume& volume, const WriteOptions& options);
/// FEBio's models.
[[nodiscard]] MeshData read_febio(const Source& source);
void write_febio(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_febio(const Volume& volume, const WriteOptions& options);
/// Legacy DOLFIN's XML.
[[nodiscard]] MeshData read_dolfin(const Source& source);
void write_dolfin(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_dolfin(const Volume& volume, const WriteOptions& options);
/// EnSight Gold: the geometry that a case names.
[[nodiscard]] MeshData read_ensight(const Source& source);
/// The case and its geometry; only the case if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> ensight_files(const std::filesystem::path& path);
/// Exodus II.
[[nodiscard]] MeshData read_exodus(const Source& source);
/// Throws std::invalid_argument if an array is longer than the format's version 2 can say.
void write_exodus(AtomicWriter& out, const Volume& volume);
[[nodiscard]] std::vector<Remark> not_in_exodus(const Volume& volume, const WriteOptions& options);
/// Reads the folder that the source names; the source has no bytes of its own.
[[nodiscard]] MeshData read_openfoam(const Source& source);
/// Writes OpenFOAM's polyMesh into a folder, which is created if necessary.
void write_openfoam(const std::filesystem::path& folder, const Volume& volume, const WriteOptions& options,
                    Watch& watch);
[[nodiscard]] std::vector<Remark> not_in_openfoam(const Volume& volume, const WriteOptions& options);
/// Whether a path names a folder polyMesh or a case that contains one; this determines the format, as an
/// extension does.
[[nodiscard]] bool is_poly_mesh(const std::filesystem::path& path);
/// The polyMesh folder that a path names: the path itself, or constant/polyMesh in the case.
[[nodiscard]] std::filesystem::path poly_mesh_of(const std::filesystem::path& path);
/// The files of the polyMesh, as they are written.
[[nodiscard]] std::vector<std::filesystem::path> openfoam_files(const std::filesystem::path& path);
[[nodiscard]] MeshData read_vtm(const Source& source);
/// .pvtu or .pvtp: joins the pieces that the file names.
[[nodiscard]] MeshData read_pvtu(const Source& source);
/// The file, its pieces and the files beside these; only the file itself if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> pvtu_files(const std::filesystem::path& path);
/// The parts of the first time step that a .pvd file lists.
[[nodiscard]] MeshData read_pvd(const Source& source);
/// The file, its parts and theirs; only the file itself if it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> pvd_files(const std::filesystem::path& path);
/// NAME_surface with the same ending.
[[nodiscard]] std::filesystem::path surface_beside(const std::filesystem::path& path);
[[nodiscard]] std::filesystem::path with_ending(const std::filesystem::path& path, const char* ending);
/// Whether a path names a file or nothing yet: such a path can have other files beside it, unlike a pipe.
[[nodiscard]] bool can_have_a_file_beside(const std::filesystem::path& path);

/// Parses bytes in the format of an extension such as ".off", or by default of the path's own. Throws
/// FileError.
[[nodiscard]] MeshData parse_surface(const Source& source, std::string_view format = {});
[[nodiscard]] MeshData parse_volume(const Source& source, std::string_view format = {});

/// A surface as a volume without tetrahedra, for writers of volumes. Seeds are left out.
[[nodiscard]] Volume as_volume(const Surface& surface);

}  // namespace holdfast::io
