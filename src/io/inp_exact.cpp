#include "io/inp_exact.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "io/fields.h"
#include "io/mesh_sets.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kMost = 20;

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

double rounded(double value) {
  double result = 0;
  read(inp_real(value), result);
  return result;
}

Point rounded(const Point& p) { return {rounded(p[0]), rounded(p[1]), rounded(p[2])}; }

}  // namespace

std::string inp_real(double value) {
  const std::string shortest = without_leading_zero(text_of(value));
  if (shortest.size() <= kMost) return shortest;
  // Down to this, zeros after the point take no more room than an exponent.
  constexpr double kLeastPlain = 1e-4;
  const bool is_plain = std::fabs(value) >= kLeastPlain && std::fabs(value) < 1;
  for (int figures = static_cast<int>(kMost);; --figures) {
    const std::string number = is_plain
                                   ? without_leading_zero(text_of(value, std::chars_format::fixed, figures))
                                   : text_of(value, std::chars_format::scientific, figures);
    if (number.size() <= kMost) return number;
  }
}

void write_exact_nodes(AtomicWriter& out, const Volume& volume) {
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    const Point& p = node(volume, i);
    if (rounded(p) != p)
      out << "** exact " << std::uint64_t{i} + 1 << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
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
  return found != points_.end() && rounded(found->second) == point ? found->second : point;
}

}  // namespace holdfast::io
