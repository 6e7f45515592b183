#include "io/dae_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/text_reader.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

/// Calls `use` with each word of a text.
template <typename Use>
void for_each_word(std::string_view text, Use&& use) {
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kXmlBlanks);
    if (begin == std::string_view::npos) return;
    const std::size_t end = std::min(text.find_first_of(kXmlBlanks, begin), text.size());
    use(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

}  // namespace

DaeFile::DaeFile(const Source& source) : source_(source), xml_(source) {
  std::vector<std::size_t> open;
  bool ended = false;
  while (std::optional<XmlTag> tag = xml_.next()) {
    beat(source_.watch);
    if (elements_.empty() && (tag->closing || tag->name != "COLLADA"))
      xml_.fail(*tag, "no COLLADA: it does not begin with <COLLADA>");
    if (ended) break;
    if (tag->closing) {
      if (elements_[open.back()].tag.name != tag->name)
        xml_.fail(*tag, "</" + tag->name + "> closes no <" + elements_[open.back()].tag.name + ">");
      open.pop_back();
      ended = open.empty();
      continue;
    }
    const std::size_t number = elements_.size();
    if (!open.empty()) elements_[open.back()].children.push_back(number);
    if (const std::string id = tag->attribute("id"); !id.empty()) by_id_.emplace(id, number);
    const bool is_empty = tag->empty;
    elements_.push_back({std::move(*tag), is_empty ? std::string_view() : xml_.text(), {}});
    if (!is_empty) open.push_back(number);
    ended = open.empty();
  }
  if (!ended) throw FileError(source.path, "", "does not end with </COLLADA>; it is truncated or no COLLADA");
}

std::vector<const DaeElement*> DaeFile::children(const DaeElement& element) const {
  std::vector<const DaeElement*> result;
  for (const std::size_t child : element.children) result.push_back(&elements_[child]);
  return result;
}

std::vector<const DaeElement*> DaeFile::children(const DaeElement& element, std::string_view name) const {
  std::vector<const DaeElement*> result = children(element);
  std::erase_if(result, [name](const DaeElement* child) { return child->tag.name != name; });
  return result;
}

const DaeElement* DaeFile::child(const DaeElement& element, std::string_view name) const {
  const std::vector<const DaeElement*> all = children(element, name);
  return all.empty() ? nullptr : all[0];
}

const DaeElement* DaeFile::find(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : &elements_[found->second];
}

const DaeElement& DaeFile::target(const DaeElement& element, std::string_view attribute) const {
  const std::string url = element.tag.attribute(attribute);
  if (!url.starts_with('#')) fail(element, in_quotes(url) + " is in another file, which is not read");
  const DaeElement* const found = find(url.substr(1));
  if (found == nullptr) fail(element, in_quotes(url) + " does not exist");
  return *found;
}

std::vector<double> DaeFile::reals(const DaeElement& element) const {
  std::vector<double> values;
  for_each_word(element.text, [&](std::string_view word) {
    beat(source_.watch);
    double value = 0;
    const auto result = parse_real(word.data(), word.data() + word.size(), value);
    if (result.ec == std::errc::result_out_of_range)
      fail(element, in_quotes(word) + " is too large for a double");
    if (result.ec != std::errc() || result.ptr != word.data() + word.size())
      fail(element, "expected numbers, found " + in_quotes(word));
    values.push_back(value);
  });
  return values;
}

std::vector<std::uint64_t> DaeFile::numbers(const DaeElement& element) const {
  std::vector<std::uint64_t> values;
  for_each_word(element.text, [&](std::string_view word) {
    beat(source_.watch);
    std::uint64_t value = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size())
      fail(element, "expected numbers from 0, found " + in_quotes(word));
    values.push_back(value);
  });
  return values;
}

std::uint64_t DaeFile::number(const DaeElement& element, std::string_view attribute,
                              std::uint64_t otherwise) const {
  return element.tag.attribute(attribute).empty() ? otherwise : xml_.number(element.tag, attribute);
}

}  // namespace holdfast::io
