// Reads OpenFOAM's polyMesh of tetrahedra (OpenFOAM user guide, "Mesh description"): ASCII, each file
// optionally compressed by gzip. Patches are the markers of boundary faces, face zones those of inner faces,
// cell zones the regions.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

/// A file read word by word. Brackets, braces and semicolons are words.
class FoamText {
 public:
  FoamText(const std::filesystem::path& path, Watch* watch)
      : path_(path), bytes_(path_, watch), text_(bytes_.view()), watch_(watch) {
    read_header();
  }

  [[nodiscard]] bool at_end() {
    skip();
    return at_ == text_.size();
  }
  [[nodiscard]] std::string_view peek() {
    const std::size_t before = at_;
    const std::string_view found = word("a word");
    at_ = before;
    return found;
  }
  std::string_view word(std::string_view what) {
    skip();
    last_ = at_;
    if (at_ == text_.size()) fail("expected " + std::string(what) + ", but the file ends; it is truncated");
    if (is_sign(text_[at_])) return text_.substr(at_++, 1);
    if (text_[at_] == '"') {
      const std::size_t end = text_.find('"', at_ + 1);
      if (end == std::string_view::npos) fail("a text that does not end; the file is truncated");
      const std::string_view found = text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
      return found;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_sign(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void expect(std::string_view sign) {
    if (const std::string_view found = word(sign); found != sign)
      fail("expected " + in_quotes(sign) + ", found " + in_quotes(found));
  }
  std::int64_t integer(std::string_view what) {
    const std::string_view found = word(what);
    std::int64_t value = 0;
    const auto result = std::from_chars(found.data(), found.data() + found.size(), value);
    if (result.ec != std::errc() || result.ptr != found.data() + found.size())
      fail("expected " + std::string(what) + ", found " + in_quotes(found));
    return value;
  }
  double real(std::string_view what) {
    const std::string_view found = word(what);
    double value = 0;
    const auto result = parse_double(found.data(), found.data() + found.size(), value);
    const bool tiny = result.ec == std::errc::result_out_of_range && std::abs(value) < 1;
    if ((result.ec != std::errc() && !tiny) || result.ptr != found.data() + found.size())
      fail("expected " + std::string(what) + ", found " + in_quotes(found));
    if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
    return value;
  }
  Index index(std::string_view what, std::size_t size) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) >= size)
      fail(std::string(what) + " is " + std::to_string(value) + ", but there are " + std::to_string(size));
    return static_cast<Index>(value);
  }
  /// Reads a list: N ( ... ), optionally after "List<label>".
  template <typename Read>
  void list(std::string_view what, Read&& read) {
    if (peek().starts_with("List<")) word(what);
    const std::int64_t announced = integer(what);
    if (announced < 0 || static_cast<std::uint64_t>(announced) > text_.size() - at_)
      fail(std::string(what) + ": a list of " + std::to_string(announced) + ", more than the file holds");
    if (announced == 0 && (at_end() || peek() != "(")) return;
    expect("(");
    for (std::int64_t i = 0; i < announced; ++i) {
      if (peek() == ")")
        fail(std::string(what) + ": the list ends after " + std::to_string(i) + " of " +
             std::to_string(announced));
      read();
    }
    expect(")");
  }
  /// The same for at most `most` words, or N { value } if all are equal.
  template <typename Read>
  void words(std::string_view what, std::size_t most, Read&& read) {
    const std::size_t begin = at_;
    if (peek().starts_with("List<")) word(what);
    const std::int64_t announced = integer(what);
    if (announced > 0 && static_cast<std::uint64_t>(announced) > most)
      fail(std::string(what) + ": a list of " + std::to_string(announced) + ", but there are " +
           std::to_string(most));
    if (announced <= 0 || peek() != "{") {
      at_ = begin;
      return list(what, read);
    }
    expect("{");
    const std::size_t value_at = at_;
    for (std::int64_t i = 0; i < announced; ++i) {
      at_ = value_at;
      read();
    }
    expect("}");
  }
  /// Skips the value of an unused entry: up to its semicolon, or its block.
  void skip_entry() {
    for (std::size_t depth = 0;;) {
      const std::string_view found = word("the end of an entry");
      if (found == "{" || found == "(") ++depth;
      if ((found == "}" || found == ")") && depth > 0 && --depth == 0 && found == "}") return;
      if (found == ";" && depth == 0) return;
    }
  }

