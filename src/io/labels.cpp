// Ids and names within the rules of a format.
#include "io/labels.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "io/text_reader.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool allowed(char c, const NameRule& rule) {
  if (letter(c) || (c >= '0' && c <= '9')) return true;
  if (static_cast<unsigned char>(c) >= 0x80) return rule.utf8;
  if (c == ' ') return rule.blanks;
  return rule.also.find(c) != std::string_view::npos;
}

/// At most `longest` bytes, without a truncated character.
std::string shortened(std::string name, std::size_t longest) {
  if (name.size() <= longest) return name;
  while (longest > 0 && (static_cast<unsigned char>(name[longest]) & 0xC0) == 0x80) --longest;
  name.resize(longest);
  return name;
}

/// The name with only allowed characters; a character of several bytes becomes one underscore.
std::string fitted(std::string_view name, const NameRule& rule) {
  std::string result;
  for (const char c : name) {
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (allowed(c, rule))
      result += c;
    else if (!goes_on)
      result += '_';
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  result.erase(0, std::min(result.find_first_not_of(' '), result.size()));
  if (rule.starts_with_letter && (result.empty() || !letter(result[0]))) result.insert(0, "n_");
  return shortened(result, rule.longest);
}

std::string key_of(const std::string& name, const NameRule& rule) {
  return rule.case_matters ? name : lower(name);
}

int first_free(const std::set<int>& used) {
  int id = 1;
  while (used.contains(id)) ++id;
  return id;
}

std::string default_name(std::string_view stem, int id) {
  return std::string(stem) + "_" + std::to_string(id);
}

void give_ids(Labels& labels, const std::vector<int>& tags, std::size_t count,
              const std::map<int, std::string>& names, const IdRule& rule) {
  std::set<int> used;
  for (std::size_t i = 0; i < count; ++i) used.insert(tag_of(tags, i));
  const std::set<int> wanted = used;
  const auto taken = [&](int id) { return rule.taken != nullptr && rule.taken->contains(id); };
  if (rule.taken != nullptr) used.insert(rule.taken->begin(), rule.taken->end());
  // What another id gets must not take the name of an id without entities.
  for (const auto& [id, name] : names) used.insert(id);
  for (const int id : wanted) {
    if ((!rule.positive || (id > 0 && id <= rule.most)) && !taken(id)) continue;
    const int number = first_free(used);
    used.insert(number);
    labels.renumbered[id] = number;
  }
  labels.ids.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto found = labels.renumbered.find(tag_of(tags, i));
    labels.ids.push_back(found == labels.renumbered.end() ? tag_of(tags, i) : found->second);
  }
}

void give_names(Labels& labels, const std::map<int, std::string>& names, const NameRule& rule) {
  std::map<int, std::string> given;
  for (const auto& [id, name] : names) {
    const auto moved = labels.renumbered.find(id);
    if (moved != labels.renumbered.end())
      given[moved->second] = name;
    else if (!given.contains(id))
      given[id] = name;
  }
  const std::set<int> in_use(labels.ids.begin(), labels.ids.end());
  std::map<int, int> original;
  for (const auto& [id, number] : labels.renumbered) original[number] = id;
  std::set<std::string> taken;
  // Names given by the user come before default names.
  for (const bool own : {true, false})
    for (const int id : in_use) {
      const auto found = given.find(id);
      if ((found != given.end()) != own) continue;
      const std::string wanted =
          own ? found->second : default_name(labels.stem, original.contains(id) ? original[id] : id);
      std::string name = fitted(wanted, rule);
      for (int copy = 0; taken.contains(key_of(name, rule)); ++copy) {
        const std::string tail = "_" + std::to_string(id) + (copy == 0 ? "" : "_" + std::to_string(copy));
        name = shortened(fitted(wanted, rule), rule.longest - tail.size()) + tail;
      }
      taken.insert(key_of(name, rule));
      if (own && name != wanted) ++labels.changed_names;
      labels.names[id] = std::move(name);
    }
}

}  // namespace

std::string cleaned_name(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size();) {
    const auto first = static_cast<unsigned char>(name[i]);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    bool valid = length > 0 && i + length <= name.size();
    for (std::size_t k = 1; valid && k < length; ++k)
      valid = (static_cast<unsigned char>(name[i + k]) & 0xC0) == 0x80;
    if (valid && length >= 3) {  // overlong forms, surrogates, and code points beyond Unicode
      const auto second = static_cast<unsigned char>(name[i + 1]);
      valid = !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F) &&
              !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
    }
    if (!valid)
      result += '?';
    else if (length == 1 && (first < ' ' || first == 0x7F))
      result += ' ';
    else
      result += name.substr(i, length);
    i += valid ? length : 1;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result.erase(0, std::min(result.find_first_not_of(' '), result.size()));
}

std::map<int, std::vector<std::size_t>> Labels::sets() const {
  std::map<int, std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]].push_back(i);
  return result;
}

