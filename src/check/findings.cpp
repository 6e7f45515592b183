// Check: the findings of a rule, in words.
#include "check/findings.h"

#include "text/decimal.h"

namespace holdfast::checking {

void Findings::append(const std::string& words) {
  if (!described_.empty()) described_ += "; ";
  described_ += words;
}

std::string Findings::text(std::string_view what) const {
  std::string text = std::to_string(count_) + " ";
  text += what;
  text += ": ";
  text += described_;
  if (count_ > most_described) text += "; and " + std::to_string(count_ - most_described) + " more";
  return text;
}

Rule judge(RuleKind kind, const Findings& findings, std::string_view what, std::string good) {
  if (findings.empty()) return {kind, name(kind), true, std::move(good)};
  return {kind, name(kind), false, findings.text(what)};
}

Rule not_examined(RuleKind kind, const std::string& reason) {
  return {kind, name(kind), false, "not examined: " + reason};
}

std::string words(const Point& point) {
  return "(" + decimal(point[0]) + ", " + decimal(point[1]) + ", " + decimal(point[2]) + ")";
}

std::string words(std::string_view kind, std::span<const Index> corners, std::span<const Point> vertices) {
  std::string text(kind);
  std::string places;
  text += " (";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0) text += ", ";
    text += std::to_string(corners[i]);
    if (i > 0) places += ", ";
    places += corners[i] < vertices.size() ? words(vertices[corners[i]]) : std::string("no such vertex");
  }
  return text + ") at " + places;
}

std::string words(std::string_view kind, std::size_t index, std::span<const Index> corners,
                  std::span<const Point> vertices) {
  return words(std::string(kind) + " " + std::to_string(index), corners, vertices);
}

}  // namespace holdfast::checking
