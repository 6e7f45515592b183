// The parts of an .inp file and their instances in the assembly (Abaqus Keywords Guide, *PART, *INSTANCE).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/inp_text.h"

namespace holdfast::io {

class InpParts {
 public:
  /// Stands behind the keyword *PART: remembers where the part's lines are, and goes behind them.
  void skip(InpText& text, const InpKeyword& key);

  /// Where the lines of a part begin, and its *END PART.
  struct Lines {
    std::size_t begin = 0, end = 0;
  };
  /// Stands behind the keyword *INSTANCE, at what places it: sets its scope, and goes behind that. The
  /// lines of its part, if it has one.
  std::optional<Lines> begin_instance(InpText& text, const InpKeyword& key);
  /// The scope of one more instance; a part's own where nothing places it.
  Lines begin_instance_of_part(InpText& text, const std::string& part);

  /// The scope of lines of the assembly whose keyword names an instance. Throws if there is none.
  [[nodiscard]] InpScope scope_of(const InpText& text, const InpKeyword& key) const;

  [[nodiscard]] std::size_t instances() const { return scopes_.size(); }
  /// Parts that no instance has, in order.
  [[nodiscard]] std::vector<std::string> unused() const;
  /// Of the only instance the names of sets need no prefix.
  [[nodiscard]] std::string shown(const std::string& name) const;

 private:
  struct Part {
    std::string name;
    Lines lines;
    bool used = false;
  };
  InpScope& add_instance(const std::string& name);
  Part* find(const std::string& name);

  std::vector<Part> parts_;
  std::vector<InpScope> scopes_;
};

}  // namespace holdfast::io