Labels labels_of(std::string_view stem, const std::vector<int>& tags, std::size_t count,
                 const std::map<int, std::string>& names, const NameRule& name_rule, const IdRule& id_rule) {
  Labels labels;
  labels.stem = stem;
  give_ids(labels, tags, count, names, id_rule);
  give_names(labels, names, name_rule);
  return labels;
}

void tell(const Labels& labels, std::string_view format, std::vector<Remark>& remarks) {
  const std::string what(labels.stem == kRegionStem    ? "region"
                         : labels.stem == kFacetStem   ? "marker"
                         : labels.stem == kSegmentStem ? "segment marker"
                                                       : "vertex marker");
  for (const auto& [id, number] : labels.renumbered)
    remarks.push_back({RemarkKind::renumbered, 1,
                       what + " " + std::to_string(id) + " is " + std::to_string(number) +
                           " in the file, since " + std::string(format) +
                           (id == 0  ? " takes 0 for none"
                            : id < 0 ? " takes positive numbers alone"
                                     : " has no place for this number")});
  if (labels.changed_names > 0)
    remarks.push_back({RemarkKind::not_held, labels.changed_names,
                       counted(labels.changed_names, "name of a ", "names of ") + what +
                           (labels.changed_names == 1 ? " is" : "s are") + " changed to what " +
                           std::string(format) + " allows"});
}

std::size_t marked(std::span<const int> markers) {
  return static_cast<std::size_t>(
      std::count_if(markers.begin(), markers.end(), [](int marker) { return marker != 0; }));
}

void tell_without_place(std::size_t count, const char* one, const char* many, std::string_view format,
                        std::vector<Remark>& remarks) {
  if (count == 0) return;
  remarks.push_back(
      {RemarkKind::not_held, count,
       counted(count, one, many) + (count == 1 ? " has" : " have") + " no place in " + std::string(format)});
}

void tell_names(const Names& names, std::string_view format, std::vector<Remark>& remarks) {
  std::size_t count = 0;
  for (const auto* of : {&names.facets, &names.regions, &names.segments, &names.vertices})
    count += of->size();
  tell_without_place(count, "name", "names", format, remarks);
}

void tell_marked_vertices(const Volume& volume, std::string_view format, std::vector<Remark>& remarks) {
  tell_without_place(marked(volume.vertex_markers), "vertex's marker", "vertices' markers", format, remarks);
}

void write_id_comments(AtomicWriter& out, std::string_view mark, const Labels& labels) {
  for (const auto& [id, name] : labels.names)
    out << mark << ' ' << labels.stem << ' ' << id << ' ' << name << '\n';
}

bool read_id_comment(std::string_view comment, std::span<NamedIds* const> kinds) {
  const std::size_t stem = comment.find_first_not_of(' '), behind_stem = comment.find(' ', stem);
  if (behind_stem == std::string_view::npos) return false;
  for (NamedIds* const ids : kinds) {
    if (ids->stem() != comment.substr(stem, behind_stem - stem)) continue;
    const std::string_view rest = comment.substr(behind_stem + 1);
    int id = 0;
    const auto result = std::from_chars(rest.data(), rest.data() + rest.size(), id);
    const auto read = static_cast<std::size_t>(result.ptr - rest.data());
    if (result.ec != std::errc() || read + 1 >= rest.size() || rest[read] != ' ') return false;
    ids->tell(id, std::string(rest.substr(read + 1)));
    return true;
  }
  return false;
}

std::optional<int> id_of_default_name(std::string_view stem, std::string_view name) {
  const std::size_t number = stem.size() + 1;
  if (name.size() <= number || !name.starts_with(stem) || name[stem.size()] != '_') return std::nullopt;
  int id = 0;
  const char* const end = name.data() + name.size();
  const auto result = std::from_chars(name.data() + number, end, id);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return id;
}

int NamedIds::id_of(const std::string& given) {
  const std::string name = cleaned_name(given);
  if (const auto found = ids_.find(name); found != ids_.end()) return found->second;
  const std::optional<int> told = id_of_default_name(stem_, name);
  const bool is_told = told && !used_.contains(*told);
  const int id = is_told ? *told : first_free(used_);
  used_.insert(id);
  ids_.emplace(name, id);
  if (!told && !name.empty()) names_[id] = name;
  return id;
}

void NamedIds::tell(int id, const std::string& given) {
  const std::string name = cleaned_name(given);
  if (!used_.insert(id).second || !ids_.emplace(name, id).second) return;
  if (!name.empty() && !id_of_default_name(stem_, name)) names_[id] = name;
}

void NamedIds::set(int id, const std::string& given) {
  const std::string name = cleaned_name(given);
  if (const auto known = ids_.find(name); known != ids_.end() && known->second != id) {
    other_[id] = known->second;
    return;
  }
  const std::optional<int> told = id_of_default_name(stem_, name);
  if (told && *told != id && !used_.contains(*told))
    other_[id] = *told;
  else if (!name.empty() && !told)
    names_[id] = name;
  used_.insert(told.value_or(id));
}

}  // namespace holdfast::io
