#include "io/exact_nodes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "io/fields.h"
#include "io/mesh_sets.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

template <class... How>
std::string text_of(double value, How... how) {
  char characters[400];
  const auto result = std::to_chars(characters, characters + sizeof characters, value, how...);
  return {characters, result.ptr};
}

std::string without_leading_zero(std::string number) {
  if (number.starts_with("0.")) return number.substr(1);
  if (number.starts_with("-0.")) return "-" + number.substr(2);
  return number;
}

bool read(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const auto result = parse_double(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

double rounded(double value, std::size_t most) {
  double result = 0;
  read(short_real(value, most), result);
  return result;
}

Point rounded(const Point& p, Rounding rounding) { return {rounding(p[0]), rounding(p[1]), rounding(p[2])}; }

}  // namespace

std::string short_real(double value, std::size_t most) {
  const std::string shortest = without_leading_zero(text_of(value));
  if (shortest.size() <= most) return shortest;
  // Between these, a number takes no more room without an exponent.
  constexpr double kLeastPlain = 1e-4, kMostPlain = 1e10;
  const bool is_plain = std::fabs(value) >= kLeastPlain && std::fabs(value) < kMostPlain;
  for (int figures = static_cast<int>(most);; --figures) {
    const std::string number = is_plain
                                   ? without_leading_zero(text_of(value, std::chars_format::fixed, figures))
                                   : text_of(value, std::chars_format::scientific, figures);
    double read_back = 0;  // of the largest doubles, rounding up leaves the range
    if (number.size() <= most && read(number, read_back)) return number;
  }
}

double rounded_for_inp(double value) { return rounded(value, kInpCharacters); }
double rounded_for_dyna(double value) { return rounded(value, kDynaCharacters); }

void write_exact_nodes(AtomicWriter& out, const Volume& volume, std::string_view mark, Rounding rounding) {
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    const Point& p = node(volume, i);
    if (rounded(p, rounding) != p)
      out << mark << " exact " << std::uint64_t{i} + 1 << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
}

void ExactNodes::read(std::string_view comment) {
  std::vector<std::string_view> words = split(trimmed(comment), ' ');
  if (words.size() != 5 || words[0] != "exact") return;
  std::int64_t number = 0;
  const auto result = std::from_chars(words[1].data(), words[1].data() + words[1].size(), number);
  Point point{};
  if (result.ec != std::errc() || !io::read(words[2], point[0]) || !io::read(words[3], point[1]) ||
      !io::read(words[4], point[2]))
    return;
  points_[number] = point;
}

const Point& ExactNodes::of(std::int64_t node, const Point& point) const {
  const auto found = points_.find(node);
  return found != points_.end() && rounded(found->second, rounding_) == point ? found->second : point;
}

}  // namespace holdfast::io
