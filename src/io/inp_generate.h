// The nodes that an .inp file generates from others by *NGEN and *NFILL, and the sets of nodes that *NFILL
// joins (Abaqus Keywords Guide).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/inp_elements.h"

namespace holdfast::io {

/// Whether a keyword, given in lower case and without its star, occurs in a file.
[[nodiscard]] bool has_inp_keyword(std::string_view bytes, std::string_view name);

class InpGenerated {
 public:
  using Numbers = std::vector<std::int64_t>;

  explicit InpGenerated(InpElements& elements) : elements_(elements) {}

  /// The lines after *NGEN: nodes on a straight line between two nodes.
  void read_ngen(InpText& text, const InpKeyword& key);
  /// The lines after *NFILL: nodes on straight lines between the nodes of two sets.
  void read_nfill(InpText& text, const InpKeyword& key);
  /// The lines after *NSET.
  void read_set(InpText& text, const InpKeyword& key);
  /// Adds nodes that a keyword listed in a set.
  void add_listed(const InpText& text, const InpKeyword& key, const Numbers& numbers);

 private:
  void fill(const InpText& text, std::int64_t first, std::int64_t last, std::int64_t intervals,
            std::int64_t step, Numbers& set);
  [[nodiscard]] const Numbers& set_of(const InpText& text, std::string_view name) const;

  InpElements& elements_;
  std::map<std::string, Numbers> sets_;  ///< by lower-case name
  InpMade made_;
};

}  // namespace holdfast::io
