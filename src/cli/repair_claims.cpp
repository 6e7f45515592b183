#include "repair_claims.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <charconv>
#include <concepts>
#include <fstream>
#include <iterator>
#include <string_view>

#include "holdfast/io.h"
#include "number.h"
#include "paste_options.h"
#include "report.h"

namespace holdfast::cli {
namespace {

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw FileError(path, "", "cannot be read");
  return text;
}

std::optional<DropReason> reason_with_name(std::string_view text) {
  for (const DropReason reason :
       {DropReason::not_finite, DropReason::no_area, DropReason::vanished, DropReason::inner})
    if (name(reason) == text) return reason;
  return std::nullopt;
}

/// Reads the lines of a file of parents.
class ParentsFile {
 public:
  explicit ParentsFile(const std::filesystem::path& path) : path_(path) {
    const std::string text = text_of_file(path);
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      read_line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (!has_distance_) fail("no line \"# max_displacement D\"");
  }

  RepairClaims claims;

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(path_, fmt::format("line {}", line_), reason);
  }

  [[nodiscard]] static std::string_view next_word(std::string_view& text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t\r"), text.size());
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(" \t\r"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    return word;
  }

  static std::from_chars_result parse(const char* first, const char* last, double& value) {
    return parse_double(first, last, value);
  }
  static std::from_chars_result parse(const char* first, const char* last, std::integral auto& value) {
    return std::from_chars(first, last, value);
  }

  template <class Number>
  [[nodiscard]] Number number(std::string_view word) const {
    Number value{};
    const auto [end, error] = parse(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty())
      fail(fmt::format("'{}' is no number", word));
    return value;
  }

  void read_line(std::string_view line) {
    std::string_view rest = line;
    const std::string_view first = next_word(rest);
    if (first.empty()) return;
    if (first[0] == '#') return read_remark(first.size() > 1 ? first.substr(1) : next_word(rest), rest);
    if (first != "-")
      for (std::string_view word = first; !word.empty(); word = next_word(rest))
        claims.parents.all.push_back(number<Index>(word));
    claims.parents.first.push_back(claims.parents.all.size());
  }

  void read_remark(std::string_view key, std::string_view rest) {
    if (key == "max_displacement") {
      claims.max_displacement = number<double>(next_word(rest));
      has_distance_ = true;
    } else if (key == "moved") {
      const auto vertex = number<Index>(next_word(rest));
      claims.moved.push_back({vertex, number<double>(next_word(rest))});
    } else if (key == "dropped") {
      const auto facet = number<Index>(next_word(rest));
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      const std::optional<DropReason> reason =
          reason_with_name(rest.substr(0, rest.find_last_not_of(" \t\r") + 1));
      if (!reason) fail(fmt::format("'{}' is no reason to drop a triangle", rest));
      claims.dropped.push_back({facet, *reason});
    } else if (key == "marker_set") {
      std::vector<int>& set = claims.marker_sets[number<int>(next_word(rest))];
      for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
        set.push_back(number<int>(word));
    }
  }

  std::filesystem::path path_;
  std::size_t line_ = 0;
  bool has_distance_ = false;
};

IndexLists lists_of(const Json& json) {
  IndexLists lists;
  for (const Json& entry : json) {
    for (const Json& index : entry) lists.all.push_back(index.get<Index>());
    lists.first.push_back(lists.all.size());
  }
  return lists;
}

RepairClaims claims_of_report(const Json& report) {
  RepairClaims claims;
  claims.parents = lists_of(report.at("parents"));
  if (report.contains("segment_parents")) claims.segment_parents = lists_of(report.at("segment_parents"));
  for (const Json& entry : report.at("moved"))
    claims.moved.push_back({entry.at("vertex").get<Index>(), entry.at("distance").get<double>()});
  for (const Json& entry : report.at("dropped")) {
    const std::optional<DropReason> reason = reason_with_name(entry.at("reason").get<std::string>());
    if (!reason)
      throw std::invalid_argument("\"" + entry.at("reason").get<std::string>() +
                                  "\" is no reason to drop a triangle");
    claims.dropped.push_back({entry.at("facet").get<Index>(), *reason});
  }
  claims.merged.emplace();
  for (const Json& entry : report.at("merged"))
    claims.merged->push_back({entry.at("facet").get<Index>(), entry.at("into").get<Index>()});
  claims.filled.emplace();
  for (const Json& entry : report.at("filled"))
    claims.filled->push_back({entry.at("border").get<std::vector<Index>>(),
                              entry.at("facets").get<std::vector<Index>>(), entry.at("plane").get<bool>()});
  for (const auto& [marker, set] : report.at("marker_sets").items())
    claims.marker_sets[std::stoi(marker)] = set.get<std::vector<int>>();
  claims.max_displacement = report.at("max_displacement").get<double>();
  if (const auto options = report.find("options"); options != report.end()) {
    if (options->contains("weld")) claims.weld = options->at("weld").get<double>();
    if (options->contains("join")) claims.join = options->at("join").get<double>();
    if (options->contains("union")) claims.unite = options->at("union").get<bool>();
    // The tolerance of `paste`, as the user gave it. Coarser rounding of coordinates may move vertices
    // further.
    if (const auto tolerance = options->find("tolerance");
        tolerance != options->end() && tolerance->is_string())
      claims.join = tolerance_of(tolerance->get<std::string>(), "tolerance");
  }
  return claims;
}

RepairClaims read_report(const std::filesystem::path& path) {
  try {
    const Json json = Json::parse(text_of_file(path));
    return claims_of_report(json.contains("repair") ? json.at("repair") : json);
  } catch (const nlohmann::json::exception& error) {
    throw FileError(path, "", std::string("is no report of `holdfast repair`: ") + error.what());
  } catch (const std::logic_error& error) {
    throw FileError(path, "", std::string("is no report of `holdfast repair`: ") + error.what());
  }
}

std::string list_of(std::span<const Index> parents) {
  return parents.empty() ? "none" : fmt::format("{}", fmt::join(parents.begin(), parents.end(), ", "));
}

/// Where the file of parents and the report disagree.
std::vector<std::string> disagreements(const RepairClaims& file, const RepairClaims& report) {
  std::vector<std::string> found;
  if (file.max_displacement != report.max_displacement)
    found.push_back(fmt::format("the largest distance is {} in the file of parents and {} in the report",
                                file.max_displacement, report.max_displacement));
  const auto compare = [&](const char* what, std::size_t a, std::size_t b, bool equal) {
    if (!equal)
      found.push_back(
          fmt::format("{} in the file of parents ({}) and in the report ({}) differ", what, a, b));
  };
  compare("vertices moved", file.moved.size(), report.moved.size(),
          std::equal(
              file.moved.begin(), file.moved.end(), report.moved.begin(), report.moved.end(),
              [](const auto& a, const auto& b) { return a.vertex == b.vertex && a.distance == b.distance; }));
  compare(
      "triangles dropped", file.dropped.size(), report.dropped.size(),
      std::equal(file.dropped.begin(), file.dropped.end(), report.dropped.begin(), report.dropped.end(),
                 [](const auto& a, const auto& b) { return a.facet == b.facet && a.reason == b.reason; }));
  compare("sets of markers", file.marker_sets.size(), report.marker_sets.size(),
          file.marker_sets == report.marker_sets);
  compare("triangles", file.parents.size(), report.parents.size(),
          file.parents.size() == report.parents.size());
  for (std::size_t f = 0; f < std::min(file.parents.size(), report.parents.size()); ++f) {
    std::vector<Index> a(file.parents[f].begin(), file.parents[f].end());
    std::vector<Index> b(report.parents[f].begin(), report.parents[f].end());
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (a != b)
      found.push_back(
          fmt::format("the parents of triangle {} are {} in the file of parents and {} in the report", f,
                      list_of(a), list_of(b)));
  }
  return found;
}

/// Turns the lines after those of facets into parents of segments, and drops those of isolated vertices,
/// which come last and have no parents.
void take_segments(RepairClaims& claims, std::size_t input_facets, const Surface& output) {
  const std::size_t output_facets = output.facets.size();
  std::size_t lines = claims.parents.size();
  while (lines > output_facets + output.segments.size() && claims.parents[lines - 1].empty()) --lines;
  if (claims.parents.size() <= output_facets) return;
  IndexLists segments;
  for (std::size_t line = output_facets; line < lines; ++line) {
    for (const Index parent : claims.parents[line])
      segments.all.push_back(parent < input_facets ? no_entity : parent - static_cast<Index>(input_facets));
    segments.first.push_back(segments.all.size());
  }
  claims.parents.first.resize(output_facets + 1);
  claims.parents.all.resize(claims.parents.first.back());
  claims.segment_parents = std::move(segments);
}

}  // namespace

ReadClaims read_claims(const std::filesystem::path& parents, const std::filesystem::path& report,
                       const Surface& input, const Surface& output) {
  if (parents.empty()) return {read_report(report), {}};
  RepairClaims claims = std::move(ParentsFile(parents).claims);
  take_segments(claims, input.facets.size(), output);
  if (report.empty()) return {std::move(claims), {}};
  RepairClaims told = read_report(report);
  std::vector<std::string> differences = disagreements(claims, told);
  if (!claims.segment_parents) claims.segment_parents = std::move(told.segment_parents);
  claims.merged = std::move(told.merged);
  claims.filled = std::move(told.filled);
  claims.weld = told.weld;
  claims.join = told.join;
  claims.unite = told.unite;
  return {std::move(claims), std::move(differences)};
}

}  // namespace holdfast::cli
