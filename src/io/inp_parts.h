// The parts of an .inp file and their instances in the assembly (Abaqus Keywords Guide, *PART, *INSTANCE).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/inp_text.h"

namespace holdfast::io {

class InpParts {
 public:
  /// At the keyword *PART: records the position of the part's lines and skips them.
  void skip(InpText& text, const InpKeyword& key);

  /// Where the lines of a part begin and where its *END PART is.
  struct Lines {
    std::size_t begin = 0, end = 0;
  };
  /// At the keyword *INSTANCE, and the lines that place it: sets its scope and moves past them. Returns the
  /// lines of its part, if it has one.
  std::optional<Lines> begin_instance(InpText& text, const InpKeyword& key);
  /// The scope of one more instance; the part's own scope if nothing places it.
  Lines begin_instance_of_part(InpText& text, const std::string& part);

  /// The scope of lines of the assembly whose keyword names an instance. Throws if there is no such instance.
  [[nodiscard]] InpScope scope_of(const InpText& text, const InpKeyword& key) const;

  [[nodiscard]] std::size_t instances() const { return scopes_.size(); }
  /// Parts without an instance, in order.
  [[nodiscard]] std::vector<std::string> unused() const;
  /// If there is only one instance, its names of sets are shown without a prefix.
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
