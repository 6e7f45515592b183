// SU2's native meshes (SU2 documentation, "Mesh file"): tetrahedra, and triangles of the boundary by markers;
// in two dimensions triangles, and segments of the boundary.
#include <algorithm>

#include "io/cells.h"
#include "io/fields.h"
#include "io/polygon.h"
#include "io/solver_text.h"
#include "io/two_dimensions.h"

namespace holdfast::io {
namespace {

constexpr NameRule kSu2Names{128, "_-."};
constexpr int kSu2Line = 3, kSu2Triangle = 5, kSu2Quadrangle = 9, kSu2Tetrahedron = 10, kSu2Hexahedron = 12,
              kSu2Prism = 13, kSu2Pyramid = 14;

class Su2Reader {
 public:
  explicit Su2Reader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    // Nodes may follow the elements that name them, so their number is found first.
    find_points();
    while (next()) read_section();
    if (dimension_ == 0) text_.fail("there is no NDIME=, so this is no SU2 mesh");
    if (mesh_.vertices.size() != points_) text_.fail("there are other than NPOIN= points");
    add_what_is_cut();
    mesh_.leave_out(skipped_, "sections of other kinds", "section of another kind");
    (dimension_ == 2 ? mesh_.names.segments : mesh_.names.facets) = names_->take();
    return std::move(mesh_);
  }

 private:
  bool next() {
    while (!text_.remaining().empty()) {
      beat(text_.source().watch);
      const std::string_view line = text_.rest_of_line();
      const std::size_t mark = line.find('%');
      if (mark != std::string_view::npos) read_id_comment(line.substr(mark + 1), std::array{&*names_});
      line_ = trimmed(line.substr(0, mark));
      if (!line_.empty()) return true;
    }
    line_ = {};
    return false;
  }

  void find_points() {
    while (next()) {
      const auto [key, value] = pair();
      if (key == "ndime" && value == "2") names_.emplace(kSegmentStem);
      if (key != "npoin") continue;
      points_ = count(value, 4);
      break;
    }
    text_.seek(0);
  }

  /// "KEY= value", with the key in lower case; the key is empty if there is none.
  [[nodiscard]] std::pair<std::string, std::string_view> pair() const {
    const std::size_t equals = line_.find('=');
    if (equals == std::string_view::npos) return {};
    return {lower(trimmed(line_.substr(0, equals))), trimmed(line_.substr(equals + 1))};
  }

  /// The first word of a value, as a number of lines that fits into the rest of the file.
  std::size_t count(std::string_view value, std::size_t bytes_each) {
    const std::int64_t number =
        integer_of(text_, value.substr(0, value.find_first_of(" \t")), "a number of lines");
    if (number < 0 || static_cast<std::uint64_t>(number) > (text_.source().bytes.size() + 1) / bytes_each ||
        number >= std::int64_t{no_entity})
      text_.fail("the number " + std::to_string(number) + " is more than the file holds; it is damaged");
    return static_cast<std::size_t>(number);
  }

  void read_section() {
    const auto [key, value] = pair();
    if (key.empty()) text_.fail("expected KEY= and a value, found " + in_quotes(line_));
    if (key == "ndime") {
      const std::int64_t dimension = integer_of(text_, value, "a dimension");
      if (dimension != 2 && dimension != 3) text_.fail("the dimension is neither 2 nor 3");
      dimension_ = static_cast<std::size_t>(dimension);
    } else if (key == "nelem") {
      for (std::size_t i = count(value, 4); i > 0; --i) read_element(0);
    } else if (key == "npoin") {
      for (std::size_t i = count(value, 4); i > 0; --i) read_point();
    } else if (key == "marker_tag") {
      marker_ = names_->id_of(std::string(value));
    } else if (key == "marker_elems") {
      for (std::size_t i = count(value, 4); i > 0; --i) read_element(marker_);
    } else if (key == "nzone") {
      if (integer_of(text_, value, "a number of zones") != 1)
        text_.fail("meshes of several zones are not read");
    } else if (key != "nmark" && key != "izone") {
      ++skipped_;
    }
  }

