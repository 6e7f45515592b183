#include "io/inp_parts.h"

#include <algorithm>

#include "numbers/elementary.h"

namespace holdfast::io {
namespace {

/// Up to `most` numbers of a data line; fewer if it ends early or has empty fields.
std::vector<double> reals_of(const InpText& text, std::size_t most) {
  std::vector<double> values;
  for (const std::string_view field : text.fields())
    if (values.size() < most) values.push_back(field.empty() ? 0 : real_of(text.reader(), field, "a number"));
  values.resize(most, 0);
  return values;
}

/// Reads a line that translates the instance, then one that rotates it about an axis through two points.
Placement read_placement(InpText& text) {
  Placement placement;
  if (!text.is_data()) return placement;
  const std::vector<double> shift = reals_of(text, 3);
  placement = Placement::moved_by({shift[0], shift[1], shift[2]});
  if (!text.next() || !text.is_data()) return placement;
  const std::vector<double> turn = reals_of(text, 7);
  Point axis{turn[3] - turn[0], turn[4] - turn[1], turn[5] - turn[2]};
  const double length = numbers::hypot(axis[0], axis[1], axis[2]);
  if (!(length > 0)) text.reader().fail("an instance is rotated about an axis through two equal points");
  for (double& x : axis) x /= length;
  text.next();
  return Placement::turned({turn[0], turn[1], turn[2]}, axis, turn[6]).after(placement);
}

}  // namespace

InpParts::Part* InpParts::find(const std::string& name) {
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return lower(p.name) == lower(name); });
  return found == parts_.end() ? nullptr : &*found;
}

void InpParts::skip(InpText& text, const InpKeyword& key) {
  const auto name = key.values.find("name");
  if (name == key.values.end()) text.reader().fail_at(key.place, "*PART without NAME");
  if (find(name->second) != nullptr)
    text.reader().fail_at(key.place, "a second part " + in_quotes(name->second));
  const std::size_t begin = text.place();
  while (!text.at_end() && !text.is_keyword("endpart")) text.next();
  if (text.at_end())
    text.reader().fail_at(key.place, "the part " + in_quotes(name->second) + " does not end with *END PART");
  parts_.push_back({name->second, {begin, text.place()}});
  text.next();
}

InpScope& InpParts::add_instance(const std::string& name) {
  InpScope scope;
  scope.offset = kNumbersOfAnInstance * static_cast<std::int64_t>(scopes_.size() + 1);
  scope.prefix = name + ".";
  scope.names_too = true;
  return scopes_.emplace_back(std::move(scope));
}

std::optional<InpParts::Lines> InpParts::begin_instance(InpText& text, const InpKeyword& key) {
  constexpr std::size_t kMostInstances = 1 << 20;
  const auto name = key.values.find("name"), part = key.values.find("part");
  if (name == key.values.end()) text.reader().fail_at(key.place, "*INSTANCE without NAME");
  if (text.scope().offset != 0) text.reader().fail_at(key.place, "an instance within a part or an instance");
  if (scopes_.size() == kMostInstances) text.reader().fail_at(key.place, "more than a million instances");
  add_instance(name->second).placement = read_placement(text);
  text.set_scope(scopes_.back());
  if (part == key.values.end()) return std::nullopt;
  Part* const found = find(part->second);
  if (found == nullptr)
    text.reader().fail_at(key.place, "the part " + in_quotes(part->second) + " does not exist");
  found->used = true;
  return found->lines;
}

InpParts::Lines InpParts::begin_instance_of_part(InpText& text, const std::string& part) {
  text.set_scope(add_instance(part));
  return find(part)->lines;
}

InpScope InpParts::scope_of(const InpText& text, const InpKeyword& key) const {
  const std::string& instance = key.values.at("instance");
  for (InpScope scope : scopes_) {
    if (lower(scope.prefix) != lower(instance) + ".") continue;
    scope.names_too = false;
    return scope;
  }
  text.reader().fail_at(key.place, "the instance " + in_quotes(instance) + " does not exist");
}

std::vector<std::string> InpParts::unused() const {
  std::vector<std::string> names;
  for (const Part& part : parts_)
    if (!part.used) names.push_back(part.name);
  return names;
}

std::string InpParts::shown(const std::string& name) const {
  const bool is_of_the_only_one = scopes_.size() == 1 && name.starts_with(scopes_[0].prefix);
  return is_of_the_only_one ? name.substr(scopes_[0].prefix.size()) : name;
}

}  // namespace holdfast::io
