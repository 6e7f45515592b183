// The joined volume as .vtu (see io/vtu_write.cpp), with one part in memory at a time: each array takes a
// pass over the parts.
#include <bit>
#include <string>

#include "holdfast/divide.h"
#include "io/atomic_writer.h"
#include "io/vtk_cells.h"
#include "io/vtu_blocks.h"
#include "io/xml_reader.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace {

class JoinedWriter {
 public:
  JoinedWriter(io::AtomicWriter& out, const Complex& surface, std::size_t parts, const PartLoader& load,
               int interface_marker, const WriteOptions& options)
      : out_(out),
        surface_(surface),
        parts_(parts),
        load_(load),
        marker_(interface_marker),
        appended_(out, options.compress, Threads(options.threads).polling([&out] { step(out.watch()); })) {}

  void run() {
    count();
    write_header();
    write_points();
    if (vertices_ > UINT32_MAX)
      write_corners<std::uint64_t>();
    else
      write_corners<std::uint32_t>();
    write_offsets();
    write_per_cell<std::uint8_t>(static_cast<std::uint8_t>(io::VtkCell::tetrahedron),
                                 static_cast<std::uint8_t>(io::VtkCell::triangle),
                                 static_cast<std::uint8_t>(io::VtkCell::line));
    write_regions();
    write_markers();
    write_per_cell<std::int32_t>(3, 2, 1);
    write_input_vertices();
    if (!common_.vertex_markers.empty()) write_vertex_markers();
    out_ << "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  template <class Visit>
  void for_each_part(Visit&& visit) {
    Joiner joiner(surface_, marker_);
    for (std::size_t k = 0; k < parts_; ++k) {
      const Volume part = load_(k);
      visit(part, joiner.add(part));
    }
    common_ = joiner.surface();
    vertices_ = joiner.vertices();
  }

  void count() {
    for_each_part(
        [&](const Volume& part, const Joiner::Numbered&) { tetrahedra_ += part.tetrahedra.size(); });
    cells_ = tetrahedra_ + common_.facets.size() + common_.segments.size();
    corners_ = 4 * tetrahedra_ + 3 * std::uint64_t{common_.facets.size()} +
               2 * std::uint64_t{common_.segments.size()};
  }

  void array(const char* type, const char* name, std::uint64_t components, std::uint64_t bytes) {
    out_ << "<DataArray type=\"" << type << "\" Name=\"" << name << '"';
    if (components != 1) out_ << " NumberOfComponents=\"" << components << '"';
    out_ << " format=\"appended\" offset=";
    appended_.write_offset(bytes);
    out_ << "/>\n";
  }

  void write_header() {
    const bool wide = vertices_ > UINT32_MAX;
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
         << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
         << "\" header_type=\"UInt64\""
         << (appended_.compresses() ? " compressor=\"vtkZLibDataCompressor\"" : "")
         << ">\n<UnstructuredGrid>\n";
    write_names();
    out_ << "<Piece NumberOfPoints=\"" << vertices_ << "\" NumberOfCells=\"" << cells_ << "\">\n<Points>\n";
    array("Float64", "Points", 3, 3 * sizeof(double) * vertices_);
    out_ << "</Points>\n<Cells>\n";
    array(wide ? "UInt64" : "UInt32", "connectivity", 1, corners_ * (wide ? 8 : 4));
    array("Int64", "offsets", 1, 8 * cells_);
    array("UInt8", "types", 1, cells_);
    out_ << "</Cells>\n<CellData>\n";
    for (const char* name : {"region", "marker", "kind"}) array("Int32", name, 1, 4 * cells_);
    out_ << "</CellData>\n<PointData>\n";
    array("Int64", "input_vertex", 1, 8 * vertices_);
    if (!common_.vertex_markers.empty()) array("Int32", "marker", 1, 4 * vertices_);
    out_ << "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    appended_.begin();
  }

  void write_names() {
    const io::VtkFields fields = io::vtk_fields(common_.names);
    if (fields.empty()) return;
    out_ << "<FieldData>\n";
    for (const auto& [name, values] : fields) {
      out_ << "<DataArray type=\"Int32\" Name=\"" << io::escaped(name)
           << "\" NumberOfComponents=\"2\" NumberOfTuples=\"" << std::uint64_t{values.size()}
           << "\" format=\"ascii\">";
      for (const auto& [id, dimension] : values) out_ << id << ' ' << dimension << ' ';
      out_ << "</DataArray>\n";
    }
    out_ << "</FieldData>\n";
  }

  void write_points() {
    const auto write = [&](const Point& p) {
      for (const double x : p) appended_.put(x);
    };
    for (const Point& p : common_.vertices) write(p);
    for_each_part([&](const Volume& part, const Joiner::Numbered& numbered) {
      for (const Index v : numbered.fresh) write(part.vertices[v]);
    });
  }

  template <class Number>
  void write_corners() {
    for_each_part([&](const Volume& part, const Joiner::Numbered& numbered) {
      for (const Tetrahedron& t : part.tetrahedra)
        for (const Index v : t) appended_.put(static_cast<Number>(numbered.vertices[v]));
    });
    for (const Triangle& t : common_.facets)
      for (const Index v : t) appended_.put(static_cast<Number>(v));
    for (const Segment& s : common_.segments)
      for (const Index v : s) appended_.put(static_cast<Number>(v));
  }

  void write_offsets() {
    std::int64_t end = 0;
    for (std::uint64_t i = 0; i < tetrahedra_; ++i) appended_.put(end += 4);
    for (std::size_t i = 0; i < common_.facets.size(); ++i) appended_.put(end += 3);
    for (std::size_t i = 0; i < common_.segments.size(); ++i) appended_.put(end += 2);
  }

  template <class T>
  void write_per_cell(T of_tetrahedron, T of_facet, T of_segment) {
    for (std::uint64_t i = 0; i < tetrahedra_; ++i) appended_.put(of_tetrahedron);
    for (std::size_t i = 0; i < common_.facets.size(); ++i) appended_.put(of_facet);
    for (std::size_t i = 0; i < common_.segments.size(); ++i) appended_.put(of_segment);
  }

  void write_regions() {
    for (std::size_t k = 0; k < parts_; ++k) {
      const Volume part = load_(k);
      for (std::size_t t = 0; t < part.tetrahedra.size(); ++t)
        appended_.put(std::int32_t{part.regions.empty() ? 0 : part.regions[t]});
    }
    for (std::size_t i = 0; i < common_.facets.size() + common_.segments.size(); ++i)
      appended_.put(std::int32_t{0});
  }

  void write_markers() {
    for (std::uint64_t i = 0; i < tetrahedra_; ++i) appended_.put(std::int32_t{0});
    for (std::size_t i = 0; i < common_.facets.size(); ++i)
      appended_.put(std::int32_t{common_.facet_markers.empty() ? 0 : common_.facet_markers[i]});
    for (std::size_t i = 0; i < common_.segments.size(); ++i)
      appended_.put(std::int32_t{common_.segment_markers.empty() ? 0 : common_.segment_markers[i]});
  }

  void write_input_vertices() {
    for (const std::int64_t v : common_.input_vertices) appended_.put(v);
    for (std::uint64_t v = common_.input_vertices.size(); v < vertices_; ++v) appended_.put(std::int64_t{-1});
  }

  void write_vertex_markers() {
    for (const int marker : common_.vertex_markers) appended_.put(std::int32_t{marker});
    for (std::uint64_t v = common_.vertex_markers.size(); v < vertices_; ++v) appended_.put(std::int32_t{0});
  }

  io::AtomicWriter& out_;
  const Complex& surface_;
  std::size_t parts_;
  const PartLoader& load_;
  int marker_;
  Volume common_;
  std::uint64_t vertices_ = 0, tetrahedra_ = 0, cells_ = 0, corners_ = 0;
  io::VtuAppended appended_;
};

}  // namespace

void write_joined(const std::filesystem::path& path, const Complex& surface, std::size_t parts,
                  const PartLoader& load, int interface_marker, const WriteOptions& options) {
  const FloatEnvironment environment;
  io::Watch watch(options, options.progress);
  io::AtomicWriter out(path, &watch);
  JoinedWriter(out, surface, parts, load, interface_marker, options).run();
  out.commit();
}

}  // namespace holdfast