  std::vector<std::string_view> fields() {
    if (!next()) text_.fail_truncated("a line of numbers");
    return words_of(line_);
  }

  void read_point() {
    const std::vector<std::string_view> f = fields();
    if (f.size() < dimension_ || dimension_ == 0)
      text_.fail("a point needs as many coordinates as NDIME= says before it");
    Point p{};
    for (std::size_t k = 0; k < dimension_; ++k) p[k] = real_of(text_, f[k], "a coordinate");
    mesh_.vertices.push_back(p);
  }

  void read_element(int marker) {
    const std::vector<std::string_view> f = fields();
    const std::int64_t type = integer_of(text_, f[0], "an element's type");
    const std::size_t corners = corners_of(type);
    if (corners == 0) text_.fail("elements of type " + std::to_string(type) + " are not read");
    if (f.size() < corners + 1) text_.fail("an element of fewer corners than its type has");
    std::array<Index, 8> n{};
    for (std::size_t i = 0; i < corners; ++i) {
      const std::int64_t v = integer_of(text_, f[i + 1], "a point's index");
      if (v < 0 || static_cast<std::uint64_t>(v) >= points_)
        text_.fail("the point " + std::to_string(v) + " does not exist; there are " +
                   std::to_string(points_));
      n[i] = static_cast<Index>(v);
    }
    if (type == kSu2Tetrahedron)
      mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]});
    else if (type == kSu2Line)
      mesh_.add_segment({n[0], n[1]}, marker);
    else if (type == kSu2Triangle)
      mesh_.add_facet({n[0], n[1], n[2]}, marker);
    else
      cuts_.push_back({n, corners, marker, text_.last()});
  }

  static std::size_t corners_of(std::int64_t type) {
    switch (type) {
      case kSu2Line:
        return 2;
      case kSu2Triangle:
        return 3;
      case kSu2Quadrangle:
      case kSu2Tetrahedron:
        return 4;
      case kSu2Pyramid:
        return 5;
      case kSu2Prism:
        return 6;
      case kSu2Hexahedron:
        return 8;
      default:
        return 0;
    }
  }

  /// How cells are cut depends on the points, which may come later.
  void add_what_is_cut() {
    for (const Cut& cut : cuts_) {
      const std::span<const Index> n = std::span(cut.corners).first(cut.count);
      if (cut.count > 4)
        add_cell(mesh_, n, cut.count, 0);
      else
        add_polygon(mesh_, n, cut.marker,
                    [&](const std::string& reason) { text_.fail_at(cut.position, reason); });
    }
  }

  struct Cut {
    std::array<Index, 8> corners;
    std::size_t count;
    int marker;
    std::size_t position;
  };
  TextReader text_;
  std::string_view line_;
  MeshData mesh_;
  std::vector<Cut> cuts_;
  std::size_t points_ = 0, skipped_ = 0, dimension_ = 0;
  int marker_ = 0;
  std::optional<NamedIds> names_{kFacetStem};  // of segments in two dimensions
};

/// Whether each facet has a tetrahedron on one side only: SU2 has markers only on the boundary.
std::vector<bool> on_boundary(const Volume& volume) {
  std::vector<bool> result;
  result.reserve(volume.facets.size());
  for (const SidesOfFacet& sides : sides_of_facets(volume))
    result.push_back(volume.tetrahedra.empty() || sides.behind.has_value() != sides.front.has_value());
  return result;
}

/// The elements of one type, with indices if these belong to the format.
template <std::size_t N>
void write_elements(AtomicWriter& out, int type, const std::vector<std::array<Index, N>>& elements) {
  out << "NELEM= " << std::uint64_t{elements.size()} << '\n';
  for (std::size_t i = 0; i < elements.size(); ++i) {
    beat(out.watch());
    out << type;
    for (const Index v : elements[i]) out << ' ' << v;
    out << ' ' << std::uint64_t{i} << '\n';
  }
}

void write_points(AtomicWriter& out, const std::vector<Point>& points, std::size_t dimension) {
  out << "NPOIN= " << std::uint64_t{points.size()} << '\n';
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < dimension; ++k) out << points[i][k] << ' ';
    out << std::uint64_t{i} << '\n';
  }
}

