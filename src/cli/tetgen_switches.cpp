#include "tetgen_switches.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <map>

#include "command.h"
#include "holdfast/regular_tetrahedron.h"
#include "number.h"

namespace holdfast::cli {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

const std::map<char, const char*> kRefused{
    {'r', "a mesh is not refined; mesh its surface again with a smaller bound (a)"},
    {'R', "a mesh is not coarsened; mesh its surface again with larger sizes"},
    {'v', "there is no Voronoi diagram"},
    {'w', "there are no weighted points"},
    {'D', "there is no conforming Delaunay mesh"},
    {'S', "the number of added points cannot be bounded"},
};
// Switches that only concern speed, tolerances or messages.
constexpr const char* kIdle = "OTMXLsbxljPHKGU";

/// Reads one switch after another, each with the number that follows it.
class Reader {
 public:
  Reader(const std::string& text, TetgenSwitches& to) : text_(text), to_(to) {
    if (text_.starts_with('-')) ++at_;
  }

  void run() {
    if (at_ == text_.size()) throw UsageError("tetgen: a switch is expected after '-'");
    while (at_ < text_.size()) {
      letter_ = text_[at_++];
      const std::string number = take_number();
      const bool takes_number = std::strchr("qaoOTMVLbxsGHKUlP", letter_) != nullptr || is_refused();
      if (!number.empty() && !takes_number) fail(fmt::format("takes no number, yet {} follows", number));
      take(number);
    }
  }

 private:
  [[nodiscard]] bool is_refused() const { return kRefused.count(letter_) > 0; }
  [[noreturn]] void fail(const std::string& why) const {
    throw UsageError(fmt::format("tetgen {}: switch {}: {}", text_, letter_, why));
  }

  // An e followed by digits belongs to the number; otherwise it is the switch e.
  std::string take_number() {
    const std::size_t start = at_;
    bool digits = false;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (is_digit(c)) {
        digits = true;
      } else if (digits && (c == 'e' || c == 'E')) {
        std::size_t exponent = at_ + 1;
        if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-')) ++exponent;
        if (exponent >= text_.size() || !is_digit(text_[exponent])) break;
        at_ = exponent;
      } else if (c != '.' && c != '/') {
        break;
      }
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  [[nodiscard]] double number_of(const std::string& text, const char* what) const {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = parse_double(text.data(), end, value);
    if (error != std::errc() || stop != end || !(value > 0 && std::isfinite(value)))
      fail(fmt::format("{} is expected, not '{}'", what, text));
    return value;
  }

  void take_quality(const std::string& number) {
    to_.refine = true;
    const std::size_t slash = number.find('/');
    const std::string ratio = number.substr(0, slash);
    if (!ratio.empty()) to_.ratio = number_of(ratio, "a ratio of radius to edge");
    if (!(to_.ratio > regular_radius_ratio))
      fail("a ratio above 0.613 is expected; a regular tetrahedron has 0.6124");
    if (slash == std::string::npos) return;
    const std::string angle = number.substr(slash + 1);
    if (!angle.empty()) to_.dihedral = number_of(angle, "a dihedral angle in degrees");
  }

  void take_volume(const std::string& number) {
    if (number.empty())
      to_.volume_by_region = true;
    else
      to_.max_volume = number_of(number, "a positive volume");
  }

  void take(const std::string& number) {
    if (const auto refused = kRefused.find(letter_); refused != kRefused.end()) fail(refused->second);
    if (std::strchr(kIdle, letter_) != nullptr) {
      to_.idle += (to_.idle.empty() ? "" : ", ") + (letter_ + number);
      return;
    }
    switch (letter_) {
      case 'q':
        return take_quality(number);
      case 'a':
        return take_volume(number);
      case 'o':
        if (number != "2") fail("o2, for mid-edge nodes, is expected");
        to_.second_order = true;
        return;
      case 'n':
        to_.adjacent = to_.neighbours;
        to_.neighbours = true;
        return;
      default:
        break;
    }
    static const std::map<char, bool TetgenSwitches::*> kFlags{
        {'p', &TetgenSwitches::complex},     {'Y', &TetgenSwitches::keep_surface},
        {'A', &TetgenSwitches::attributes},  {'m', &TetgenSwitches::size_field},
        {'i', &TetgenSwitches::insert},      {'d', &TetgenSwitches::detect},
        {'c', &TetgenSwitches::hull},        {'z', &TetgenSwitches::from_zero},
        {'f', &TetgenSwitches::all_faces},   {'e', &TetgenSwitches::all_edges},
        {'g', &TetgenSwitches::medit},       {'k', &TetgenSwitches::vtk},
        {'J', &TetgenSwitches::keep_unused}, {'B', &TetgenSwitches::no_markers},
        {'N', &TetgenSwitches::no_nodes},    {'E', &TetgenSwitches::no_elements},
        {'F', &TetgenSwitches::no_faces},    {'I', &TetgenSwitches::same_name},
        {'C', &TetgenSwitches::check},       {'Q', &TetgenSwitches::quiet},
        {'V', &TetgenSwitches::verbose}};
    const auto flag = kFlags.find(letter_);
    if (flag == kFlags.end()) fail("there is no such switch; docs/tetgen.md lists them");
    to_.*(flag->second) = true;
  }

  const std::string& text_;
  TetgenSwitches& to_;
  std::size_t at_ = 0;
  char letter_ = 0;
};

}  // namespace

void read_switches(const std::string& text, TetgenSwitches& switches) { Reader(text, switches).run(); }

}  // namespace holdfast::cli
