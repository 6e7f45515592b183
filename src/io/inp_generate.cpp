#include "io/inp_generate.h"

#include <algorithm>

#include "numbers/sorted.h"

namespace holdfast::io {

bool has_inp_keyword(std::string_view bytes, std::string_view name) {
  for (std::size_t at = bytes.find('*'); at != std::string_view::npos; at = bytes.find('*', at + 1))
    if (lower(bytes.substr(at + 1, name.size())) == name) return true;
  return false;
}

void InpMade::count(const InpText& text, std::int64_t more) {
  constexpr std::int64_t kHarmless = std::int64_t{1} << 22, kMostTimes = 1000;
  const auto bytes = static_cast<std::int64_t>(text.reader().source().bytes.size());
  const std::int64_t most = std::max(kHarmless, kMostTimes * bytes);
  if (more > most || (made_ += more) > most)
    text.reader().fail("the lines make more than " + std::to_string(most) +
                       " nodes or elements of others; such a file is damaged or malicious");
}

void InpGenerated::read_ngen(InpText& text, const InpKeyword& key) {
  if (key.has("line"))
    text.reader().fail_at(key.place,
                          "nodes on curves (*NGEN with LINE) are not read; only straight lines are");
  Numbers made;
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    if (fields.size() < 2) text.reader().fail("*NGEN needs a first and a last node");
    const std::int64_t first = text.number(fields[0], "the first node"),
                       last = text.number(fields[1], "the last node");
    const std::int64_t step = std::abs(text.increment(fields, 2, "an increment"));
    if (step == 0 || first == last || (last - first) % step != 0)
      text.reader().fail("the increment " + std::to_string(step) + " does not lead from the node " +
                         std::to_string(number_in_file(first)) + " to the node " +
                         std::to_string(number_in_file(last)));
    made.push_back(first);
    fill(text, first, last, std::abs(last - first) / step, last > first ? step : -step, made);
    made.push_back(last);
  }
  add_listed(text, key, made);
}

void InpGenerated::read_nfill(InpText& text, const InpKeyword& key) {
  for (const char* parameter : {"bias", "singular", "twostep", "two step"})
    if (key.has(parameter))
      text.reader().fail_at(
          key.place, "*NFILL with " + std::string(parameter) + " is not read; only equal intervals are");
  Numbers made;
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    if (fields.size() < 3) text.reader().fail("*NFILL needs two sets of nodes and a number of intervals");
    const Numbers from = set_of(text, fields[0]), to = set_of(text, fields[1]);
    const std::int64_t intervals = integer_of(text.reader(), fields[2], "a number of intervals");
    const std::int64_t step = text.increment(fields, 3, "an increment");
    if (intervals < 1 || step == 0) text.reader().fail("*NFILL needs an interval or more, and an increment");
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
      made.push_back(from[i]);
      fill(text, from[i], to[i], intervals, step, made);
      made.push_back(to[i]);
    }
  }
  add_listed(text, key, made);
}

// Adds the nodes between two, numbered from the first one on.
void InpGenerated::fill(const InpText& text, std::int64_t first, std::int64_t last, std::int64_t intervals,
                        std::int64_t step, Numbers& set) {
  made_.count(text, intervals);
  const Point a = elements_.place_of_node(text, first), b = elements_.place_of_node(text, last);
  for (std::int64_t k = 1; k < intervals; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(intervals);
    Point p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = a[axis] + share * (b[axis] - a[axis]);
    elements_.add_node(first + k * step, p);
    set.push_back(first + k * step);
  }
}

// Sets are sorted unless marked UNSORTED.
void InpGenerated::read_set(InpText& text, const InpKeyword& key) {
  Numbers numbers;
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    if (key.has("generate") && fields.size() > 1) {
      const InpRange range = text.range(fields, "node");
      made_.count(text, range.steps());
      range.append_to(numbers);
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      if (field[0] >= '0' && field[0] <= '9') {
        numbers.push_back(text.number(field, "a node's number"));
      } else {
        const Numbers other = set_of(text, field);
        made_.count(text, static_cast<std::int64_t>(other.size()));
        numbers.insert(numbers.end(), other.begin(), other.end());
      }
    }
  }
  if (!key.has("unsorted")) sort_unique(numbers);
  add_listed(text, key, numbers);
}

void InpGenerated::add_listed(const InpText& text, const InpKeyword& key, const Numbers& numbers) {
  const auto name = key.values.find("nset");
  if (name == key.values.end()) return;
  Numbers& all = sets_[lower(text.scope().given(name->second))];
  all.insert(all.end(), numbers.begin(), numbers.end());
}

const InpGenerated::Numbers& InpGenerated::set_of(const InpText& text, std::string_view name) const {
  const std::string given = lower(name);
  for (const std::string& full : {lower(text.scope().prefix) + given, given})
    if (const auto found = sets_.find(full); found != sets_.end()) return found->second;
  text.reader().fail("the set of nodes " + in_quotes(name) + " does not exist");
}

}  // namespace holdfast::io