/// What is on the boundary, by markers.
template <std::size_t N>
struct Boundary {
  const Labels& labels;
  const std::vector<std::array<Index, N>>& entities;
  std::map<int, std::vector<std::size_t>> sets = {};

  Boundary(const Labels& of_all, const std::vector<std::array<Index, N>>& all,
           const std::vector<bool>& on_boundary)
      : labels(of_all), entities(all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (on_boundary[i]) sets[of_all.ids[i]].push_back(i);
  }

  void write_ids(AtomicWriter& out) const {
    Labels written = labels;
    std::erase_if(written.names, [&](const auto& entry) { return !sets.contains(entry.first); });
    write_id_comments(out, "%", written);
  }

  void write(AtomicWriter& out, int type) const {
    out << "NMARK= " << std::uint64_t{sets.size()} << '\n';
    for (const auto& [id, members] : sets) {
      out << "MARKER_TAG= " << labels.names.at(id) << "\nMARKER_ELEMS= " << std::uint64_t{members.size()}
          << '\n';
      for (const std::size_t i : members) {
        out << type;
        for (const Index v : entities[i]) out << ' ' << v;
        out << '\n';
      }
    }
  }
};

template <std::size_t N, std::size_t Cell>
void write_mesh(AtomicWriter& out, const Volume& volume, const std::vector<std::array<Index, Cell>>& cells,
                const Boundary<N>& boundary) {
  constexpr int kTypes[] = {0, 0, kSu2Line, kSu2Triangle, kSu2Tetrahedron};  // by corners
  out << "% mesh by Holdfast\n";
  boundary.write_ids(out);
  out << "NDIME= " << std::uint64_t{N} << '\n';
  write_elements(out, kTypes[Cell], cells);
  write_points(out, volume.vertices, N);
  boundary.write(out, kTypes[N]);
}

Labels labels_of_sides(const Sides& sides, const Volume& volume) {
  return labels_of(kSegmentStem, sides.markers, sides.segments.size(), volume.names.segments, kSu2Names,
                   kAnyId);
}

}  // namespace

MeshData read_su2(const Source& source) { return Su2Reader(source).read(); }

void write_su2(AtomicWriter& out, const Volume& volume) {
  if (is_in_plane(volume)) {
    const Sides sides(volume);
    const Labels labels = labels_of_sides(sides, volume);
    write_mesh(out, volume, volume.facets, Boundary<2>(labels, sides.segments, sides.on_boundary));
    return;
  }
  const SolverLabels labels(volume, kSu2Names, kAnyId);
  write_mesh(out, volume, volume.tetrahedra, Boundary<3>(labels.facets, volume.facets, on_boundary(volume)));
}

std::vector<Remark> not_in_su2(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const bool is_plane = is_in_plane(volume);
  const SolverLabels labels(volume, kSu2Names, kAnyId);
  const Labels& regions = is_plane ? labels.facets : labels.regions;
  const std::map<int, std::string>& names = is_plane ? volume.names.facets : volume.names.regions;
  const auto say = [&](std::ptrdiff_t count, const std::string& what) {
    if (count > 0)
      remarks.push_back(
          {RemarkKind::not_held, static_cast<std::size_t>(count), std::to_string(count) + what});
  };
  if (regions.names.size() > 1)
    say(std::ssize(regions.names), " regions are one zone in .su2, which has no place for them");
  else
    tell_names({{}, names, {}, {}}, ".su2", remarks);
  if (is_plane) {
    const Sides sides(volume);
    tell(labels_of_sides(sides, volume), ".su2", remarks);
    say(std::count(sides.on_boundary.begin(), sides.on_boundary.end(), false),
        " segments inside are left out: markers of .su2 are for the boundary");
  } else {
    tell(labels.facets, ".su2", remarks);
    const std::vector<bool> boundary = on_boundary(volume);
    say(std::count(boundary.begin(), boundary.end(), false),
        " facets inside are left out: markers of .su2 are for the boundary");
  }
  tell_left_out(volume, ".su2", is_plane, false, remarks);
  return remarks;
}

}  // namespace holdfast::io
