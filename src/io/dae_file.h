// The elements of a COLLADA file, by their ids, and the numbers in them (COLLADA 1.4.1, 1.5).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/xml_reader.h"

namespace holdfast::io {

struct DaeElement {
  XmlTag tag;
  std::string_view text;  ///< before its first child
  std::vector<std::size_t> children;
};

class DaeFile {
 public:
  /// Throws FileError if the file is no COLLADA, or is truncated.
  explicit DaeFile(const Source& source);

  [[nodiscard]] const DaeElement& root() const { return elements_[0]; }
  [[nodiscard]] std::vector<const DaeElement*> children(const DaeElement& element,
                                                        std::string_view name) const;
  [[nodiscard]] std::vector<const DaeElement*> children(const DaeElement& element) const;
  /// The first child of a name, if any.
  [[nodiscard]] const DaeElement* child(const DaeElement& element, std::string_view name) const;
  /// The element that an attribute names, such as url="#box". Throws if there is none.
  [[nodiscard]] const DaeElement& target(const DaeElement& element, std::string_view attribute) const;
  /// The element with an id, if any.
  [[nodiscard]] const DaeElement* find(const std::string& id) const;

  [[nodiscard]] std::vector<double> reals(const DaeElement& element) const;
  /// Numbers from 0.
  [[nodiscard]] std::vector<std::uint64_t> numbers(const DaeElement& element) const;
  [[nodiscard]] std::uint64_t number(const DaeElement& element, std::string_view attribute,
                                     std::uint64_t otherwise) const;

  [[noreturn]] void fail(const DaeElement& element, const std::string& reason) const {
    xml_.fail(element.tag, reason);
  }

 private:
  Source source_;
  XmlReader xml_;
  std::vector<DaeElement> elements_;  ///< the root first
  std::map<std::string, std::size_t> by_id_;
};

}  // namespace holdfast::io
