// Reads Gmsh's .msh, versions 2.x and 4.1, ASCII (Gmsh reference manual, "File formats").
//
// A marker or region is the first physical tag, or the elementary entity's tag where there is none.
// Vertices are ordered by node tag, which is the order in which Holdfast numbers them.
#include <algorithm>
#include <map>
#include <numeric>

#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// Nodes in file order, and then indices by node tag.
class MshNodes {
 public:
  void reserve(std::size_t count) {
    tags_.reserve(count);
    points_.reserve(count);
  }
  void add_tag(std::int64_t tag) { tags_.push_back(tag); }
  void add_point(const Point& point) { points_.push_back(point); }

  /// Sorts by tag; a tag that occurs twice fails at the text's position.
  void finish(const TextReader& text) {
    if (std::is_sorted(tags_.begin(), tags_.end(), std::less_equal<>())) return;
    std::vector<std::size_t> order(tags_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags_[a] < tags_[b]; });
    MshNodes sorted;
    sorted.reserve(order.size());
    for (const std::size_t i : order) {
      if (!sorted.tags_.empty() && sorted.tags_.back() == tags_[i])
        text.fail("the node tag " + std::to_string(tags_[i]) + " occurs twice");
      sorted.add_tag(tags_[i]);
      sorted.add_point(points_[i]);
    }
    *this = std::move(sorted);
  }

  [[nodiscard]] Index index(const TextReader& text, std::int64_t tag) const {
    // Tags without gaps are the rule; then no search is needed.
    if (!tags_.empty() && tag >= tags_.front() && tag <= tags_.back()) {
      const auto guess = static_cast<std::size_t>(tag - tags_.front());
      if (guess < tags_.size() && tags_[guess] == tag) return static_cast<Index>(guess);
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
      if (*found == tag) return static_cast<Index>(found - tags_.begin());
    }
    text.fail("the node " + std::to_string(tag) + " does not exist");
  }

  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  [[nodiscard]] std::vector<Point> take_points() { return std::move(points_); }

 private:
  std::vector<std::int64_t> tags_;
  std::vector<Point> points_;
};

