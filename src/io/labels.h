// Ids and names as a format accepts them: no zero or negative numbers if these mean "none", and only unique
// names that the format allows.
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

/// A name that every output accepts: valid UTF-8, no control characters, no blanks at its ends.
[[nodiscard]] std::string cleaned_name(std::string_view name);

/// The names that a format allows.
struct NameRule {
  std::size_t longest;    ///< in bytes
  std::string_view also;  ///< characters besides ASCII letters and digits
  bool blanks = false;    ///< blanks are allowed inside
  bool utf8 = false;      ///< bytes beyond ASCII are allowed
  bool starts_with_letter = true;
  bool case_matters = true;  ///< names that differ only in case are different
};

/// The ids that a format allows.
struct IdRule {
  bool positive = true;  ///< 0 means none, and negative ids are not allowed
  int most = 2147483647;
  const std::set<int>* taken = nullptr;  ///< ids taken by entities of another kind
};
inline constexpr IdRule kAnyId{false};

/// The ids of the entities of one kind, as written to the file.
struct Labels {
  std::string_view stem;             ///< of default names: "surface" for surface_3
  std::vector<int> ids;              ///< one per entity
  std::map<int, std::string> names;  ///< one for every id in use, all different
  std::map<int, int> renumbered;     ///< from the volume's id to the file's, if these differ
  std::size_t changed_names = 0;     ///< names that the format cannot store unchanged

  /// The entities with each id, in order.
  [[nodiscard]] std::map<int, std::vector<std::size_t>> sets() const;
};

inline constexpr std::string_view kRegionStem = "region", kFacetStem = "surface", kSegmentStem = "curve",
                                  kVertexStem = "point";

/// An id that the format does not allow is replaced by the first number, from 1, that neither these entities
/// nor their names use.
[[nodiscard]] Labels labels_of(std::string_view stem, const std::vector<int>& tags, std::size_t count,
                               const std::map<int, std::string>& names, const NameRule& name_rule,
                               const IdRule& id_rule = {});

/// Lists in `remarks` the renumbered ids and the number of changed names, for a file of `format`.
void tell(const Labels& labels, std::string_view format, std::vector<Remark>& remarks);

/// The id in a default name: 3 for "surface_3". Ids without a name get such names, with their number in the
/// volume, so that a reader restores the number.
[[nodiscard]] std::optional<int> id_of_default_name(std::string_view stem, std::string_view name);

/// The ids and names of one kind of entity, for readers of formats with names.
class NamedIds {
 public:
  explicit NamedIds(std::string_view stem) : stem_(stem) {}
  /// The id of a name in a file without ids: 3 for "surface_3", the first free id for any other name.
  int id_of(const std::string& name);
  /// What the file says elsewhere about the ids of names, before it gives any of the names.
  void tell(int id, const std::string& name);
  /// Records an id of the file and its name.
  void set(int id, const std::string& name);
  /// The volume's id for an id of the file: a different one if its name says so.
  [[nodiscard]] int resolve(int id) const {
    const auto found = other_.find(id);
    return found == other_.end() ? id : found->second;
  }
  /// Whether the file has given this name.
  [[nodiscard]] bool has(const std::string& name) const { return ids_.contains(cleaned_name(name)); }
  [[nodiscard]] std::map<int, std::string> take() { return std::move(names_); }
  [[nodiscard]] std::string_view stem() const { return stem_; }

 private:
  std::string_view stem_;
  std::map<std::string, int, std::less<>> ids_;
  std::map<int, std::string> names_;
  std::map<int, int> other_;
  std::set<int> used_;
};

/// How many markers are not 0.
[[nodiscard]] std::size_t marked(std::span<const int> markers);
/// Says that so many things ("marker", "markers") have no place in `format`, if there are any.
void tell_without_place(std::size_t count, const char* one, const char* many, std::string_view format,
                        std::vector<Remark>& remarks);

/// Says how many ids have names that `format` cannot store; 0, which everything without an id has, is one.
void tell_names(const Names& names, std::string_view format, std::vector<Remark>& remarks);

/// Says how many vertices have markers that `format` cannot store.
void tell_marked_vertices(const Volume& volume, std::string_view format, std::vector<Remark>& remarks);

/// Comments that keep the ids in files that have only names, such as "surface 3 inlet" after the format's
/// comment mark.
void write_id_comments(AtomicWriter& out, std::string_view mark, const Labels& labels);
/// Whether a comment, without its mark, is one of these; it is added to the kinds with its stem.
bool read_id_comment(std::string_view comment, std::span<NamedIds* const> kinds);

}  // namespace holdfast::io