  /// Reads ids and names from the comments that Holdfast writes before the header: "// surface 3 inlet".
  void read_ids(std::span<NamedIds* const> kinds) const {
    for (std::size_t at = text_.find("// "); at != std::string_view::npos; at = text_.find("// ", at + 1)) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      read_id_comment(text_.substr(at + 2, end - at - 2), kinds);
    }
  }

  [[noreturn]] void fail(const std::string& reason) const {
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(last_), '\n');
    throw FileError(path_, "line " + std::to_string(lines + 1), reason);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  static bool is_sign(char c) { return c == '(' || c == ')' || c == '{' || c == '}' || c == ';'; }

  void skip() {
    for (;;) {
      beat(watch_);
      while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("//"))
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (rest.starts_with("/*"))
        at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
      else
        return;
    }
  }

  void read_header() {
    if (at_end() || peek() != "FoamFile")
      fail("this is no file of OpenFOAM: it does not begin with FoamFile");
    word("FoamFile");
    expect("{");
    while (peek() != "}") {
      const std::string key(word("a key"));
      if (key == "format" && peek() == "binary")
        fail(
            "binary files are not read; foamFormatConvert writes them as text where controlDict has "
            "writeFormat ascii");
      skip_entry();
    }
    expect("}");
  }

  std::filesystem::path path_;
  FileBytes bytes_;
  std::string_view text_;
  Watch* watch_;
  std::size_t at_ = 0, last_ = 0;
};

struct Patch {
  std::string name;
  std::size_t first = 0, count = 0;
};

class FoamReader {
 public:
  explicit FoamReader(const Source& source)
      : folder_(poly_mesh_of(source.path)), watch_(source.watch), mesh_(source) {}

  MeshData read() {
    read_points();
    read_faces();
    read_cells_of_faces();
    read_patches();
    read_zones();
    add_cells();
    mesh_.names.facets = facet_ids_.take();
    mesh_.names.regions = region_ids_.take();
    return std::move(mesh_);
  }

