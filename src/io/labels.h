// Ids and names as a format takes them: no 0 or negative numbers where these mean none, and of the names
// only what it allows, each once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_writer.h"
#include "io/mesh_data.h"

namespace holdfast::io {

/// A name as text that every output holds: valid UTF-8, without control characters, without blanks at its
/// ends.
[[nodiscard]] std::string cleaned_name(std::string_view name);

/// What a format lets a name be.
struct NameRule {
  std::size_t longest;    ///< bytes
  std::string_view also;  ///< characters besides ASCII letters and digits
  bool blanks = false;    ///< blanks are allowed inside
  bool utf8 = false;      ///< bytes beyond ASCII are
  bool starts_with_letter = true;
  bool case_matters = true;  ///< names that differ in case alone are two
};

/// What a format does with ids.
struct IdRule {
  bool positive = true;  ///< 0 is none, and there are no negative ids
  int most = 2147483647;
  const std::set<int>* taken = nullptr;  ///< by entities of another kind
};

/// The ids of the entities of one kind as they are in the file.
struct Labels {
  std::string_view stem;             ///< of the names of ids without one: "surface" for surface_3
  std::vector<int> ids;              ///< one an entity
  std::map<int, std::string> names;  ///< of every id in use, each once
  std::map<int, int> renumbered;     ///< the volume's id and the file's where these differ
  std::size_t changed_names = 0;     ///< names that the format does not hold as they are

  /// The entities of each id, in order.
  [[nodiscard]] std::map<int, std::vector<std::size_t>> sets() const;
};

inline constexpr std::string_view kRegionStem = "region", kFacetStem = "surface", kSegmentStem = "curve",
                                  kVertexStem = "point";

/// An id that a format does not take gets the first free one, from 1, of these entities.
[[nodiscard]] Labels labels_of(std::string_view stem, const std::vector<int>& tags, std::size_t count,
                               const std::map<int, std::string>& names, const NameRule& name_rule,
                               const IdRule& id_rule = {});

/// Says in `remarks` which ids have other numbers, and how many names are changed, in a file of `format`.
void tell(const Labels& labels, std::string_view format, std::vector<Remark>& remarks);

/// The id that a name without a meaning of its own tells: 3 for "surface_3". Such names are given to ids
/// without one, with the number that they have in the volume, so that a reader finds it again.
[[nodiscard]] std::optional<int> id_of_default_name(std::string_view stem, std::string_view name);

/// The ids and names of one kind of entity, for readers of files that have names.
class NamedIds {
 public:
  explicit NamedIds(std::string_view stem) : stem_(stem) {}
  /// The id of a name in a file that has names alone: of "surface_3" 3, of any other the first free one.
  int id_of(const std::string& name);
  /// What a file tells of the ids of names elsewhere, before it gives any of the names.
  void tell(int id, const std::string& name);
  /// An id of the file and its name.
  void set(int id, const std::string& name);
  /// The volume's id for one of the file: another one where its name tells that.
  [[nodiscard]] int resolve(int id) const {
    const auto found = other_.find(id);
    return found == other_.end() ? id : found->second;
  }
  [[nodiscard]] std::map<int, std::string> take() { return std::move(names_); }
  [[nodiscard]] std::string_view stem() const { return stem_; }

 private:
  std::string_view stem_;
  std::map<std::string, int, std::less<>> ids_;
  std::map<int, std::string> names_;
  std::map<int, int> other_;
  std::set<int> used_;
};

/// Says how many ids have names, which `format` does not hold. The name of 0 is that of all that has no id.
void tell_names(const Names& names, std::string_view format, std::vector<Remark>& remarks);

/// Says how many vertices have markers, which `format` does not hold.
void tell_marked_vertices(const Volume& volume, std::string_view format, std::vector<Remark>& remarks);

/// Comments that keep the ids in files of names alone, as "surface 3 inlet" behind the format's mark.
void write_id_comments(AtomicWriter& out, std::string_view mark, const Labels& labels);
/// Whether a comment, behind its mark, is one of these; of the kinds that have its stem.
bool read_id_comment(std::string_view comment, std::span<NamedIds* const> kinds);

}  // namespace holdfast::io