class MshReader {
 public:
  explicit MshReader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    if (text_.word("$MeshFormat") != "$MeshFormat")
      text_.fail("not a Gmsh mesh: it does not start with $MeshFormat");
    read_format();
    while (!text_.at_end()) read_section();
    mesh_.vertices = nodes_.take_points();
    return std::move(mesh_);
  }

 private:
  void read_format() {
    const std::string version(text_.word("the version"));
    modern_ = version == "4.1";
    if (!modern_ && version != "2" && !version.starts_with("2."))
      text_.fail("version " + in_quotes(version) + " is not read; save it as 4.1 or 2.2");
    if (text_.integer("the file type") != 0)
      text_.fail("binary .msh is not read; save it as ASCII (gmsh -save -setnumber Mesh.Binary 0)");
    static_cast<void>(text_.integer("the data size"));
    expect_end("$EndMeshFormat");
  }

  void expect_end(std::string_view end) {
    const std::string_view word = text_.word(end);
    if (word != end) text_.fail("expected " + std::string(end) + ", found " + in_quotes(word));
  }

  void read_section() {
    const std::string name(text_.word("a section"));
    if (!name.starts_with('$')) text_.fail("expected a section, found " + in_quotes(name));
    if (name == "$Nodes") {
      if (nodes_.size() > 0) text_.fail("a second section of nodes");
      modern_ ? read_nodes_4() : read_nodes_2();
      nodes_.finish(text_);
      expect_end("$EndNodes");
    } else if (name == "$Elements") {
      modern_ ? read_elements_4() : read_elements_2();
      expect_end("$EndElements");
    } else if (name == "$Entities" && modern_) {
      read_entities();
      expect_end("$EndEntities");
    } else {
      skip_section("$End" + name.substr(1));
    }
  }

  void skip_section(const std::string& end) {
    text_.skip_line();
    while (!text_.at_end()) {
      if (text_.word_on_line() == end) return;
      text_.skip_line();
    }
    text_.fail_truncated(end);
  }

  void read_nodes_2() {
    const std::size_t count = text_.count("the number of nodes", 8);
    nodes_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      nodes_.add_tag(text_.integer("a node tag"));
      nodes_.add_point(text_.point());
    }
  }

  void read_elements_2() {
    const std::size_t count = text_.count("the number of elements", 6);
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_.integer("an element tag"));
      const std::int64_t type = text_.integer("an element type");
      const std::size_t tags = text_.count("the number of tags", 2);
      int physical = 0, elementary = 0;
      for (std::size_t tag = 0; tag < tags; ++tag) {
        const int value = text_.tag("a tag");
        if (tag == 0) physical = value;
        if (tag == 1) elementary = value;
      }
      read_element(type, physical != 0 ? physical : elementary);
    }
  }

  /// Reads the physical tags of the entities of each dimension.
  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = text_.count("the number of entities", 10);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = text_.integer("an entity tag");
        for (int bound = 0; bound < (dimension == 0 ? 3 : 6); ++bound)
          static_cast<void>(text_.real("a bound"));
        const std::size_t physicals = text_.count("the number of physical tags", 2);
        for (std::size_t k = 0; k < physicals; ++k) {
          const int physical = text_.tag("a physical tag");
          if (k == 0) physicals_[{dimension, tag}] = physical;
        }
        if (dimension == 0) continue;
        const std::size_t borders = text_.count("the number of bounding entities", 2);
        for (std::size_t k = 0; k < borders; ++k) static_cast<void>(text_.integer("an entity tag"));
      }
    }
  }

  void read_nodes_4() {
    const std::size_t blocks = text_.count("the number of blocks", 8);
    nodes_.reserve(text_.count("the number of nodes", 8));
    static_cast<void>(text_.integer("the least node tag"));
    static_cast<void>(text_.integer("the largest node tag"));
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = text_.integer("a dimension");
      static_cast<void>(text_.integer("an entity tag"));
      const bool parametric = text_.integer("the parametric flag") != 0;
      const std::size_t count = text_.count("the number of nodes", 8);
      for (std::size_t i = 0; i < count; ++i) nodes_.add_tag(text_.integer("a node tag"));
      for (std::size_t i = 0; i < count; ++i) {
        nodes_.add_point(text_.point());
        for (std::int64_t axis = 0; parametric && axis < std::min<std::int64_t>(dimension, 3); ++axis)
          static_cast<void>(text_.real("a parametric coordinate"));
      }
    }
  }

  void read_elements_4() {
    const std::size_t blocks = text_.count("the number of blocks", 8);
    for (const char* what : {"the number of elements", "the least element tag", "the largest element tag"})
      static_cast<void>(text_.integer(what));
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = text_.integer("a dimension");
      const int entity = text_.tag("an entity tag");
      const std::int64_t type = text_.integer("an element type");
      const std::size_t count = text_.count("the number of elements", 4);
      const auto physical = physicals_.find({static_cast<std::size_t>(dimension), entity});
      const int tag = physical == physicals_.end() ? entity : physical->second;
      for (std::size_t i = 0; i < count; ++i) {
        static_cast<void>(text_.integer("an element tag"));
        read_element(type, tag);
      }
    }
  }

  template <std::size_t N>
  std::array<Index, N> corners() {
    std::array<Index, N> result{};
    for (Index& corner : result) corner = nodes_.index(text_, text_.integer("a node tag"));
    return result;
  }

  void read_element(std::int64_t type, int tag) {
    switch (type) {
      case 1:
        return mesh_.add_segment(corners<2>(), tag);
      case 2:
        return mesh_.add_facet(corners<3>(), tag);
      case 4:
        return mesh_.add_tetrahedron(corners<4>(), tag);
      case 15:
        static_cast<void>(corners<1>());
        return;
      default:
        text_.fail("elements of type " + std::to_string(type) +
                   " are not read; only points, lines, triangles and tetrahedra of first order are");
    }
  }

  TextReader text_;
  bool modern_ = false;  ///< version 4.1
  MshNodes nodes_;
  std::map<std::pair<std::size_t, std::int64_t>, int> physicals_;  ///< by dimension and entity tag
  MeshData mesh_;
};

}  // namespace

MeshData read_msh(const Source& source) { return MshReader(source).read(); }

}  // namespace holdfast::io