 private:
  /// A file of the folder, compressed or not; nullopt if it is missing and not `needed`.
  std::optional<FoamText> open(const char* name, bool needed) {
    std::filesystem::path path = folder_ / name;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
      std::filesystem::path packed = path;
      packed += ".gz";
      if (std::filesystem::exists(packed, error))
        path = packed;
      else if (!needed)
        return std::nullopt;
    }
    return std::optional<FoamText>(std::in_place, path, watch_);
  }

  void read_points() {
    auto file = open("points", true);
    file->list("points", [&] {
      file->expect("(");
      Point p{};
      for (double& x : p) x = file->real("a coordinate");
      file->expect(")");
      mesh_.vertices.push_back(p);
    });
  }

  void read_faces() {
    auto file = open("faces", true);
    file->list("faces", [&] {
      if (const std::int64_t corners = file->integer("a number of corners"); corners != 3)
        file->fail("a face of " + std::to_string(corners) + " corners; only meshes of tetrahedra are read");
      file->expect("(");
      Triangle face{};
      for (Index& v : face) v = file->index("a face's point", mesh_.vertices.size());
      file->expect(")");
      faces_.push_back(face);
    });
  }

  std::vector<Index> labels(const char* name, std::size_t most) {
    auto file = open(name, true);
    std::vector<Index> cells;
    file->words(name, most, [&] { cells.push_back(file->index("a cell", 4 * faces_.size() + 1)); });
    return cells;
  }

  void read_cells_of_faces() {
    owner_ = labels("owner", faces_.size());
    if (owner_.size() != faces_.size())
      throw FileError(
          folder_ / "owner", "",
          std::to_string(owner_.size()) + " owners for " + std::to_string(faces_.size()) + " faces");
    neighbour_ = labels("neighbour", faces_.size());
    for (const auto* cells : {&owner_, &neighbour_})
      for (const Index cell : *cells) cells_ = std::max<std::size_t>(cells_, std::size_t{cell} + 1);
  }

  void read_patches() {
    auto file = open("boundary", true);
    file->read_ids(std::array{&facet_ids_});
    markers_.assign(faces_.size(), 0);
    is_facet_.assign(faces_.size(), false);
    file->list("patches", [&] {
      Patch patch;
      patch.name = file->word("a patch's name");
      file->expect("{");
      bool has_first = false, has_count = false;
      while (file->peek() != "}") {
        const std::string key(file->word("a key"));
        if (key == "nFaces") {
          patch.count = file->index("nFaces", faces_.size() + 1);
          has_count = true;
        } else if (key == "startFace") {
          patch.first = file->index("startFace", faces_.size() + 1);
          has_first = true;
        } else {
          file->skip_entry();
          continue;
        }
        file->expect(";");
      }
      file->expect("}");
      if (!has_first || !has_count)
        file->fail("the patch " + in_quotes(patch.name) + " lacks nFaces or startFace");
      if (patch.count > 0 && (patch.first < neighbour_.size() || patch.count > faces_.size() - patch.first))
        file->fail("the patch " + in_quotes(patch.name) + " has faces that are not on the boundary");
      const bool is_rest = patch.name.starts_with("defaultFaces");
      const int marker = is_rest ? 0 : facet_ids_.id_of(patch.name);
      for (std::size_t f = patch.first; f < patch.first + patch.count; ++f) {
        is_facet_[f] = true;
        markers_[f] = marker;
      }
    });
  }

  /// Reads named lists of entities: { type ...; KEY List<label> N ( ... ); ... }.
  template <typename Add>
  void read_zone_file(const char* name, const char* key, std::size_t size, NamedIds& ids, Add&& add) {
    auto file = open(name, false);
    if (!file) return;
    file->read_ids(std::array{&ids});
    file->list("zones", [&] {
      const int id = ids.id_of(std::string(file->word("a zone's name")));
      file->expect("{");
      std::vector<Index> members;
      std::vector<bool> flips;
      while (file->peek() != "}") {
        const std::string found(file->word("a key"));
        if (found == key) {
          file->words(key, size, [&] { members.push_back(file->index("a zone's member", size)); });
          file->expect(";");
        } else if (found == "flipMap") {
          file->words(key, size, [&] {
            const std::string_view flip = file->word("a flip");
            flips.push_back(flip == "1" || flip == "true" || flip == "yes" || flip == "on");
          });
          file->expect(";");
        } else {
          file->skip_entry();
        }
      }
      file->expect("}");
      for (std::size_t i = 0; i < members.size(); ++i) add(members[i], id, i < flips.size() && flips[i]);
    });
  }

  void read_zones() {
    read_zone_file("faceZones", "faceLabels", faces_.size(), facet_ids_, [&](Index face, int id, bool flip) {
      if (is_facet_[face]) return void(++in_several_);
      is_facet_[face] = true;
      markers_[face] = id;
      if (flip) flipped_.push_back(face);
    });
    regions_.assign(cells_, 0);
    std::vector<bool> in_zone(cells_, false);
    read_zone_file("cellZones", "cellLabels", cells_, region_ids_, [&](Index cell, int id, bool) {
      if (in_zone[cell]) return void(++in_several_);
      in_zone[cell] = true;
      regions_[cell] = id;
    });
    mesh_.leave_out(in_several_, "members of zones that are in another zone or patch",
                    "member of a zone that is in another zone or patch");
  }

  /// Four faces, oriented outwards, are a tetrahedron if they have four corners.
  void add_cells() {
    std::vector<std::array<Index, 4>> faces_of(cells_, {no_entity, no_entity, no_entity, no_entity});
    std::vector<std::uint8_t> count(cells_, 0);
    const auto take = [&](Index cell, Index face) {
      if (count[cell] < 4) faces_of[cell][count[cell]] = face;
      if (count[cell] < 5) ++count[cell];
    };
    for (Index f = 0; f < faces_.size(); ++f) {
      take(owner_[f], f);
      if (f < neighbour_.size()) take(neighbour_[f], f);
    }
    for (Index cell = 0; cell < cells_; ++cell) {
      beat(watch_);
      if (count[cell] != 4) refuse(cell);
      const Index first = faces_of[cell][0];
      Triangle base = faces_[first];  // oriented outwards
      if (owner_[first] != cell) std::swap(base[1], base[2]);
      Index top = no_entity;
      std::array<std::size_t, 4> used{};
      for (const Index face : faces_of[cell])
        for (const Index v : faces_[face]) {
          const auto at = std::find(base.begin(), base.end(), v);
          if (at == base.end() && top != no_entity && top != v) refuse(cell);
          if (at == base.end()) top = v;
          ++used[at == base.end() ? 3 : static_cast<std::size_t>(at - base.begin())];
        }
      if (used != std::array<std::size_t, 4>{3, 3, 3, 3}) refuse(cell);
      mesh_.add_tetrahedron({base[0], base[2], base[1], top}, regions_[cell]);
    }
    for (const Index face : flipped_) std::swap(faces_[face][1], faces_[face][2]);
    for (Index f = 0; f < faces_.size(); ++f)
      if (is_facet_[f]) mesh_.add_facet(faces_[f], markers_[f]);
  }

  [[noreturn]] void refuse(Index cell) const {
    throw FileError(folder_ / "owner", "cell " + std::to_string(cell),
                    "is no tetrahedron of four triangles; only meshes of tetrahedra are read");
  }

  std::filesystem::path folder_;
  Watch* watch_;
  MeshData mesh_;
  std::vector<Triangle> faces_;
  std::vector<Index> owner_, neighbour_, flipped_;
  std::size_t cells_ = 0, in_several_ = 0;
  std::vector<int> markers_, regions_;
  std::vector<bool> is_facet_;
  NamedIds facet_ids_{kFacetStem}, region_ids_{kRegionStem};
};

}  // namespace

MeshData read_openfoam(const Source& source) { return FoamReader(source).read(); }

}  // namespace holdfast::io
